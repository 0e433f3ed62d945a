//! Path time: how far along their paths robots should be by plan. It is the time since the drive began, minus the time
//! that holds (common stops) have cost.

use lightbots_base::{Instant, Span};
use lightbots_wire::Route;
use serde::{Deserialize, Serialize};

/// A hold: all robots slow down together along their paths, stand, and later pick up speed together. HOLD and RESUME
/// are the messages that name the two moments.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Hold {
    /// When robots begin to slow down, show clock. They stand [`Route::EASE`] later.
    pub at: Instant,
    /// Whether the operator asked for the hold.
    pub by_operator: bool,
    /// When robots begin to pick up speed again. `None` until RESUME was sent.
    pub until: Option<Instant>,
    /// When RESUME is to be sent, if the hold was to end before robots stand. RESUME then names the moment at which
    /// they stand. It is not sent earlier, because until then a new trouble can still prolong the hold. `None`
    /// otherwise.
    pub release_at: Option<Instant>,
    /// When to check next whether all robots stand.
    pub check_at: Instant,
}

/// The time base of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct PathClock {
    /// When the drive began, show clock.
    pub began: Instant,
    /// When the drive ends by plan, show clock. Each hold puts it off once RESUME was sent.
    pub ends: Instant,
    /// The present hold, until robots are back at full speed. `None` if there is no hold.
    pub hold: Option<Hold>,
    /// Time lost by holds that are over.
    pub lost: Span,
}

impl PathClock {
    /// The clock of a drive without a hold.
    pub fn new(began: Instant, duration: Span) -> Self {
        Self { began, ends: began + duration, hold: None, lost: Span::ZERO }
    }

    /// The hold, if no RESUME was sent for it yet.
    pub fn open_hold(&self) -> Option<&Hold> {
        self.hold.as_ref().filter(|hold| hold.until.is_none())
    }

    /// Whether HOLD was sent and no RESUME for it yet. Robots may still be on their way to rest, or not have begun to
    /// slow down.
    pub fn is_held(&self) -> bool {
        self.open_hold().is_some()
    }

    /// When robots stand in the present hold. `None` if there is no hold, or RESUME was sent for it.
    pub fn rests_from(&self) -> Option<Instant> {
        self.open_hold().map(|hold| hold.at + Route::EASE)
    }

    /// Begins a hold at `at`, or later if robots are still picking up speed after the hold before. Its end is not known
    /// yet. Does nothing during a hold for which no RESUME was sent.
    pub fn stand(&mut self, at: Instant) {
        let mut at = at;
        if let Some(Hold { at: before, until, .. }) = self.hold {
            let Some(until) = until else { return };
            // Robots may still be picking up speed after the hold before.
            at = at.max(until + Route::EASE);
            self.lost += until - before;
        }
        self.hold = Some(Hold { at, by_operator: false, until: None, release_at: None, check_at: at });
    }

    /// Removes the hold and adds its duration to `lost`, if robots are back at full speed by `now`.
    pub fn end_hold(&mut self, now: Instant) {
        if let Some(Hold { at, until: Some(until), .. }) = self.hold
            && now >= until + Route::EASE
        {
            self.lost += until - at;
            self.hold = None;
        }
    }

    /// Path time at `now`: how far along their paths robots should be. Negative before the drive began. In a hold its
    /// rate falls linearly from 1 to 0 within [`Route::EASE`]. After RESUME the rate rises in the same way.
    pub fn path_time(&self, now: Instant) -> Span {
        let free = now - self.began - self.lost;
        let Some(hold) = self.hold.filter(|hold| now > hold.at) else { return free };
        let held = (now - hold.at).0 as f64;
        let ease = Route::EASE.0 as f64;
        let slowing = held.min(ease);
        let rolled = slowing - slowing * slowing / (2.0 * ease);
        let picked = hold.until.filter(|until| now > *until).map_or(0.0, |until| {
            let since = (now - until).0 as f64;
            if since < ease { since * since / (2.0 * ease) } else { since - ease / 2.0 }
        });
        hold.at - self.began - self.lost + Span((rolled + picked) as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hold_costs_the_time_from_its_begin_to_its_end() {
        let mut clock = PathClock::new(Instant(1_000_000), Span::from_millis(5_000));
        let hold = Hold {
            at: Instant(2_000_000),
            by_operator: false,
            until: Some(Instant(4_000_000)),
            release_at: None,
            check_at: Instant(2_000_000),
        };
        clock.hold = Some(hold);
        assert_eq!(clock.path_time(Instant(2_000_000)), Span::from_millis(1_000));
        let stands = Span::from_millis(1_000) + Route::EASE / 2;
        assert_eq!(clock.path_time(Instant(3_500_000)), stands, "robots stand");
        let later = Instant(6_000_000);
        assert_eq!(clock.path_time(later), Span::from_millis(3_000));
        clock.end_hold(later);
        assert!(clock.hold.is_none());
        assert_eq!(clock.path_time(later), Span::from_millis(3_000), "the hold is over");
    }
}

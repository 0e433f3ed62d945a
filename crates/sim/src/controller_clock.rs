//! The clocks of the controller's computer: the show clock, the time of day, and for how long it has been on.

use lightbots_base::{Instant, Span};
use lightbots_control::{ComputerTime, Event, EventKind, UnfinishedRun, Uptime};

/// Time of day when a rehearsal begins, microseconds since 1970. The value is arbitrary, but must stay positive when
/// the clock is set back by hours.
const BEGINS_US: u64 = 1_800_000_000_000_000;

/// Differences between the clocks of the controller's computer and virtual time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ControllerClock {
    /// How far the show clock is ahead of virtual time; negative: behind it.
    ahead: Span,
    /// Sum of the changes that were made to the time of day; negative: it was set back.
    day_ahead: Span,
    /// Whether the computer tells for how long it has been on, as Linux does. The computer is never switched off.
    tells_uptime: bool,
    /// Virtual time at which the computer wakes up. Before it, the computer sleeps.
    asleep_until: Instant,
}

impl ControllerClock {
    /// Clocks that agree with virtual time. `tells_uptime`: whether the computer tells for how long it has been on.
    pub fn new(tells_uptime: bool) -> Self {
        Self { tells_uptime, ..Self::default() }
    }

    /// Time on the show clock at the virtual time `now`.
    #[inline]
    pub fn shows(&self, now: Instant) -> Instant {
        now + self.ahead
    }

    /// Virtual time at which the show clock reads `shown`. [`Instant::FAR`] stays [`Instant::FAR`].
    #[inline]
    pub fn when(&self, shown: Instant) -> Instant {
        if shown == Instant::FAR { shown } else { shown - self.ahead }
    }

    /// Converts an event's `at` from the show clock to virtual time, and the `starts` of a started transition. Other
    /// times in the event stay as they are.
    pub fn in_virtual_time(&self, event: Event) -> Event {
        let Event { at, mut kind } = event;
        if let EventKind::TransitionStarted { starts, .. } = &mut kind {
            *starts = self.when(*starts);
        }
        Event { at: self.when(at), kind }
    }

    /// What the computer's clocks read at the virtual time `now`.
    pub fn computer_time(&self, now: Instant) -> ComputerTime {
        let wall_us = (Instant(BEGINS_US + now.0) + self.day_ahead).0;
        ComputerTime { wall_us, uptime: self.tells_uptime.then_some(Uptime { boot: 1, us: now.0 }) }
    }

    /// Sets the time of day forwards by a span; a negative span sets it back. The show clock of a running controller
    /// does not change.
    pub fn set(&mut self, by: Span) {
        self.day_ahead += by;
    }

    /// Lets the computer sleep until a virtual time. Its clocks go on.
    pub fn sleep(&mut self, until: Instant) {
        self.asleep_until = self.asleep_until.max(until);
    }

    /// Whether the computer sleeps.
    #[inline]
    pub fn is_asleep(&self, now: Instant) -> bool {
        now < self.asleep_until
    }

    /// Sets the show clock of a new controller that continues `run`: it goes on from the show clock of that run.
    pub fn go_on(&mut self, now: Instant, run: &UnfinishedRun) {
        self.ahead = run.show_clock_at(&self.computer_time(now)) - now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_computer_sleeps_until_the_later_moment() {
        let mut clock = ControllerClock::default();
        clock.sleep(Instant(1_500));
        clock.sleep(Instant(1_200));
        assert!(clock.is_asleep(Instant(1_499)) && !clock.is_asleep(Instant(1_500)));
    }

    #[test]
    fn the_time_of_day_is_set_alone() {
        let mut clock = ControllerClock::new(true);
        let before = clock.computer_time(Instant(5));
        clock.set(Span(-3_600_000_000));
        let after = clock.computer_time(Instant(5));
        assert_eq!((after.wall_us, after.uptime), (before.wall_us - 3_600_000_000, before.uptime));
        assert_eq!(clock.shows(Instant(5)), Instant(5));
    }
}

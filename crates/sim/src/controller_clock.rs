//! The clocks of the controller's computer: the show clock, and the time of day. In virtual time neither jumps by itself.

use lightbots_base::{Instant, Span};
use lightbots_control::{Event, EventKind, UnfinishedRun};

/// Time of day when a rehearsal begins, microseconds since 1970: any will do that can be set back by hours.
const BEGINS_US: u64 = 1_800_000_000_000_000;

/// The clocks of the controller's computer against virtual time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ControllerClock {
    /// How far the show clock is ahead.
    ahead: Span,
    /// How far the time of day is ahead of what it was at the begin.
    day_ahead: Span,
    /// The computer sleeps until then: its show clock stands.
    asleep_until: Instant,
}

impl ControllerClock {
    /// The moment that the show clock shows.
    #[inline]
    pub fn shows(&self, now: Instant) -> Instant {
        now.max(self.asleep_until) + self.ahead
    }

    /// When the show clock shows a moment.
    #[inline]
    pub fn when(&self, shown: Instant) -> Instant {
        if shown == Instant::FAR { shown } else { shown - self.ahead }
    }

    /// An event of the controller, by virtual time.
    pub fn in_virtual_time(&self, event: Event) -> Event {
        let Event { at, mut kind } = event;
        if let EventKind::TransitionStarted { starts, .. } = &mut kind {
            *starts = self.when(*starts);
        }
        Event { at: self.when(at), kind }
    }

    /// The time of day, microseconds since 1970.
    pub fn time_of_day_us(&self, now: Instant) -> u64 {
        (Instant(BEGINS_US + now.0) + self.day_ahead).0
    }

    /// Somebody sets the time of day. A program that runs does not heed it.
    pub fn set(&mut self, by: Span) {
        self.day_ahead += by;
    }

    /// The computer sleeps for a while. Its show clock stands; the time of day goes on.
    pub fn sleep(&mut self, now: Instant, over: Span) {
        let until = now + over;
        self.ahead = self.ahead - (until - self.asleep_until.max(now));
        self.asleep_until = self.asleep_until.max(until);
    }

    /// Whether the computer sleeps.
    #[inline]
    pub fn is_asleep(&self, now: Instant) -> bool {
        now < self.asleep_until
    }

    /// A new controller takes up a run, with a show clock that goes on from that run's.
    pub fn go_on(&mut self, now: Instant, run: &UnfinishedRun) {
        self.ahead = run.show_clock_at(self.time_of_day_us(now)) - now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_show_clock_stands_while_the_computer_sleeps() {
        let mut clock = ControllerClock::default();
        clock.sleep(Instant(1_000), Span(500));
        clock.sleep(Instant(1_200), Span(400));
        let shown = [1_000, 1_300, 1_599, 1_600, 2_000].map(|now| clock.shows(Instant(now)).0);
        assert_eq!(shown, [1_000, 1_000, 1_000, 1_000, 1_400]);
        assert!(clock.is_asleep(Instant(1_599)) && !clock.is_asleep(Instant(1_600)));
        assert_eq!(clock.when(Instant(1_400)), Instant(2_000));
        assert_eq!(clock.when(Instant::FAR), Instant::FAR);
    }

    #[test]
    fn the_time_of_day_is_set_alone() {
        let mut clock = ControllerClock::default();
        let before_us = clock.time_of_day_us(Instant(5));
        clock.set(Span(-3_600_000_000));
        assert_eq!(clock.time_of_day_us(Instant(5)), before_us - 3_600_000_000);
        assert_eq!(clock.shows(Instant(5)), Instant(5));
    }
}

//! Path time: how far along its route a robot should be, as a time. It is the time of the show clock since the start of
//! the route, minus the time spent in holds. A hold slows path time to a stop within [`Route::EASE`], and a resume lets
//! it run again.

use lightbots_base::{Instant, Span};
use lightbots_wire::Route;

/// Number of holds and resumes that are remembered for a route. The effect of older ones is kept in `Timeline::base`.
/// With a smaller value, a late message about an old hold or resume is dropped more often.
const EVENTS: usize = 8;

/// Progress of a route at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RouteProgress {
    /// Path time.
    pub time: Span,
    /// Rate of path time, in path time per show time, 0 to 1. While path time goes back (see `steady_time`): down to
    /// −0.5.
    pub rate: f64,
    /// Whether a hold is in force, even if path time is still slowing down.
    pub held: bool,
}

#[derive(Clone, Copy, Debug)]
struct Event {
    at: Instant,
    hold: bool,
}

/// Progress at the moment `at`, show clock.
#[derive(Clone, Copy, Debug)]
struct Point {
    at: Instant,
    progress: RouteProgress,
}

/// The path time of the route under way as a function of the show clock alone. Robots that know the same holds and
/// resumes compute the same path time. The order in which they learnt of them does not matter, unless more than
/// [`EVENTS`] are known.
#[derive(Clone, Debug)]
pub(crate) struct Timeline {
    /// Progress at the start of the route, or after the latest hold or resume that is no longer remembered.
    base: Point,
    /// Holds and resumes in the order of their moments, none of them before `base`.
    events: heapless::Vec<Event, EVENTS>,
}

impl Timeline {
    pub(crate) fn new() -> Self {
        Self {
            base: Point { at: Instant::ZERO, progress: RouteProgress::START },
            events: heapless::Vec::new(),
        }
    }

    /// Begins a route at the moment `at`, show clock. Holds and resumes for earlier moments are dropped, those for
    /// later ones count.
    pub(crate) fn begin(&mut self, at: Instant) {
        self.base = Point { at, progress: RouteProgress::START };
        self.events.retain(|event| event.at >= at);
    }

    /// Notes a hold (`hold`) or a resume for the moment `at`, show clock. Holds and resumes may arrive in any order.
    /// Duplicates are dropped, and so are moments before the start of the route or before `base`.
    pub(crate) fn note(&mut self, at: Instant, hold: bool) {
        let folded = at < self.base.at || at == self.base.at && hold == self.base.progress.held;
        if folded || self.events.iter().any(|event| event.at == at && event.hold == hold) {
            return;
        }
        if self.events.is_full() {
            if at < self.events[0].at {
                self.base = self.base.until(at).switched(hold);
                return;
            }
            let oldest = self.events.remove(0);
            self.base = self.base.until(oldest.at).switched(oldest.hold);
        }
        let place = self.events.iter().position(|event| event.at > at).unwrap_or(self.events.len());
        // Fits: room was made above.
        let _ = self.events.insert(place, Event { at, hold });
    }

    /// Slows progress to rest from the moment `at` (show clock) on: adds a hold and drops later holds and resumes.
    pub(crate) fn rest(&mut self, at: Instant) {
        self.events.retain(|event| event.at <= at);
        self.note(at, true);
    }

    /// Whether no resume for a later moment than `show` (show clock) is known.
    pub(crate) fn stays_held(&self, show: Instant) -> bool {
        self.events.iter().all(|event| event.hold || event.at <= show)
    }

    /// Path time at the moment `show`, show clock. Also returns whether path time runs evenly with the show clock from
    /// then on, by the holds and resumes that are known.
    pub(crate) fn time_and_whether_even(&self, show: Instant) -> (Span, bool) {
        let now = self.at(show);
        let is_even = now.rate == 1.0 && !now.held && self.events.last().is_none_or(|last| last.at <= show);
        (now.time, is_even)
    }

    /// Whether a hold is in force at the moment `show`, show clock.
    pub(crate) fn held(&self, show: Instant) -> bool {
        let last = self.events.iter().take_while(|event| event.at <= show).last();
        last.map_or(self.base.progress.held, |event| event.hold)
    }

    /// Progress of the route at the moment `show`, show clock. Before the start of the route, path time is negative.
    #[inline]
    pub(crate) fn at(&self, show: Instant) -> RouteProgress {
        let mut point = self.base;
        for event in self.events.iter().take_while(|event| event.at <= show) {
            point = point.until(event.at).switched(event.hold);
        }
        point.until(show).progress
    }
}

impl RouteProgress {
    pub(crate) const START: Self = Self { time: Span::ZERO, rate: 1.0, held: false };
}

impl Point {
    /// Progress at a later moment `at`, without holds and resumes in between. The rate first changes linearly to 0 (if
    /// held) or 1, and then stays.
    fn until(self, at: Instant) -> Self {
        let RouteProgress { time, rate, held } = self.progress;
        let elapsed = at - self.at;
        let end_rate = if held { 0.0 } else { 1.0 };
        if rate == end_rate {
            let time = if held { time } else { time + elapsed };
            return Self { at, progress: RouteProgress { time, ..self.progress } };
        }
        let ease = Route::EASE.as_secs();
        let slope = (end_rate - rate).signum() / ease;
        let changing = (end_rate - rate).abs() * ease;
        let seconds = elapsed.as_secs();
        let (within, after) =
            if seconds < changing { (seconds, 0.0) } else { (changing, seconds - changing) };
        let gained = within * (rate + 0.5 * slope * within) + end_rate * after;
        let rate = if after > 0.0 { end_rate } else { rate + slope * within };
        Self { at, progress: RouteProgress { time: time + Span::from_secs(gained), rate, held } }
    }

    fn switched(mut self, held: bool) -> Self {
        self.progress.held = held;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(ms: u64) -> Instant {
        Instant(ms * 1000)
    }

    fn running() -> Timeline {
        let mut timeline = Timeline::new();
        timeline.begin(ms(1000));
        timeline
    }

    #[test]
    fn it_comes_to_rest_though_a_resume_was_noted_for_later() {
        let mut timeline = running();
        timeline.note(ms(2000), true);
        timeline.note(ms(2500), false);
        timeline.rest(ms(2400));
        assert_eq!(timeline.at(ms(9000)).time, Span::from_millis(1150));
        let mut timeline = running();
        timeline.rest(ms(2400));
        assert_eq!(timeline.at(ms(9000)).time, Span::from_millis(1550));
    }

    #[test]
    fn without_holds_path_time_is_show_time() {
        assert_eq!(running().at(ms(900)).time, Span::from_millis(-100));
        assert_eq!(
            running().at(ms(3500)),
            RouteProgress { time: Span::from_millis(2500), rate: 1.0, held: false }
        );
    }

    #[test]
    fn a_hold_eases_out_and_a_resume_eases_in() {
        let mut timeline = running();
        timeline.note(ms(2000), true);
        timeline.note(ms(4000), false);
        // Easing from 1 to 0 within 300 ms goes on for 150 ms of path time, and back as well.
        assert!((timeline.at(ms(2150)).rate - 0.5).abs() < 1e-9);
        assert_eq!(timeline.at(ms(2150)).time, Span(1_000_000 + 112_500));
        assert_eq!(timeline.at(ms(3000)), RouteProgress { time: Span(1_150_000), rate: 0.0, held: true });
        assert_eq!(timeline.at(ms(5000)), RouteProgress { time: Span(2_000_000), rate: 1.0, held: false });
        for at in [1000, 1999, 2000, 3000, 3999, 4000, 5000] {
            assert_eq!(timeline.held(ms(at)), timeline.at(ms(at)).held, "{at}");
        }
    }

    #[test]
    fn the_order_and_number_of_messages_do_not_matter() {
        let mut one = running();
        let mut other = running();
        for (at, hold) in [(2000, true), (2100, false), (6000, true)] {
            one.note(ms(at), hold);
        }
        for (at, hold) in
            [(6000, true), (2100, false), (500, true), (2000, true), (2100, false), (6000, true)]
        {
            other.note(ms(at), hold);
        }
        for at in [1500, 2050, 2200, 5000, 6100, 9000] {
            assert_eq!(one.at(ms(at)), other.at(ms(at)), "{at}");
        }
    }

    #[test]
    fn more_holds_than_are_remembered_still_count() {
        let mut timeline = running();
        for n in 1..=20 {
            timeline.note(ms(n * 2000), true);
            timeline.note(ms(n * 2000 + 1000), false);
        }
        assert_eq!(timeline.at(ms(42_000)).time, Span::from_millis(41_000 - 20 * 1000));
    }

    #[test]
    fn copies_of_what_is_folded_in_change_nothing() {
        // A copy of an event that was just folded in must not push out another: robots would jump back on their routes.
        let events = |n: u64| [(n * 2000, true), (n * 2000 + 1000, false)];
        let mut once = running();
        let mut thrice = running();
        for (at, hold) in (1..=20).flat_map(events) {
            once.note(ms(at), hold);
            for (at, hold) in [(at, hold), (at.saturating_sub(8000), hold), (at.saturating_sub(9000), !hold)]
            {
                thrice.note(ms(at), hold);
            }
            assert_eq!(thrice.at(ms(at + 500)), once.at(ms(at + 500)), "{at}");
        }
    }

    #[test]
    fn a_late_event_older_than_all_that_are_remembered_still_counts() {
        let mut timeline = running();
        for n in 2..=EVENTS as u64 / 2 + 1 {
            timeline.note(ms(n * 2000), true);
            timeline.note(ms(n * 2000 + 1000), false);
        }
        let before = timeline.at(ms(20_000)).time;
        timeline.note(ms(1500), true);
        timeline.note(ms(2500), false);
        assert_eq!(timeline.at(ms(20_000)).time, before - Span::from_millis(1000));
    }

    #[test]
    fn a_new_route_begins_free() {
        let mut timeline = running();
        timeline.note(ms(2000), true);
        timeline.begin(ms(3000));
        assert_eq!(timeline.at(ms(4000)).time, Span::from_millis(1000));
    }
}

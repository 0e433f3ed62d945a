//! Crashes of the controller: the controller is killed, and a new controller continues the run from the journal.

use lightbots_base::{Instant, Span, Vec2};
use lightbots_control::UnfinishedRun;

use crate::conditions::Outage;
use crate::disk::Disk;
use crate::timetable::Timetable;

/// A robot that moves by at most this in a step stands still, metres. At 16 ms a step this is 3 mm/s.
const STANDS_M: f64 = 0.000_05;
/// Time without a controller after which robots have stopped by themselves (R43 of docs/protocol.md).
const STOPPED: Span = Span::from_millis(2_200);

/// What happens to the controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CrashEvent {
    /// It is killed.
    Killed,
    /// It is started again.
    Back,
}

/// All crashes of the controller in a rehearsal.
#[derive(Clone, Debug, Default)]
pub(crate) struct ControllerCrashes {
    coming: Timetable<CrashEvent>,
    /// Whether there is no controller.
    is_gone: bool,
    /// The disk with the journal.
    pub disk: Disk,
    stops: Stops,
}

/// Measures how long robots take to stand still after a crash.
#[derive(Clone, Debug, Default)]
struct Stops {
    /// Places of robots one step ago, stage metres; up to date only while robots are watched.
    places: Vec<Vec2>,
    /// Since when robots are watched; `None`: they are not watched.
    since: Option<Instant>,
    /// When a robot last moved, or when watching began if no robot has moved since.
    moved: Instant,
    /// Longest time from the start of watching to the last movement; `None`: nothing was measured yet.
    longest: Option<Span>,
}

impl ControllerCrashes {
    /// Schedules crashes: the controller is killed when an outage begins, and started again when it ends.
    pub fn new(crashed: &[Outage]) -> Self {
        let events =
            |outage: &Outage| [(outage.at, CrashEvent::Killed), (outage.at + outage.over, CrashEvent::Back)];
        Self { coming: Timetable::new(crashed.iter().flat_map(events).collect()), ..Self::default() }
    }

    /// Whether a crash or a restart of the controller is still to come.
    pub fn are_there(&self) -> bool {
        !self.coming.is_empty()
    }

    /// Whether there is no controller now.
    #[inline]
    pub fn is_gone(&self) -> bool {
        self.is_gone
    }

    /// Removes and returns the next event. `None` if none is due at `since_begin`, the time since the first departure.
    pub fn next_until(&mut self, since_begin: Span) -> Option<CrashEvent> {
        let event = self.coming.next_until(since_begin)?;
        self.is_gone = event == CrashEvent::Killed;
        Some(event)
    }

    /// Reads from the journal the run that a new controller continues. `None` if there was no run, the run was over, or
    /// the journal cannot be read.
    pub fn unfinished_run(&self) -> Option<UnfinishedRun> {
        UnfinishedRun::read(self.disk.file()).ok().flatten()
    }

    /// Begins to watch robots at a crash or a restart, and discards an unfinished measurement. A restart at least
    /// [`STOPPED`] after watching began ends the measurement instead. `places`: the robots' places now, stage metres.
    pub fn watch(&mut self, event: CrashEvent, now: Instant, places: &[Vec2]) {
        self.stops.watch(event, now, places);
    }

    /// Notes the places of robots after a step of the world.
    #[inline]
    pub fn observe(&mut self, now: Instant, places: &[Vec2]) {
        if self.stops.since.is_some() {
            self.stops.observe(now, places, self.is_gone);
        }
    }

    /// Longest time from a crash, or from a restart less than [`STOPPED`] after it, until all robots stood still.
    /// `None`: nothing was measured.
    pub fn longest_stop(&self) -> Option<Span> {
        self.stops.longest
    }
}

impl Stops {
    fn watch(&mut self, event: CrashEvent, now: Instant, places: &[Vec2]) {
        let is_watched_enough = self.since.is_some_and(|since| now - since >= STOPPED);
        if event == CrashEvent::Back && is_watched_enough {
            return self.end();
        }
        (self.since, self.moved) = (Some(now), now);
        self.places = places.to_vec();
    }

    /// Notes whether robots move, and ends watching when they stand and there is a controller. Without a controller,
    /// watching goes on because a START may still be due.
    fn observe(&mut self, now: Instant, places: &[Vec2], is_gone: bool) {
        let moves = places.iter().zip(&self.places).any(|(at, before)| at.distance(*before) > STANDS_M);
        self.places.copy_from_slice(places);
        if moves {
            self.moved = now;
        } else if !is_gone {
            self.end();
        }
    }

    fn end(&mut self) {
        let took = self.since.take().map(|since| self.moved - since);
        self.longest = self.longest.max(took);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_are_watched_until_they_stand() {
        let at = |x: f64| [Vec2::new(x, 0.0)];
        let outage = Outage { at: Span(0), over: Span::from_millis(5_000) };
        let mut crashes = ControllerCrashes::new(&[outage]);
        assert_eq!(crashes.next_until(Span(0)), Some(CrashEvent::Killed));
        crashes.watch(CrashEvent::Killed, Instant(1_000), &at(0.0));
        crashes.observe(Instant(2_000), &at(0.0));
        crashes.observe(Instant(3_000), &at(0.1));
        crashes.observe(Instant(9_000), &at(0.1));
        assert_eq!(crashes.longest_stop(), None, "a robot may still begin");
        assert_eq!(crashes.next_until(Span::from_millis(5_000)), Some(CrashEvent::Back));
        crashes.watch(CrashEvent::Back, Instant(5_001_000), &at(0.1));
        assert_eq!(crashes.longest_stop(), Some(Span(2_000)));
        assert!(crashes.unfinished_run().is_none());
    }

    #[test]
    fn robots_that_drive_when_the_controller_is_back_are_watched_from_then_on() {
        let at = |x: f64| [Vec2::new(x, 0.0)];
        let outage = Outage { at: Span(0), over: Span(10) };
        let mut crashes = ControllerCrashes::new(&[outage]);
        for _ in 0..2 {
            let event = crashes.next_until(Span(10)).unwrap();
            crashes.watch(event, Instant(100_000), &at(0.0));
        }
        crashes.observe(Instant(400_000), &at(0.1));
        crashes.observe(Instant(500_000), &at(0.1));
        assert_eq!(crashes.longest_stop(), Some(Span(300_000)));
    }
}

//! Crashes of the controller: it is killed, and another one continues its run from the journal.

use lightbots_base::{Instant, Span, Vec2};
use lightbots_control::UnfinishedRun;

use crate::conditions::Outage;
use crate::disk::Disk;
use crate::timetable::Timetable;

/// A robot that moves no farther than this in a step stands still, metres. At 16 ms a step this is 3 mm/s.
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
    /// Places of robots a step ago, while they are watched.
    places: Vec<Vec2>,
    /// Since when robots are watched; `None`: they are not.
    since: Option<Instant>,
    /// When a robot moved last.
    moved: Instant,
    longest: Option<Span>,
}

impl ControllerCrashes {
    /// The crashes of the conditions.
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

    /// Takes the next event that is due at a time after the first departure. `None` if none is due.
    pub fn next_until(&mut self, since_begin: Span) -> Option<CrashEvent> {
        let event = self.coming.next_until(since_begin)?;
        self.is_gone = event == CrashEvent::Killed;
        Some(event)
    }

    /// Reads the run that a new controller finds after a crash. `None` if it was over, or the journal cannot be read.
    pub fn unfinished_run(&self) -> Option<UnfinishedRun> {
        UnfinishedRun::read(self.disk.file()).ok().flatten()
    }

    /// Watches robots from this event on, until all stand still.
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

    /// Longest time until all robots stood still after the controller was killed, or came back while they still drove.
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

    /// Notes whether robots move. Without a controller, watching goes on while robots stand, because a START may still
    /// be due.
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

//! Actions that many parts of the script need: ask the robot for its position, send it somewhere, watch it.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::rc::Rc;

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Abilities, Topic};

use super::step::{Halt, Step};
use crate::received::Received;
use crate::session::{Addressee, Session};

/// Longest time to wait for an answer of the robot. An Elisa-3 answers within one step of 16 ms; the rest is for slow
/// networks.
pub(super) const ANSWER: Span = Span::from_millis(2_000);
/// Time after an answer in which a further answer counts as a duplicate.
pub(super) const ONCE: Span = Span::from_millis(1_000);
/// Length of a drive, metres. It takes 1.1 s at the largest speed of R20, so that commands can arrive on the way.
pub(super) const WAY_M: f64 = 0.3;
/// Largest distance of the robot from its first position, metres: `WAY_M` and 0.25 m more. Farther away the exam stops
/// the robot, because people leave only 0.5 m free.
const RANGE_M: f64 = 0.55;
/// Largest distance between two reported positions of a robot that stands still, metres: 7 sigma of the 2 mm noise in
/// docs/simulator.md.
pub(super) const STILL_M: f64 = 0.015;
/// Largest distance in each coordinate from a target that the robot has reached, metres. It is the 0.02 m of R17 plus
/// 5 mm for a fix between arrival and report.
pub(super) const THERE_M: f64 = 0.025;
/// Time between position requests to a moving robot. A longer time would make the measured speed less precise
/// (`fastest_mps`).
const LOOK: Span = Span::from_millis(150);

/// The robot under test.
pub(super) struct Pilot {
    pub session: Rc<Session>,
    /// Names of all robots that were found before the exam.
    known: BTreeSet<String>,
    pub can: Abilities,
    pub has_details: bool,
    /// Position of the robot at the beginning, stage metres.
    pub home: Vec2,
    /// Place to which the robot is sent from `home`, stage metres.
    pub away: Vec2,
    placed: Cell<bool>,
    /// Shortest time until now from a command to its answer; at most 0.5 s, the value at first.
    round_trip: Cell<Span>,
    /// Number of the rule that is broken if the robot falls silent now.
    pub rule_if_silent: Cell<u8>,
    /// Number of the newest route of the exam.
    pub seq: Cell<u32>,
}

/// What was observed of a drive.
pub(super) struct Trip {
    /// Moments (exam's clock) and positions, sorted by time.
    pub places: Vec<(Instant, Vec2)>,
    /// Whether the robot came to rest at its goal.
    pub reached: bool,
}

impl Pilot {
    pub fn new(session: Rc<Session>, known: BTreeSet<String>) -> Self {
        Self {
            session,
            known,
            can: Abilities::default(),
            has_details: false,
            home: Vec2::ZERO,
            away: Vec2::ZERO,
            placed: Cell::new(false),
            round_trip: Cell::new(Span::from_millis(500)),
            rule_if_silent: Cell::new(13),
            seq: Cell::new(0),
        }
    }

    /// Whether the robot has reported a position on the floor.
    pub fn is_placed(&self) -> bool {
        self.placed.get()
    }

    /// Sets the robot's position at the beginning.
    pub fn set_home(&mut self, home: Vec2) {
        self.home = home;
        self.placed.set(true);
    }

    /// Half the shortest time from a command to its answer: about the age of a report when it arrives.
    pub fn delay(&self) -> Span {
        Span(self.round_trip.get().0 / 2)
    }

    /// Sends a payload to the robot. Returns the mark from which on its answers are found.
    pub fn send(&self, text: impl Into<String>) -> usize {
        let mark = self.session.mark();
        self.session.send(Addressee::Robot, text);
        mark
    }

    /// Requests a report with `UUID`, up to three times. If there is no answer, the robot has fallen silent, and the
    /// script ends.
    pub async fn ask(&self) -> Step<Received> {
        for _ in 0..3 {
            let asked = self.session.now();
            let mark = self.send("|UUID|");
            // A robot that answers on the wrong topic breaks R13 and is examined all the same.
            let anywhere = self.session.is_broken(13);
            let answers = |received: &Received| {
                let fits = received.topic == Topic::Uuid || anywhere;
                (fits && received.report.is_some()).then(|| received.clone())
            };
            if let Some(received) = self.session.wait_for(mark, ANSWER, answers).await {
                if self.session.is_broken(13) {
                    // A duplicate answer must not count as the next answer.
                    self.session.pause(Span::from_millis(300)).await;
                }
                let round = received.at - asked;
                self.round_trip.set(self.round_trip.get().min(round));
                return Ok(received);
            }
        }
        Err(self.fell_silent().await)
    }

    /// Requests the robot's position, stage metres. The script ends if the robot no longer knows it.
    pub async fn place(&self) -> Step<Vec2> {
        let received = self.ask().await?;
        match received.place() {
            Some(at) => Ok(at),
            None => Err(Halt("it no longer knows its position".into())),
        }
    }

    /// Requests positions until the robot stands at `goal`, or until `most` has passed.
    pub async fn watch(&self, goal: Vec2, most: Span) -> Step<Trip> {
        let until = self.session.now() + most;
        let mut trip = Trip { places: Vec::new(), reached: false };
        loop {
            let at = self.place().await?;
            trip.places.push((self.session.now(), at));
            self.check_range(at)?;
            trip.reached = within(at, goal, THERE_M) && trip.rests();
            if trip.reached || self.session.now() >= until {
                return Ok(trip);
            }
            self.session.pause(LOOK).await;
        }
    }

    /// Whether the robot stands: for the time `span`, its positions differ only by noise.
    pub async fn stands(&self, span: Span) -> Step<bool> {
        let first = self.place().await?;
        let until = self.session.now() + span;
        while self.session.now() < until {
            self.session.pause(LOOK).await;
            let at = self.place().await?;
            self.check_range(at)?;
            if at.distance(first) > STILL_M {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Sends the robot to a target and waits until it stands there, for at most 15 s.
    pub async fn drive_to(&self, goal: Vec2) -> Step<Trip> {
        self.send(target(goal));
        self.watch(goal, Span::from_millis(15_000)).await
    }

    fn check_range(&self, at: Vec2) -> Step {
        let gone = at.distance(self.home);
        if gone <= RANGE_M {
            return Ok(());
        }
        let expected = format!("it stays within {RANGE_M} m of its first position");
        self.session.record(
            17,
            false,
            "commands for places within 0.3 m",
            &expected,
            format!("it is {gone:.2} m away"),
        );
        Err(Halt("it drove too far away and was stopped".into()))
    }

    /// Records that the robot fell silent, or changed its name. Returns why the script ends.
    async fn fell_silent(&self) -> Halt {
        let asked = self.session.now();
        self.session.send(Addressee::AllRobots, "|UUID|");
        self.session.pause(ANSWER).await;
        let others = self.session.others();
        let fresh = others.iter().find(|(name, other)| !self.known.contains(*name) && other.last > asked);
        if let Some((name, _)) = fresh {
            let came = format!("silence, but now '{name}' answers");
            self.session.record(15, false, "|UUID|", "a report under the name it had", came);
            return Halt("it changed its name".into());
        }
        let rule = self.rule_if_silent.get();
        self.session.record(rule, false, "|UUID|, three times", "a report on T/LightBot/UUID", "silence");
        Halt("it fell silent".into())
    }
}

impl Trip {
    /// Whether the last three positions differ only by noise.
    fn rests(&self) -> bool {
        let [.., (_, a), (_, b), (_, c)] = self.places[..] else { return false };
        a.distance(c) <= 0.008 && b.distance(c) <= 0.008
    }

    /// Highest mean speed over at least 0.4 s, m/s, reduced by what noise and network delay may have added.
    pub fn fastest_mps(&self) -> f64 {
        let mut fastest = 0.0_f64;
        for (index, (from_at, from)) in self.places.iter().enumerate() {
            let later = self.places[index..].iter().find(|(at, _)| *at - *from_at >= Span::from_millis(400));
            if let Some((at, place)) = later {
                let way_m = (place.distance(*from) - 0.01).max(0.0);
                fastest = fastest.max(way_m / ((*at - *from_at).as_secs() + 0.05));
            }
        }
        fastest
    }
}

/// Whether each coordinate differs from the goal's by at most `bound_m` metres, as in the original's test of arrival
/// (R17).
pub(super) fn within(at: Vec2, goal: Vec2, bound_m: f64) -> bool {
    (at.x - goal.x).abs() <= bound_m && (at.y - goal.y).abs() <= bound_m
}

/// The command `|TARGET x y|`.
pub(super) fn target(goal: Vec2) -> String {
    format!("|TARGET {:.6} {:.6}|", goal.x, goal.y)
}

/// A place as text for people.
pub(super) fn shown(at: Vec2) -> String {
    format!("({:.3}, {:.3})", at.x, at.y)
}

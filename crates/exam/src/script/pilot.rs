//! What every part of the script does with the robot: ask where it is, send it somewhere, watch it.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::rc::Rc;

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Abilities, Topic};

use super::{Halt, Step};
use crate::desk::{Desk, To};
use crate::heard::Heard;

/// An answer that does not come within this is none; generous, for slow networks.
pub(super) const ANSWER: Span = Span::from_millis(2_000);
/// Within this after an answer no second one may come.
pub(super) const ONCE: Span = Span::from_millis(1_000);
/// How far it is sent, metres.
pub(super) const WAY_M: f64 = 0.3;
/// Further from where it began it must not get, metres.
const LEASH_M: f64 = 0.55;
/// A place that differs by no more than this is the same, metres: fixes are noisy.
pub(super) const STILL_M: f64 = 0.015;
/// The arrival test is 0.02 m; a fix between test and report may differ by this more.
pub(super) const THERE_M: f64 = 0.025;
/// How often a moving robot is asked where it is.
const LOOK: Span = Span::from_millis(150);

/// The robot under test and what is known of it.
pub(super) struct Pilot {
    pub desk: Rc<Desk>,
    /// Robots that were there before.
    known: BTreeSet<String>,
    pub can: Abilities,
    pub has_details: bool,
    /// Where it stood at first, and where it is sent to; stage metres.
    pub home: Vec2,
    pub away: Vec2,
    placed: Cell<bool>,
    /// The shortest way from a command to its answer.
    round_trip: Cell<Span>,
    /// The rule that is broken if the robot falls silent now.
    pub blame: Cell<u8>,
    pub seq: Cell<u32>,
}

/// What was seen of a drive.
pub(super) struct Trip {
    /// When and where, in order.
    pub places: Vec<(Instant, Vec2)>,
    /// Whether it stands at its goal.
    pub reached: bool,
}

impl Pilot {
    pub fn new(desk: Rc<Desk>, known: BTreeSet<String>) -> Self {
        Self {
            desk,
            known,
            can: Abilities::default(),
            has_details: false,
            home: Vec2::ZERO,
            away: Vec2::ZERO,
            placed: Cell::new(false),
            round_trip: Cell::new(Span::from_millis(500)),
            blame: Cell::new(13),
            seq: Cell::new(0),
        }
    }

    /// Whether it knows where it is.
    pub fn is_placed(&self) -> bool {
        self.placed.get()
    }

    /// It stands there and knows it.
    pub fn set_home(&mut self, home: Vec2) {
        self.home = home;
        self.placed.set(true);
    }

    /// Half the shortest way from a command to its answer: about how old a report is.
    pub fn delay(&self) -> Span {
        Span(self.round_trip.get().0 / 2)
    }

    /// Says something to the robot; the mark behind which its answers stand.
    pub fn say(&self, text: impl Into<String>) -> usize {
        let mark = self.desk.mark();
        self.desk.say(To::Robot, text);
        mark
    }

    /// Asks for a report on `UUID`. A robot that does not answer three times has fallen silent.
    pub async fn ask(&self) -> Step<Heard> {
        for _ in 0..3 {
            let asked = self.desk.now();
            let mark = self.say("|UUID|");
            // One that answers on the wrong topic was told so; it is examined all the same.
            let anywhere = self.desk.is_broken(13);
            let answers = |heard: &Heard| {
                let fits = heard.topic == Topic::Uuid || anywhere;
                (fits && heard.report.is_some()).then(|| heard.clone())
            };
            if let Some(heard) = self.desk.wait_for(mark, ANSWER, answers).await {
                if self.desk.is_broken(13) {
                    // Answers that come twice must not be taken for the next one.
                    self.desk.pause(Span::from_millis(300)).await;
                }
                let round = heard.at - asked;
                self.round_trip.set(self.round_trip.get().min(round));
                return Ok(heard);
            }
        }
        Err(self.fell_silent().await)
    }

    /// Where it says it is, asked now.
    pub async fn place(&self) -> Step<Vec2> {
        let heard = self.ask().await?;
        match heard.place() {
            Some(at) => Ok(at),
            None => Err(Halt("it does not know any more where it is".into())),
        }
    }

    /// Looks where it is again and again until it stands at `goal` or `most` has passed.
    pub async fn watch(&self, goal: Vec2, most: Span) -> Step<Trip> {
        let until = self.desk.now() + most;
        let mut trip = Trip { places: Vec::new(), reached: false };
        loop {
            let at = self.place().await?;
            trip.places.push((self.desk.now(), at));
            self.keep_on_leash(at)?;
            trip.reached = within(at, goal, THERE_M) && trip.rests();
            if trip.reached || self.desk.now() >= until {
                return Ok(trip);
            }
            self.desk.pause(LOOK).await;
        }
    }

    /// Whether it stands: no two places within `span` differ.
    pub async fn stands(&self, span: Span) -> Step<bool> {
        let first = self.place().await?;
        let until = self.desk.now() + span;
        while self.desk.now() < until {
            self.desk.pause(LOOK).await;
            let at = self.place().await?;
            self.keep_on_leash(at)?;
            if at.distance(first) > STILL_M {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Sends it to a target with points for decimals and waits until it is there.
    pub async fn bring(&self, goal: Vec2) -> Step<Trip> {
        self.say(target(goal));
        self.watch(goal, Span::from_millis(15_000)).await
    }

    fn keep_on_leash(&self, at: Vec2) -> Step {
        let gone = at.distance(self.home);
        if gone <= LEASH_M {
            return Ok(());
        }
        let expected = format!("it stays within {LEASH_M} m of where it began");
        self.desk.judge(
            17,
            false,
            "commands for places within 0.3 m",
            &expected,
            format!("it is {gone:.2} m away"),
        );
        Err(Halt("it drove where nobody sent it, and was stopped".into()))
    }

    /// It does not answer: a new name, or nothing at all?
    async fn fell_silent(&self) -> Halt {
        let asked = self.desk.now();
        self.desk.say(To::All, "|UUID|");
        self.desk.pause(ANSWER).await;
        let others = self.desk.others();
        let fresh = others.iter().find(|(name, other)| !self.known.contains(*name) && other.last > asked);
        if let Some((name, _)) = fresh {
            let came = format!("silence, but now '{name}' answers");
            self.desk.judge(15, false, "|UUID|", "a report under the name it had", came);
            return Halt("it has another name now".into());
        }
        let rule = self.blame.get();
        self.desk.judge(rule, false, "|UUID|, three times", "a report on T/LightBot/UUID", "silence");
        Halt("it fell silent".into())
    }
}

impl Trip {
    /// Whether the last three places are one.
    fn rests(&self) -> bool {
        let [.., (_, a), (_, b), (_, c)] = self.places[..] else { return false };
        a.distance(c) <= 0.008 && b.distance(c) <= 0.008
    }

    /// The highest mean speed over four tenths of a second and more, m/s, less what noise and network explain.
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

/// The original's arrival test with another bound.
pub(super) fn within(at: Vec2, goal: Vec2, bound_m: f64) -> bool {
    (at.x - goal.x).abs() <= bound_m && (at.y - goal.y).abs() <= bound_m
}

/// `|TARGET x y|`.
pub(super) fn target(goal: Vec2) -> String {
    format!("|TARGET {:.6} {:.6}|", goal.x, goal.y)
}

/// A place for people.
pub(super) fn shown(at: Vec2) -> String {
    format!("({:.3}, {:.3})", at.x, at.y)
}

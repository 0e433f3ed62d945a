//! A robot that did not drive as told shows that it can again before it takes part: else everybody would drive as if it
//! left its place, and it would stand in their way once more.
//!
//! It is sent a route that is never started. While it waits for the START it turns on the spot towards its beginning,
//! which needs no room, whatever the others do meanwhile.

use crate::desk::Desk;
use crate::run::{Phase, Run};
use lightbots_base::{Instant, Piece, Span, Vec2, wrap};
use lightbots_wire::{Command, Pieces, Route, Topic};

/// How far it is to turn, radians: less than a quarter, so that its front stays its front.
const TURN: f64 = 1.2;
/// Having turned so far it can drive, radians.
const TURNED: f64 = 0.6;
/// It may take so long …
const BOUND: Span = Span::from_millis(1_500);
/// … so often, as all may be stopped meanwhile; then it stays out.
const TRIES: u8 = 4;
/// A route of this length and time, metres, leads nobody anywhere.
const WAY_M: f64 = 0.05;
const WAY: Span = Span::from_millis(1_000);

/// Whether a robot that dropped out drives again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trial {
    /// Nothing speaks against it.
    None,
    /// It has to show that.
    Owed,
    /// It was told to turn, when it had this heading, radians; and how often so far.
    Turns { from: f64, since: Instant, tries: u8 },
    /// It did not.
    Failed,
}

impl Run {
    /// A robot that is out reports: whether it may take part again as far as its driving is concerned.
    pub fn has_proven_itself(&mut self, desk: &mut Desk, now: Instant, seat: usize) -> bool {
        let robot = desk.fleet.robot(self.seats[seat].robot);
        let trial = self.seats[seat].trial;
        let heading = robot.heading.filter(|_| !robot.is_original());
        // Who does not say how it stands cannot show that it turns.
        let (Some(heading), Some(at), true) = (heading, robot.at, trial != Trial::None) else {
            return trial != Trial::Failed;
        };
        let tries = match trial {
            Trial::None => return true,
            Trial::Failed => return false,
            Trial::Owed => 0,
            Trial::Turns { from, .. } if wrap(heading - from).abs() > TURNED => {
                self.settle_trial(desk, seat, Trial::None);
                return true;
            }
            Trial::Turns { since, .. } if now - since < BOUND => return false,
            Trial::Turns { tries, .. } => tries,
        };
        if matches!(self.phase, Phase::Gathering(_)) {
            // All are being told to stop.
            return false;
        }
        if tries >= TRIES {
            self.settle_trial(desk, seat, Trial::Failed);
            return false;
        }
        let way = Piece::straight(at, at + Vec2::unit(heading + TURN) * WAY_M, WAY);
        let Ok(pieces) = Pieces::from_slice(&[way]) else { return false };
        let topic = Topic::Robot(desk.fleet.robot(self.seats[seat].robot).id);
        let route =
            Route { seq: desk.take_seq(), start: at, pieces, room_mm: None, neighbours: Default::default() };
        desk.outbox.say(topic, &[Command::Route(route)]);
        self.seats[seat].trial = Trial::Turns { from: heading, since: now, tries: tries + 1 };
        false
    }

    /// The trial is over: its route is forgotten.
    fn settle_trial(&mut self, desk: &mut Desk, seat: usize, outcome: Trial) {
        self.seats[seat].trial = outcome;
        desk.outbox.say(Topic::Robot(desk.fleet.robot(self.seats[seat].robot).id), &[Command::Stop]);
    }
}

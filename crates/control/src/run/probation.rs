//! A robot that did not drive as told shows that it can before it takes part again. Otherwise all robots would drive as
//! if it left its place, and it would stand in their way once more.
//!
//! The robot is sent a route that is never started. While it waits for the START it turns on the spot towards the begin
//! of the route. That needs no room, whatever other robots do meanwhile.

use crate::run::membership::Probation;
use crate::run::run_context::RunContext;
use lightbots_base::{Piece, Span, Vec2, wrap};
use lightbots_wire::{Command, Pieces, Route};

/// The test of a robot's wheels.
struct Test {
    /// How far the robot is to turn, radians: less than a quarter turn, so that its front stays its front.
    turn: f64,
    /// Having turned by this, radians, it can drive: more than its heading is off.
    turned: f64,
    /// How long one try may take: several times as long as the turn.
    bound: Span,
    /// Number of tries, because all may be stopped meanwhile; then the robot stays excluded.
    tries: u8,
    /// Length of the route, metres, and its time. It is never started.
    route_m: f64,
    route: Span,
}

/// A smaller turn could be an error of the heading; more tries would keep the next frame waiting.
const TEST: Test = Test {
    turn: 1.2,
    turned: 0.6,
    bound: Span::from_millis(1_500),
    tries: 4,
    route_m: 0.05,
    route: Span::from_millis(1_000),
};

const _: () = assert!(TEST.turned < TEST.turn && TEST.turn < std::f64::consts::FRAC_PI_2);

/// A robot that is excluded reports: whether it may take part again as far as its driving is concerned. `is_stopping`:
/// all are being told to stop, so that it cannot be tested.
pub(crate) fn passes(cx: &mut RunContext, participant: usize, is_stopping: bool) -> bool {
    let robot = cx.robot(participant);
    let probation = cx.participant(participant).probation;
    let heading = robot.reported.heading.filter(|_| !robot.is_original());
    // A robot that does not report its heading cannot show that it turns.
    let (Some(heading), Some(at), true) = (heading, robot.reported.at, probation != Probation::None) else {
        return probation != Probation::Failed;
    };
    let tries = match probation {
        Probation::None => return true,
        Probation::Failed => return false,
        Probation::Due => 0,
        Probation::Turning { from, .. } if wrap(heading - from).abs() > TEST.turned => {
            end(cx, participant, Probation::None);
            return true;
        }
        Probation::Turning { since, .. } if cx.now - since < TEST.bound => return false,
        Probation::Turning { tries, .. } => tries,
    };
    if is_stopping {
        return false;
    }
    if tries >= TEST.tries {
        end(cx, participant, Probation::Failed);
        return false;
    }
    let piece = Piece::straight(at, at + Vec2::unit(heading + TEST.turn) * TEST.route_m, TEST.route);
    let Ok(pieces) = Pieces::from_slice(&[piece]) else { return false };
    let seq = cx.io.number_route();
    let route = Route { seq, start: at, pieces, room_mm: None, neighbours: Default::default() };
    // After an outage a robot turns only towards a route that follows STOP (R43).
    cx.send(participant, &[Command::Stop, Command::Route(route)]);
    cx.roster.participants[participant].probation =
        Probation::Turning { from: heading, since: cx.now, tries: tries + 1 };
    false
}

/// The test is over: its route is forgotten.
fn end(cx: &mut RunContext, participant: usize, outcome: Probation) {
    cx.roster.participants[participant].probation = outcome;
    cx.send(participant, &[Command::Stop]);
}

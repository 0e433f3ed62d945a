//! A robot that dropped out because it did not drive as told is tested before it takes part again. Without the test,
//! plans would rely on it to leave its place, and it would block others once more.
//!
//! The robot is sent a route that is never started. While it waits for the START it turns on the spot towards the
//! route. A turn needs no room, whatever other robots do meanwhile.

use crate::run::membership::Probation;
use crate::run::run_context::RunContext;
use lightbots_base::{Piece, Span, Vec2, wrap};
use lightbots_wire::{Command, Pieces, Route};

/// Parameters of the test of a robot's wheels.
struct Test {
    /// How far the robot is to turn, radians: less than a quarter turn, so that its front stays its front.
    turn: f64,
    /// Least turn that passes the test, radians: more than the error of the heading.
    turned: f64,
    /// Longest duration of one try: several times as long as the turn takes.
    bound: Span,
    /// Number of tries; if all fail, the robot stays excluded. One try is not enough, because all robots may be stopped
    /// during it.
    tries: u8,
    /// Length of the route, metres. The route is never started.
    route_m: f64,
    /// Planned duration of the route.
    route: Span,
}

/// A smaller turn could be an error of the heading. More tries would delay the next frame.
const TEST: Test = Test {
    turn: 1.2,
    turned: 0.6,
    bound: Span::from_millis(1_500),
    tries: 4,
    route_m: 0.05,
    route: Span::from_millis(1_000),
};

const _: () = assert!(TEST.turned < TEST.turn && TEST.turn < std::f64::consts::FRAC_PI_2);

/// Whether the driving test allows an excluded robot that reports to take part again. A robot that needs no test
/// passes. So does one that reports no heading or no place, unless it has failed the test before. Sends the route of
/// the next try if one is due. `is_stopping`: all robots are being stopped, so no try can begin.
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
    // After an outage, a robot turns only towards a route that was sent after STOP (R43).
    cx.send(participant, &[Command::Stop, Command::Route(route)]);
    cx.roster.participants[participant].probation =
        Probation::Turning { from: heading, since: cx.now, tries: tries + 1 };
    false
}

/// Ends the test with `outcome`, and sends STOP so that the robot forgets the route.
fn end(cx: &mut RunContext, participant: usize, outcome: Probation) {
    cx.roster.participants[participant].probation = outcome;
    cx.send(participant, &[Command::Stop]);
}

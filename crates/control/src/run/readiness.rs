//! What a robot lacks before it can be planned for.

use crate::context::Context;
use crate::event::Trouble;
use crate::snapshot::Age;
use lightbots_base::{Instant, Span};
use lightbots_wire::RobotState;

/// A TARGET-only robot (it understands the command TARGET but no routes) counts as standing once it has reported the
/// same place for this long. A robot with shorter standstill may be turning on the spot before it drives.
const STILL: Span = Span::from_millis(1_200);

/// What a robot (index into the fleet) lacks before it can be planned for, as a reason. `None` if it lacks nothing.
/// Reports from before `fresh_from` do not count.
pub(crate) fn missing(context: &Context, robot: usize, fresh_from: Instant) -> Option<Trouble> {
    let robot = context.fleet.robot(robot);
    let (reported, heard) = (&robot.reported, robot.contact.heard);
    if heard < fresh_from {
        return Some(Trouble::Silent);
    }
    if robot.namesakes.are_there() {
        return Some(Trouble::Shared);
    }
    match reported.state {
        Some(RobotState::Faulty) => Some(Trouble::Faulty),
        Some(RobotState::Lost) => Some(Trouble::Lost),
        Some(RobotState::Driving | RobotState::Held) => Some(Trouble::Deaf),
        _ if reported.at.is_none() => Some(Trouble::Lost),
        _ if robot.is_original() && heard - robot.standstill.since < STILL => Some(Trouble::Deaf),
        _ if !robot.is_original() && reported.clock_us.is_none() => Some(Trouble::Cut),
        _ => None,
    }
}

/// Whether a robot (index into the fleet) lacks nothing to be planned for and has reported lately.
pub(crate) fn is_ready(context: &Context, robot: usize) -> bool {
    context.fleet.robot(robot).contact.age == Age::Active && missing(context, robot, Instant::ZERO).is_none()
}

//! Messages about robots for which the planner found no paths past each other, with a remedy.

use lightbots_base::Vec2;

use super::feasibility::touching;
use crate::Meeting;
use crate::margins::MARGIN_M;
use crate::proof::Proof;
use crate::{Infeasible, Transition, TransitionProblem};

/// Most pairs of robots that a message names.
const MOST_NAMED: usize = 4;
/// Distance of pixels, in diameters of a robot, that suffices if any robot may show any pixel. Straight lines with the
/// least sum of squares then keep clear of each other (Turpin et al. 2014).
const FREE_DIAMETERS: f64 = core::f64::consts::SQRT_2;
/// Distance of pixels, in diameters of a robot, that suffices with fixed identity: measured with shuffled grids that
/// fill the floor, up to 1,000 robots.
const BOUND_DIAMETERS: f64 = 2.25;

/// Returns the message for a problem without a plan. `left` are the pairs of robots for which no paths past each other
/// were found. If it is empty, the conflicts of the straight lines (`transition`, `proof`) are named instead.
pub(super) fn infeasible(
    problem: &TransitionProblem,
    transition: &Transition,
    proof: &Proof,
    mut left: Vec<Meeting>,
) -> Infeasible {
    if left.is_empty() {
        left = on_straight_lines(problem, proof);
    }
    let mut is_named = vec![false; problem.starts.len() + problem.standing.len()];
    let (mut starts, mut apart) = (Vec::new(), Vec::new());
    for meeting in &left {
        let (a, b) = meeting.pair;
        let new = [a, b].map(|robot| is_named.get_mut(robot).is_some_and(|is| !std::mem::replace(is, true)));
        starts.extend([a, b].into_iter().zip(new).filter(|(_, new)| *new).map(|(robot, _)| robot));
        // Only pairs of which neither robot is in an earlier pair go into the message, because these say most.
        apart.extend((new == [true, true]).then_some(meeting));
    }
    starts.retain(|&robot| robot < problem.starts.len());
    let goals = starts.iter().filter_map(|&start| transition.goal_of.get(start).copied().flatten());
    let goals = goals.filter(|&goal| goal < problem.goals.len()).collect();
    let pairs: Vec<String> =
        apart.into_iter().take(MOST_NAMED).map(|meeting| named(problem, transition, meeting)).collect();
    let message = match left.len() - pairs.len() {
        _ if left.is_empty() => format!("no legal way found; {}", remedy(problem)),
        0 => format!("robots do not get past each other: {}; {}", pairs.join("; "), remedy(problem)),
        more => format!(
            "robots do not get past each other: {}; and {more} more pairs; {}",
            pairs.join("; "),
            remedy(problem)
        ),
    };
    Infeasible { goals, starts, message }
}

/// Returns the contacts of the straight lines, the closest pair first.
fn on_straight_lines(problem: &TransitionProblem, proof: &Proof) -> Vec<Meeting> {
    let least_m = problem.limits.contact_m() + MARGIN_M;
    let mut close: Vec<_> = proof.conflicts.iter().filter(|found| found.distance_m < least_m).collect();
    close.sort_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    close.into_iter().map(|found| Meeting { pair: found.pair, place: found.place }).collect()
}

/// Names a pair of robots by their goals and the place where they meet.
fn named(problem: &TransitionProblem, transition: &Transition, meeting: &Meeting) -> String {
    let at = |place: Vec2| format!("({:.2}, {:.2})", place.x, place.y);
    let name = |robot: usize| {
        let goal = transition.goal_of.get(robot).copied().flatten();
        match (goal.and_then(|goal| problem.goals.get(goal)), problem.starts.get(robot)) {
            (Some(&goal), _) => format!("to {}", at(goal)),
            (None, Some(&start)) => format!("spare from {}", at(start)),
            (None, None) => "one that stands".into(),
        }
    };
    format!("{} and {} near {} m", name(meeting.pair.0), name(meeting.pair.1), at(meeting.place))
}

/// Suggests a change of the show that gives robots more room.
fn remedy(problem: &TransitionProblem) -> String {
    let is_bound = problem.pinned.iter().any(Option::is_some);
    let diameters = if is_bound { BOUND_DIAMETERS } else { FREE_DIAMETERS };
    let enough_m = 2.0 * problem.limits.radius_m * diameters;
    let is_close = |places: &[Vec2]| touching(places, enough_m).is_some();
    if is_close(&problem.goals) || is_close(&problem.starts) {
        let free = if is_bound { ", or let any robot show them" } else { "" };
        return format!(
            "pixels {:.0} mm apart in this frame and the one before leave room{free}",
            enough_m * 1e3
        );
    }
    "leave more room around no-go areas, robots that stand and the floor's edge".into()
}

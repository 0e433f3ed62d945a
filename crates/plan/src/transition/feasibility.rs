//! Finds problems that have no solution, and makes messages about them.

use crate::{Infeasible, TransitionProblem};
use lightbots_base::Vec2;
use lightbots_show::Obstacle;

/// Largest coordinate of a place on a floor, metres. Up to it, numbers are exact to a micrometre.
const FARTHEST_M: f64 = 10_000.0;
/// Range of sensible limits of robots, in metres, seconds and radians. Values outside it are mistakes in any unit.
const SANE: core::ops::RangeInclusive<f64> = 1e-4..=1e5;

/// Checks that places, shapes, the floor, and the main limits of the robots are finite and sensible; `Err` names one
/// that is not. All other checks need a problem that passes this check.
pub(super) fn measurable(problem: &TransitionProblem) -> Result<(), Infeasible> {
    // Comparisons with NaN are false.
    let is_place = |at: &Vec2| at.x.abs() <= FARTHEST_M && at.y.abs() <= FARTHEST_M;
    let no_place = |who: &str, at: Vec2| {
        let message =
            format!("{who} at ({:?}, {:?}) m is on no floor: bring it nearer to the middle", at.x, at.y);
        Infeasible { goals: Vec::new(), starts: Vec::new(), message }
    };
    if let Some(goal) = problem.goals.iter().position(|at| !is_place(at)) {
        return Err(Infeasible { goals: vec![goal], ..no_place("a pixel", problem.goals[goal]) });
    }
    if let Some(start) = problem.starts.iter().position(|at| !is_place(at)) {
        return Err(Infeasible { starts: vec![start], ..no_place("a robot", problem.starts[start]) });
    }
    if let Some(&at) = problem.standing.iter().find(|at| !is_place(at)) {
        return Err(no_place("a robot", at));
    }
    let is_shape = |thing: &Obstacle| match thing {
        Obstacle::Disc { at, radius_m } => is_place(at) && (0.0..=FARTHEST_M).contains(radius_m),
        Obstacle::Rect { min, max } => is_place(min) && is_place(max) && min.x <= max.x && min.y <= max.y,
    };
    if let Some(index) = problem.obstacles.iter().position(|thing| !is_shape(thing)) {
        let message = format!("no-go area {} is no disc or rectangle on a floor: draw it again", index + 1);
        return Err(infeasible(Vec::new(), message));
    }
    let half = problem.half_floor;
    if is_sane(problem) && is_place(&half) {
        return Ok(());
    }
    let message = "the floor is too small or too large, or a limit of the robots makes no sense: mend them";
    Err(infeasible(Vec::new(), message.into()))
}

/// Checks that robots can stand at all goals at the same time. There must be enough robots, and no goals at which
/// robots would touch. All goals must be on the floor, clear of no-go areas and standing robots.
pub(super) fn possible(problem: &TransitionProblem) -> Result<(), Infeasible> {
    let (starts, goals) = (&problem.starts, &problem.goals);
    if goals.len() > starts.len() {
        let message = format!("{} pixels need as many robots, but there are {}", goals.len(), starts.len());
        return Err(infeasible(Vec::new(), message));
    }
    let contact = problem.limits.contact_m();
    if let Some((a, b, distance)) = touching(goals, contact) {
        let message = format!(
            "two pixels are {:.0} mm apart and would touch; {:.0} mm do",
            distance * 1e3,
            (contact + crate::margins::MARGIN_M) * 1e3
        );
        return Err(infeasible(vec![a, b], message));
    }
    for (goal, &place) in goals.iter().enumerate() {
        off_floor(problem, goal, place)?;
        blocked(problem, goal, place)?;
    }
    Ok(())
}

/// Whether the limits of the robots are sensible, and the floor is larger than a robot.
fn is_sane(problem: &TransitionProblem) -> bool {
    let (limits, half) = (&problem.limits, problem.half_floor);
    let of_robots = [limits.radius_m, limits.speed_mps, limits.accel_mps2, limits.turn_radps];
    let room = [half.x - limits.radius_m, half.y - limits.radius_m];
    of_robots.iter().all(|value| SANE.contains(value)) && room.iter().all(|&value| value > 0.0)
}

fn infeasible(goals: Vec<usize>, message: String) -> Infeasible {
    Infeasible { goals, starts: Vec::new(), message }
}

fn off_floor(problem: &TransitionProblem, goal: usize, place: Vec2) -> Result<(), Infeasible> {
    let (half, radius) = (problem.half_floor, problem.limits.radius_m);
    if place.x.abs() <= half.x - radius + 1e-6 && place.y.abs() <= half.y - radius + 1e-6 {
        return Ok(());
    }
    let message = format!(
        "a pixel at ({:.3}, {:.3}) m lies outside the floor: robots need {:.0} mm to its edge",
        place.x,
        place.y,
        radius * 1e3
    );
    Err(infeasible(vec![goal], message))
}

fn blocked(problem: &TransitionProblem, goal: usize, place: Vec2) -> Result<(), Infeasible> {
    let radius = problem.limits.radius_m;
    if problem.obstacles.iter().any(|thing| thing.gap_m(place) < radius) {
        let message = format!("a pixel is nearer than {:.0} mm to a no-go area", radius * 1e3);
        return Err(infeasible(vec![goal], message));
    }
    if problem.standing.iter().any(|disc| disc.distance(place) < 2.0 * radius) {
        let message =
            format!("a robot that does not move stands at a pixel; {:.0} mm between them do", 2e3 * radius);
        return Err(infeasible(vec![goal], message));
    }
    Ok(())
}

/// Returns two of `places` that are nearer to each other than `reach_m` by more than 1 µm. The result is the smaller
/// index, the greater index and the distance in metres; `None` if there are no two.
pub(crate) fn touching(places: &[Vec2], reach_m: f64) -> Option<(usize, usize, f64)> {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].x.total_cmp(&places[b].x).then(a.cmp(&b)));
    for (rank, &a) in order.iter().enumerate() {
        for &b in &order[rank + 1..] {
            if places[b].x - places[a].x >= reach_m {
                break;
            }
            let distance = places[a].distance(places[b]);
            if distance < reach_m - 1e-6 {
                return Some((a.min(b), a.max(b), distance));
            }
        }
    }
    None
}

/// Returns the message about pins that contradict each other or name robots that do not exist, with all pinned goals.
pub(super) fn pins(problem: &TransitionProblem) -> Infeasible {
    let goals =
        (0..problem.goals.len().min(problem.pinned.len())).filter(|&goal| problem.pinned[goal].is_some());
    infeasible(goals.collect(), "pixels are bound to robots that are not there or are bound twice".into())
}

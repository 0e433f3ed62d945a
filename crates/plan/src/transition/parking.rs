//! Where robots wait that have nothing to show.

use crate::TransitionProblem;
use lightbots_base::Vec2;
use lightbots_show::Obstacle;

/// Rings of places tried around a spare robot that stands in the way.
const RINGS: i32 = 400;

/// The problem with a goal for everybody, and an assignment for it: after the real goals follow the places where spare
/// robots wait. They wait where they stand if nobody's goal is too near, else at the nearest free place.
/// `start_of[goal]` is an assignment of the real goals.
pub(super) fn with_spares(
    problem: &TransitionProblem,
    mut start_of: Vec<usize>,
) -> (TransitionProblem, Vec<usize>) {
    let mut whole = problem.clone();
    let mut shows = vec![false; problem.starts.len()];
    for &start in &start_of {
        shows[start] = true;
    }
    let spares: Vec<usize> = (0..problem.starts.len()).filter(|&start| !shows[start]).collect();
    // Who may stay does so first; who must go looks for a place among all of those.
    let (stay, go): (Vec<usize>, Vec<usize>) =
        spares.into_iter().partition(|&spare| is_clear(problem, &problem.goals, problem.starts[spare]));
    whole.goals.extend(stay.iter().map(|&spare| problem.starts[spare]));
    for &spare in &go {
        let place = free_place(problem, &whole.goals, problem.starts[spare]);
        whole.goals.push(place.unwrap_or(problem.starts[spare]));
    }
    start_of.extend(stay.into_iter().chain(go));
    (whole, start_of)
}

/// How far a waiting robot keeps from goals, metres: enough for others to pass between (Turpin et al. 2014).
fn spacing_m(problem: &TransitionProblem) -> f64 {
    problem.limits.radius_m * 2.0 * core::f64::consts::SQRT_2
}

fn is_clear(problem: &TransitionProblem, goals: &[Vec2], place: Vec2) -> bool {
    let spacing = spacing_m(problem);
    goals.iter().chain(&problem.standing).all(|goal| goal.distance(place) >= spacing)
}

/// The nearest place on rings around `from` that is on the floor and clear of everything.
fn free_place(problem: &TransitionProblem, goals: &[Vec2], from: Vec2) -> Option<Vec2> {
    let step = problem.limits.radius_m.max(1e-3);
    let half = problem.half_floor;
    let radius = problem.limits.radius_m;
    (1..RINGS).find_map(|ring| {
        let count = ring * 6;
        (0..count)
            .map(|part| {
                let angle = f64::from(part) / f64::from(count) * core::f64::consts::TAU;
                from + Vec2::unit(angle) * (step * f64::from(ring))
            })
            .find(|&place| {
                place.x.abs() <= half.x - radius
                    && place.y.abs() <= half.y - radius
                    && problem.obstacles.iter().all(|thing| distance_to(thing, place) >= 2.0 * radius)
                    && is_clear(problem, goals, place)
            })
    })
}

/// From a place to a thing's rim, metres; 0 within it.
pub(crate) fn distance_to(thing: &Obstacle, place: Vec2) -> f64 {
    match *thing {
        Obstacle::Disc { at, radius_m } => (at.distance(place) - radius_m).max(0.0),
        Obstacle::Rect { min, max } => {
            let nearest = Vec2::new(place.x.max(min.x).min(max.x), place.y.max(min.y).min(max.y));
            nearest.distance(place)
        }
    }
}

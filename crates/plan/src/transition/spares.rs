//! Finds places where spare robots (robots without a goal) wait.

use crate::TransitionProblem;
use crate::cancel::Cancel;
use lightbots_base::Vec2;
use std::collections::BTreeMap;

/// Bound on the number of rings of places that are tried around a spare robot. Rings are one robot's radius apart.
const RINGS: i32 = 400;

/// Adds a goal for each spare robot, after the real goals. Returns the extended problem and its assignment.
/// `start_of[goal]` is the assignment of the real goals. A spare robot waits where it stands if it is far enough from
/// all goals and standing discs, else at a free place nearby. If there is no free place, it waits where it stands.
pub(super) fn with_spares(
    problem: &TransitionProblem,
    mut start_of: Vec<usize>,
    cancel: Cancel<'_>,
) -> (TransitionProblem, Vec<usize>) {
    let mut whole = problem.clone();
    let mut shows = vec![false; problem.starts.len()];
    for &start in &start_of {
        shows[start] = true;
    }
    let spares: Vec<usize> = (0..problem.starts.len()).filter(|&start| !shows[start]).collect();
    let mut taken = Taken::new(problem);
    // The places of robots that may stay are taken first. The other spare robots then get free places beside them.
    let (stay, go): (Vec<usize>, Vec<usize>) =
        spares.into_iter().partition(|&spare| taken.is_clear(problem.starts[spare]));
    for &spare in &stay {
        taken.add(problem.starts[spare]);
        whole.goals.push(problem.starts[spare]);
    }
    for &spare in &go {
        let place =
            free_place(problem, &taken, problem.starts[spare], cancel).unwrap_or(problem.starts[spare]);
        taken.add(place);
        whole.goals.push(place);
    }
    start_of.extend(stay.into_iter().chain(go));
    (whole, start_of)
}

/// Places that spare robots must keep clear of, in square cells as wide as the distance to keep.
struct Taken {
    /// Distance of two places, metres, that lets other robots pass between (Turpin et al. 2014).
    spacing_m: f64,
    cells: BTreeMap<(i64, i64), Vec<Vec2>>,
}

impl Taken {
    fn new(problem: &TransitionProblem) -> Self {
        let spacing_m = (problem.limits.contact_m() * core::f64::consts::SQRT_2).max(1e-3);
        let mut taken = Self { spacing_m, cells: BTreeMap::new() };
        problem.goals.iter().chain(&problem.standing).for_each(|&place| taken.add(place));
        taken
    }

    fn cell(&self, place: Vec2) -> (i64, i64) {
        ((place.x / self.spacing_m).floor() as i64, (place.y / self.spacing_m).floor() as i64)
    }

    fn add(&mut self, place: Vec2) {
        self.cells.entry(self.cell(place)).or_default().push(place);
    }

    fn is_clear(&self, place: Vec2) -> bool {
        let (column, row) = self.cell(place);
        let mut around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy)));
        around.all(|(dx, dy)| {
            let cell = self.cells.get(&(column.saturating_add(dx), row.saturating_add(dy)));
            cell.is_none_or(|cell| cell.iter().all(|other| other.distance(place) >= self.spacing_m))
        })
    }
}

/// Returns a free place on the nearest ring around `from` that has one; `None` if there is none, or if cancelled.
fn free_place(problem: &TransitionProblem, taken: &Taken, from: Vec2, cancel: Cancel<'_>) -> Option<Vec2> {
    let (half, radius) = (problem.half_floor, problem.limits.radius_m);
    let step = radius.max(1e-3);
    let is_free = |place: Vec2| {
        place.x.abs() <= half.x - radius
            && place.y.abs() <= half.y - radius
            && problem.obstacles.iter().all(|thing| thing.gap_m(place) >= 2.0 * radius)
            && taken.is_clear(place)
    };
    let mut rings = (1..RINGS).take_while(|_| !cancel.is_wanted());
    rings.find_map(|ring| {
        let count = ring * 6;
        let place = |part: i32| {
            let angle = f64::from(part) / f64::from(count) * core::f64::consts::TAU;
            from + Vec2::unit(angle) * (step * f64::from(ring))
        };
        (0..count).map(place).find(|&place| is_free(place))
    })
}

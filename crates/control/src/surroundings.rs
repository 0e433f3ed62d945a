//! What is around each robot on its planned path: how near others come, and which of them come into sight, where and
//! when.

use std::sync::Arc;

use lightbots_base::{Span, Vec2};
use lightbots_plan::Path;
use lightbots_wire::{Knot, Neighbours};

/// Time between two samples of the paths. When two robots pass at full speed, their clearance between samples is at
/// most about 1 mm less than at the samples.
const STEP: Span = Span::from_millis(40);
/// Largest number of steps from sample to sample; the steps of longer paths are longer.
const MOST_STEPS: i64 = 30_000;
/// Largest clearance that is computed, metres: the range of proximity sensors plus the distances of robots from their
/// paths. More clearance makes no difference to a robot.
const AMPLE_M: f64 = 0.04;
/// A neighbour counts as in sight if the gap between its rim and the robot's rim is less than this, metres.
const SIGHT_M: f64 = 0.034;
/// Largest number of paths for which surroundings are computed robot by robot. With more, that would take too long, and
/// each robot gets the least clearance of the whole plan.
const MOST: usize = 1000;
/// A neighbour that is out of range for less than this number of steps stays in the same sighting.
const PAUSE_STEPS: i64 = 3;
/// Largest distance between a neighbour's path and the spline through its knots, metres.
const KNOT_ERROR_M: f64 = 0.001;
/// A stretch between two knots that is shorter than this is not divided any further, even if its spline misses
/// [`KNOT_ERROR_M`].
const KNOT_EVERY: Span = Span::from_millis(60);

/// What one robot meets on its path: its least clearance, and its neighbours.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Surroundings {
    /// Least planned clearance to all other robots and discs, metres; infinite above [`AMPLE_M`]. With more than
    /// [`MOST`] paths: the least clearance of the whole plan, or 0 if that is not known.
    pub room_m: f64,
    /// The neighbours that come into sight of the robot on its path, as far as a route has room for them; `None` if
    /// they were not computed.
    pub neighbours: Option<Arc<Neighbours>>,
}

/// A stretch of time in which a neighbour is within [`AMPLE_M`] of a robot, short pauses included. `first` and `last`
/// are the numbers of its first and last step. `least_m` is the least gap between the rims in it, metres.
#[derive(Clone, Copy, Debug)]
struct Sighting {
    /// Index of the neighbour's path. For a disc that stands: the number of paths plus the index of the disc.
    other: usize,
    first: i64,
    last: i64,
    least_m: f64,
}

/// Returns what is around each robot, in the order of `paths`. `standing`: centres of discs that do not move, stage
/// metres. `least_m`: least clearance in the whole plan; `None` if it is not known. `contact_m`: distance between two
/// centres at contact, metres.
pub(crate) fn surroundings(
    paths: &[(usize, Path)],
    standing: &[Vec2],
    least_m: Option<f64>,
    contact_m: f64,
) -> Vec<Surroundings> {
    let alike = |room_m| vec![Surroundings { room_m, neighbours: None }; paths.len()];
    if paths.len() > MOST {
        return alike(least_m.unwrap_or(0.0));
    }
    let longest = paths.iter().map(|(_, path)| path.as_ref().duration()).max().unwrap_or(Span::ZERO);
    let every = STEP.max(Span(longest.0 / MOST_STEPS));
    let sightings = sight(paths, standing, longest, every, contact_m);
    let of_one = |mut sightings: Vec<Sighting>| {
        let stands = |one: &Sighting| paths.get(one.other).is_none_or(|(_, path)| path.as_ref().rests());
        sightings.sort_by(|a, b| stands(a).cmp(&stands(b)).then(a.least_m.total_cmp(&b.least_m)));
        let room_m = sightings.iter().map(|one| one.least_m).fold(f64::INFINITY, f64::min);
        let mut neighbours = Neighbours::new();
        for one in sightings.iter().filter(|one| one.least_m < SIGHT_M) {
            let clearance_tenths = (one.least_m.max(0.0) * 1e4) as u16;
            let knots = knots_of(one, paths, standing, longest, every);
            // If there is no room for all, the last ones are left out: first those that stand, from the farthest on.
            // Robots then treat them as unplanned obstacles.
            neighbours.push(clearance_tenths, &knots);
        }
        Surroundings { room_m, neighbours: Some(Arc::new(neighbours)) }
    };
    sightings.into_iter().map(of_one).collect()
}

/// Returns for each path which robots and discs come near its robot, and when. `longest`: duration of the longest path;
/// `every`: time between two steps.
fn sight(
    paths: &[(usize, Path)],
    standing: &[Vec2],
    longest: Span,
    every: Span,
    contact_m: f64,
) -> Vec<Vec<Sighting>> {
    let near_m = contact_m + AMPLE_M;
    let mut sightings: Vec<Vec<Sighting>> = vec![Vec::new(); paths.len()];
    let places = paths.iter().map(|(_, path)| path.start).chain(standing.iter().copied());
    let mut at: Vec<(Vec2, usize)> = places.enumerate().map(|(index, place)| (place, index)).collect();
    // The last step is after the longest path, when all robots stand.
    for step in 0..=longest.0 / every.0 + 1 {
        for (place, index) in &mut at {
            if let Some((_, path)) = paths.get(*index) {
                *place = path.as_ref().at(every * step).position;
            }
        }
        // The order hardly changes from step to step.
        at.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
        for (turn, &(place, index)) in at.iter().enumerate() {
            for &(other_place, other) in at[turn + 1..].iter().take_while(|next| next.0.x - place.x < near_m)
            {
                let apart_m = place.distance(other_place);
                if apart_m < near_m {
                    note(&mut sightings, index, other, step, apart_m - contact_m);
                    note(&mut sightings, other, index, step, apart_m - contact_m);
                }
            }
        }
    }
    sightings
}

/// Notes that `other` is near `one` at a step, with the gap `gap_m` between their rims.
fn note(sightings: &mut [Vec<Sighting>], one: usize, other: usize, step: i64, gap_m: f64) {
    let Some(known) = sightings.get_mut(one) else { return };
    let goes_on = |sighting: &&mut Sighting| sighting.other == other && step - sighting.last <= PAUSE_STEPS;
    match known.iter_mut().rev().find(goes_on) {
        Some(sighting) => (sighting.last, sighting.least_m) = (step, sighting.least_m.min(gap_m)),
        None => known.push(Sighting { other, first: step, last: step, least_m: gap_m }),
    }
}

/// Returns knots (time, place, velocity) of the neighbour of a sighting, from one step before the sighting to one step
/// after it. A standing neighbour has a single knot.
fn knots_of(
    one: &Sighting,
    paths: &[(usize, Path)],
    standing: &[Vec2],
    longest: Span,
    every: Span,
) -> Vec<Knot> {
    let from = every * (one.first - 1).max(0);
    let to = (every * (one.last + 1)).min(longest).max(from + Span::from_millis(1));
    match paths.get(one.other) {
        Some((_, path)) => {
            let knot = |at: Span| {
                let motion = path.as_ref().at(at);
                knot(at, motion.position, motion.velocity)
            };
            let mut knots = vec![knot(from)];
            divide(path, from, to, &mut knots);
            knots
        }
        None => vec![knot(from, standing[one.other - paths.len()], Vec2::ZERO)],
    }
}

/// Adds knots after `from` up to and including `to`. Their number is such that the spline through them keeps within
/// [`KNOT_ERROR_M`] of the path, unless knots come closer than [`KNOT_EVERY`].
fn divide(path: &Path, from: Span, to: Span, knots: &mut Vec<Knot>) {
    let ends = [from, to].map(|at| path.as_ref().at(at));
    let over_s = (to - from).as_secs();
    let off = |share: f64| {
        let (u, w) = (share, 1.0 - share);
        let guess = ends[0].position * (w * w * (1.0 + 2.0 * u))
            + ends[0].velocity * (over_s * u * w * w)
            + ends[1].position * (u * u * (1.0 + 2.0 * w))
            - ends[1].velocity * (over_s * u * u * w);
        guess.distance(path.as_ref().at(from + Span::from_secs(over_s * share)).position)
    };
    let fits = [0.2, 0.4, 0.6, 0.8].into_iter().all(|share| off(share) < KNOT_ERROR_M);
    if fits || to - from < KNOT_EVERY {
        knots.push(knot(to, ends[1].position, ends[1].velocity));
        return;
    }
    let middle = from + Span((to - from).0 / 2);
    divide(path, from, middle, knots);
    divide(path, middle, to, knots);
}

fn knot(at: Span, place: Vec2, velocity: Vec2) -> Knot {
    // Casts saturate, and places on a floor are far from their limits.
    Knot {
        at_ms: (at.0.max(0) / 1000) as u32,
        place_tenths: [place.x, place.y].map(|metres| (metres * 1e4).round() as i32),
        velocity_mmps: [velocity.x, velocity.y].map(|mps| (mps * 1e3).round() as i16),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Piece;
    use lightbots_wire::MAX_NEIGHBOURS;

    fn straight(from: Vec2, to: Vec2) -> Path {
        Path { start: from, pieces: vec![Piece::straight(from, to, Span::from_millis(4_000))] }
    }

    #[test]
    fn room_is_to_the_nearest_wherever_it_is_met() {
        let along = |y| straight(Vec2::new(0.0, y), Vec2::new(1.0, y));
        let back = straight(Vec2::new(1.0, 0.07), Vec2::new(0.0, 0.07));
        let paths = [(0, along(0.0)), (1, back), (2, along(0.5)), (3, along(1.0))];
        let around = surroundings(&paths, &[Vec2::new(0.5, 0.58)], Some(0.016), 0.054);
        let room_m = |index: usize| around[index].room_m;
        assert!((room_m(0) - 0.016).abs() < 0.001 && room_m(0) == room_m(1), "{around:?}");
        assert!((room_m(2) - 0.026).abs() < 0.001 && room_m(3) == f64::INFINITY, "{around:?}");
    }

    #[test]
    fn neighbours_are_named_with_time_and_place() {
        let along = |y| straight(Vec2::new(0.0, y), Vec2::new(1.0, y));
        let back = straight(Vec2::new(1.0, 0.07), Vec2::new(0.0, 0.07));
        let paths = [(0, along(0.0)), (1, back)];
        let around = surroundings(&paths, &[Vec2::new(0.8, -0.07)], Some(0.016), 0.054);
        let named = around[0].neighbours.as_deref().unwrap();
        assert_eq!(named.list.len(), 2);
        let meets = Span::from_millis(2_000);
        let places: Vec<_> = named.list.iter().filter_map(|one| named.motion(one, meets)).collect();
        assert_eq!(places.len(), 1);
        assert!(places[0].position.distance(Vec2::new(0.5, 0.07)) < 0.0005, "{places:?}");
        assert!(places[0].velocity.distance(Vec2::new(-0.25, 0.0)) < 0.001, "{places:?}");
    }

    #[test]
    fn in_a_large_fleet_each_robot_has_the_least_clearance_of_all() {
        let far = |index: usize| Vec2::new(index as f64, 0.0);
        let paths: Vec<_> = (0..=MOST).map(|index| (index, straight(far(index), far(index)))).collect();
        let around = surroundings(&paths, &[], Some(0.007), 0.054);
        assert!(around.iter().all(|one| one.room_m == 0.007 && one.neighbours.is_none()));
    }

    #[test]
    fn robots_that_drive_are_named_before_what_stands() {
        let along = |y| straight(Vec2::new(0.0, y), Vec2::new(1.0, y));
        let beside: Vec<Vec2> = (0..80).map(|place| Vec2::new(0.012 * f64::from(place), -0.06)).collect();
        let around = surroundings(&[(0, along(0.0)), (1, along(0.08))], &beside, None, 0.054);
        let named = around[0].neighbours.as_deref().unwrap();
        assert_eq!(named.list.len(), MAX_NEIGHBOURS);
        let drives = named.motion(&named.list[0], Span::from_millis(2_000)).unwrap();
        assert!((drives.position.y - 0.08).abs() < 1e-3 && (around[0].room_m - 0.006).abs() < 1e-3);
    }

    #[test]
    fn what_stands_is_named_where_the_plan_tells_no_clearance() {
        let paths = [(0, straight(Vec2::ZERO, Vec2::new(1.0, 0.0)))];
        let around = surroundings(&paths, &[Vec2::new(0.5, 0.064)], None, 0.054);
        assert!((around[0].room_m - 0.01).abs() < 1e-6, "{}", around[0].room_m);
        assert_eq!(around[0].neighbours.as_ref().map(|named| named.list.len()), Some(1));
    }
}

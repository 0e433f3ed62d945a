//! The shortest paths of all robots, and two displacements of a dense fleet on them. `level` keeps the fleet from
//! gathering in the middle, `loosen` spreads it.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::optimise::cells::{Cells, Disc};

/// Share of the distance to its evenly spread place by which [`PathSet::level`] moves a robot.
const LEVELLED: f64 = 0.6;
/// Mean distance between neighbours that a spread fleet aims at, metres.
const LOOSE_M: f64 = 0.14;

/// The shortest paths of all robots.
pub(crate) struct PathSet<'a> {
    pub instance: &'a Instance<'a>,
    /// `[robot]`: the corners of its path, from its start to its end, stage metres.
    pub paths: &'a [Vec<Vec2>],
    /// `[robot]`: length of its path, metres.
    pub lengths: Vec<f64>,
    /// Length of the longest path, metres.
    pub longest_m: f64,
    /// `[axis]`: coordinates of all starts and of all ends along x or y, each sorted, metres.
    spreads: [(Vec<f64>, Vec<f64>); 2],
    /// The middle of the rectangle around all starts and ends, stage metres.
    middle: Vec2,
    /// Factor along each axis by which the fleet gets wider when it spreads, at least 1.
    wider: Vec2,
}

impl<'a> PathSet<'a> {
    /// The set of these paths.
    pub fn new(instance: &'a Instance<'a>, paths: &'a [Vec<Vec2>]) -> Self {
        let lengths: Vec<f64> = paths.iter().map(|path| length(path)).collect();
        let longest_m = lengths.iter().copied().fold(0.0, f64::max);
        let spread = |of: fn(Vec2) -> f64| {
            let sorted = |ends: &mut dyn Iterator<Item = Vec2>| {
                let mut along: Vec<f64> = ends.map(of).collect();
                along.sort_unstable_by(f64::total_cmp);
                along
            };
            let starts = sorted(&mut paths.iter().map(|path| path[0]));
            (starts, sorted(&mut paths.iter().map(|path| path[path.len() - 1])))
        };
        let spreads = [spread(|at| at.x), spread(|at| at.y)];
        let (middle, wider) = room(instance, &spreads);
        Self { instance, paths, lengths, longest_m, spreads, middle, wider }
    }

    /// Moves `places[robot]` along both axes towards an even spread, when the share `share` of the drive is done. Along
    /// each axis, the place of rank k moves towards the line from the k-th start to the k-th end.
    pub fn level(&self, places: &mut [Vec2], share: f64) {
        for (axis, (starts, ends)) in self.spreads.iter().enumerate() {
            let of = |place: &Vec2| if axis == 0 { place.x } else { place.y };
            let mut order: Vec<(f64, usize)> = places.iter().map(of).zip(0..).collect();
            order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (rank, (along, robot)) in order.into_iter().enumerate() {
                let even = starts[rank] * (1.0 - share) + ends[rank] * share;
                let aside = (even - along) * LEVELLED;
                places[robot] += if axis == 0 { Vec2::new(aside, 0.0) } else { Vec2::new(0.0, aside) };
            }
        }
    }

    /// The farthest that a robot moves when the fleet fully spreads at its starts, metres.
    pub fn farthest_loosened(&self) -> f64 {
        let starts: Vec<Vec2> = self.paths.iter().map(|path| path[0]).collect();
        let mut loose = starts.clone();
        self.loosen(&mut loose, 1.0);
        starts.iter().zip(&loose).map(|(from, to)| from.distance(*to)).fold(0.0, f64::max)
    }

    /// Moves `places[robot]` away from the middle, by the share `share` of the full spread.
    pub fn loosen(&self, places: &mut [Vec2], share: f64) {
        for (robot, place) in places.iter_mut().enumerate() {
            let out = *place - self.middle;
            let aside = Vec2::new(out.x * (self.wider.x - 1.0), out.y * (self.wider.y - 1.0));
            *place = self.instance.on_floor(robot, *place + aside * share, self.instance.off_edge_m);
        }
    }
}

/// The middle of the rectangle around all starts and ends, and the factor along each axis by which the fleet can spread
/// on its floor.
fn room(instance: &Instance, spreads: &[(Vec<f64>, Vec<f64>); 2]) -> (Vec2, Vec2) {
    let extent = |(starts, ends): &(Vec<f64>, Vec<f64>)| {
        let (Some(first), Some(last)) = (starts.first(), starts.last()) else { return (0.0, 0.0) };
        let least = ends.first().map_or(*first, |end| end.min(*first));
        (least, ends.last().map_or(*last, |end| end.max(*last)))
    };
    let ((left, right), (front, back)) = (extent(&spreads[0]), extent(&spreads[1]));
    let count = spreads[0].0.len().max(1) as f64;
    let apart_m = ((right - left + LOOSE_M) * (back - front + LOOSE_M) / count).sqrt();
    let wider = |least: f64, most: f64, inner: f64| {
        let (reach, room) = ((most - least) / 2.0, inner - ((least + most) / 2.0).abs());
        (LOOSE_M / apart_m).min(room / reach.max(1e-3)).max(1.0)
    };
    let middle = Vec2::new(left + right, front + back) * 0.5;
    (middle, Vec2::new(wider(left, right, instance.inner.x), wider(front, back, instance.inner.y)))
}

/// Returns the congestion of `places`: each pair closer than `near_m` metres adds 1 − its distance / `near_m`.
pub(crate) fn crowding(cells: &mut Cells, places: &[Vec2], near_m: f64) -> f64 {
    let disc = |(robot, &at): (usize, &Vec2)| Disc { at, radius: 0.0, owner: robot as u32 };
    let discs: Vec<Disc> = places.iter().enumerate().map(disc).collect();
    let mut sum = 0.0;
    cells.near_pairs(&discs, near_m, |a, b| sum += 1.0 - a.at.distance(b.at) / near_m);
    sum
}

/// Length of a line through corners, metres.
pub(crate) fn length(path: &[Vec2]) -> f64 {
    path.windows(2).map(|segment| segment[0].distance(segment[1])).sum()
}

/// Returns the place at the length `length_m` along a line through corners, or the end of a shorter line. A path has at
/// least one corner.
pub(crate) fn point_along(path: &[Vec2], mut length_m: f64) -> Vec2 {
    for segment in path.windows(2) {
        let length = segment[0].distance(segment[1]);
        if length_m < length {
            return segment[0].lerp(segment[1], length_m / length);
        }
        length_m -= length;
    }
    path.last().copied().unwrap_or(Vec2::ZERO)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use lightbots_base::Limits;

    #[test]
    fn a_crowd_that_meets_in_the_middle_is_kept_apart() {
        let ring = |i: usize| Vec2::unit(i as f64 * 0.1 * std::f64::consts::TAU) * 0.3;
        let problem = TransitionProblem {
            starts: (0..10).map(ring).collect(),
            goals: (0..10).map(|i| -ring(i)).collect(),
            ..TransitionProblem::on_floor(Vec2::new(1.0, 1.0), Limits::ELISA_3)
        };
        let instance = Instance::new(&problem, &(0..10).map(Some).collect::<Vec<_>>()).unwrap();
        let paths: Vec<Vec<Vec2>> = (0..10).map(|i| vec![ring(i), -ring(i)]).collect();
        let path_set = PathSet::new(&instance, &paths);
        let mut places: Vec<Vec2> = (0..10).map(|i| ring(i) * 0.1).collect();
        let before = crowding(&mut Cells::default(), &places, 0.06);
        path_set.level(&mut places, 0.45);
        let levelled = crowding(&mut Cells::default(), &places, 0.06);
        path_set.loosen(&mut places, 1.0);
        let loosened = crowding(&mut Cells::default(), &places, 0.06);
        assert!(before > 10.0 && levelled < 1.0 && loosened <= levelled, "{before} {levelled} {loosened}");
        assert!(places.iter().all(|place| place.length() < 0.7));
    }
}

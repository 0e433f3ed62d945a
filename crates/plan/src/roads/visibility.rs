//! Shortest paths through gaps that a lattice does not fit through. They lead from corner to corner of walls along free
//! lines (a visibility graph; Lozano-Pérez and Wesley 1979). The pitch of a lattice is the distance between
//! neighbouring nodes in its rows.

use lightbots_base::Vec2;
use lightbots_show::Obstacle;

use crate::instance::Instance;
use crate::margins::VISIBILITY_M;
use crate::roads::graph::{Graph, NONE, cheapest_paths};
use crate::roads::lattice::Lattice;

/// Most walls of a visibility graph. With more walls it stays empty, because too many pairs of corners would see each
/// other.
pub(crate) const MOST_WALLS: usize = 24;
/// Least distance of an added lattice node from other nodes, in pitches.
const LEAST_PITCH: f64 = 0.83;
/// Longest edge of an added lattice node, in pitches.
const MOST_PITCH: f64 = 1.45;
/// A gap is narrow if it is wider than a robot by less than this, metres. Two robots cannot pass each other in it.
const NARROW_M: f64 = 0.04;
/// Factor on the least distance of nodes when a line is divided evenly. With it, nodes on crossing lines fit beside the
/// nodes of that line.
const EVEN: f64 = 1.08;
/// Distance between neighbouring places at which an additional node is tried, metres.
const FILL_STEP_M: f64 = 0.01;
/// Number of corners of the polygon around a disc.
const DISC_CORNERS: u32 = 8;

/// Places beside the corners of walls, and the free lines between these places.
pub(crate) struct VisibilityGraph {
    places: Vec<Vec2>,
    /// `[place]`: indices of the places that have a free line to it.
    sees: Vec<Vec<u32>>,
}

impl VisibilityGraph {
    /// The graph of an instance; empty if there are more than [`MOST_WALLS`].
    pub fn new(instance: &Instance) -> Self {
        let off_m = instance.limits.radius_m + VISIBILITY_M;
        let walls = if instance.walls.len() > MOST_WALLS { &[][..] } else { &instance.walls[..] };
        let mut places: Vec<Vec2> = walls.iter().flat_map(|wall| around(wall, off_m)).collect();
        places.retain(|&place| instance.is_free(place, VISIBILITY_M - 1e-5));
        let sees = |&from: &Vec2| seen(instance, &places, from);
        let sees = places.iter().map(sees).collect();
        Self { places, sees }
    }

    /// Makes a lattice that reaches through gaps. Nodes in narrow gaps come first, then the usual rows, then more nodes
    /// wherever one fits. `None` if it would be too large, or the planner is cancelled.
    pub fn lattice(&self, instance: &Instance, pitch_m: f64) -> Option<Lattice> {
        let (apart_m, reach_m) = (pitch_m * LEAST_PITCH, pitch_m * MOST_PITCH);
        let gaps = self.in_gaps(instance, apart_m);
        let mut lattice = Lattice::around_places(instance, pitch_m, &gaps, apart_m)?;
        let is_beside = |a: Vec2, b: Vec2| instance.is_way_free(a, b, VISIBILITY_M - 1e-5);
        for &place in &gaps {
            lattice.add(place, reach_m, |other| is_beside(place, other));
        }
        let count = |half: f64| (half / FILL_STEP_M) as i32;
        for row in -count(instance.inner.y)..=count(instance.inner.y) {
            if instance.cancel.is_wanted() {
                return None;
            }
            for column in -count(instance.inner.x)..=count(instance.inner.x) {
                let place = Vec2::new(f64::from(column), f64::from(row)) * FILL_STEP_M;
                if lattice.around(place, apart_m, 1).is_empty()
                    && instance.is_free(place, VISIBILITY_M - 1e-5)
                {
                    lattice.add(place, reach_m, |other| is_beside(place, other));
                }
            }
        }
        Some(lattice)
    }

    /// Returns places in narrow gaps on lines from corner to corner, at least `apart_m` metres from each other. Places
    /// that divide a line evenly are tried first, so that the ends of the line are among them.
    fn in_gaps(&self, instance: &Instance, apart_m: f64) -> Vec<Vec2> {
        let mut gaps: Vec<Vec2> = Vec::new();
        for step_m in [apart_m * EVEN, FILL_STEP_M] {
            for (from, seen) in self.sees.iter().enumerate() {
                for (a, b) in seen
                    .iter()
                    .filter(|&&to| to as usize > from)
                    .map(|&to| (self.places[from], self.place(to)))
                {
                    if instance.cancel.is_wanted() {
                        return gaps;
                    }
                    let steps = (a.distance(b) / step_m).floor().max(1.0);
                    for place in (0..=steps as usize).map(|step| a.lerp(b, step as f64 / steps)) {
                        let is_apart = gaps.iter().all(|other| other.distance(place) >= apart_m);
                        if is_apart
                            && is_narrow(instance, place)
                            && instance.is_free(place, VISIBILITY_M - 1e-5)
                        {
                            gaps.push(place);
                        }
                    }
                }
            }
        }
        gaps
    }

    /// Returns the corners of the shortest path between two places, with both places, stage metres; `None` if there is
    /// no path. The path has at least one corner of a wall on it.
    pub fn path(&self, instance: &Instance, start: Vec2, end: Vec2) -> Option<Vec<Vec2>> {
        let sources = seen(instance, &self.places, start);
        let sources = sources.into_iter().map(|at| (at, start.distance(self.place(at))));
        let from_start = cheapest_paths(self, sources, |from, to| self.length_m(from, to));
        let whole = |at: u32| from_start.costs[at as usize] + self.place(at).distance(end);
        let reached = seen(instance, &self.places, end).into_iter().filter(|&at| whole(at) < f64::INFINITY);
        let mut at = reached.min_by(|&a, &b| whole(a).total_cmp(&whole(b)))?;
        let mut path = vec![end];
        while at != NONE {
            path.push(self.place(at));
            at = from_start.before[at as usize];
        }
        path.push(start);
        path.reverse();
        Some(path)
    }
}

impl Graph for VisibilityGraph {
    fn places(&self) -> &[Vec2] {
        &self.places
    }

    fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> {
        self.sees[node as usize].iter().copied()
    }
}

/// Whether the two smallest gaps between a robot at `place` and walls or edges of the floor add up to less than
/// [`NARROW_M`].
fn is_narrow(instance: &Instance, place: Vec2) -> bool {
    let edges = [instance.inner.x - place.x.abs(), instance.inner.y - place.y.abs()];
    let off_walls = (0..instance.walls.len()).map(|wall| instance.off_wall(wall, place).0);
    let two = edges.into_iter().chain(off_walls).fold((f64::INFINITY, f64::INFINITY), |(one, two), gap| {
        if gap < one { (gap, one) } else { (one, two.min(gap)) }
    });
    two.0 + two.1 < NARROW_M
}

/// Indices of the places to which a robot can drive straight from `from`.
fn seen(instance: &Instance, places: &[Vec2], from: Vec2) -> Vec<u32> {
    let is_seen = |&at: &u32| instance.is_way_free(from, places[at as usize], VISIBILITY_M - 1e-5);
    (0..places.len() as u32).filter(is_seen).collect()
}

/// Corners of a polygon around a wall. The sides of the polygon are `off_m` metres from the wall.
fn around(wall: &Obstacle, off_m: f64) -> Vec<Vec2> {
    match *wall {
        Obstacle::Disc { at, radius_m } => {
            let angle = core::f64::consts::TAU / f64::from(DISC_CORNERS);
            let reach = (radius_m + off_m) / (angle / 2.0).cos();
            (0..DISC_CORNERS).map(|corner| at + Vec2::unit(angle * f64::from(corner)) * reach).collect()
        }
        Obstacle::Rect { min, max } => {
            let (xs, ys) = ([min.x - off_m, max.x + off_m], [min.y - off_m, max.y + off_m]);
            xs.into_iter().flat_map(|x| ys.map(|y| Vec2::new(x, y))).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::roads::graph::steps_to;
    use lightbots_base::Limits;

    fn instance(gap_m: f64) -> Instance<'static> {
        let wall = |min: (f64, f64), max: (f64, f64)| Obstacle::Rect {
            min: Vec2::new(min.0, min.1),
            max: Vec2::new(max.0, max.1),
        };
        let problem = TransitionProblem {
            obstacles: vec![wall((-0.2, 0.1 + gap_m), (0.2, 0.5)), wall((-0.2, -0.5), (0.2, 0.1))],
            ..TransitionProblem::on_floor(Vec2::new(0.5, 0.5), Limits::ELISA_3)
        };
        Instance::new(&problem, &[]).unwrap()
    }

    #[test]
    fn a_gap_that_just_lets_a_robot_through_is_found() {
        let (start, end) = (Vec2::new(-0.4, -0.4), Vec2::new(0.4, -0.4));
        let just = instance(0.0602);
        let path = VisibilityGraph::new(&just).path(&just, start, end).unwrap();
        assert_eq!((path[0], path[path.len() - 1]), (start, end));
        assert!(path.windows(2).all(|leg| just.is_way_free(leg[0], leg[1], 0.003)), "{path:?}");
        let closed = instance(0.0598);
        assert_eq!(VisibilityGraph::new(&closed).path(&closed, start, end), None);
    }

    #[test]
    fn a_lattice_reaches_through_a_narrow_gap() {
        let instance = instance(0.064);
        let lattice = VisibilityGraph::new(&instance).lattice(&instance, 0.072).unwrap();
        let node = |x: f64| lattice.around(Vec2::new(x, -0.3), 0.2, 1)[0];
        assert!(steps_to(&lattice, node(-0.35))[node(0.35) as usize] < u16::MAX);
        let plain = Lattice::new(&instance, 0.072).unwrap();
        let node = |x: f64| plain.around(Vec2::new(x, -0.3), 0.2, 1)[0];
        assert_eq!(steps_to(&plain, node(-0.35))[node(0.35) as usize], u16::MAX);
        for (node, around) in lattice.neighbours.iter().enumerate() {
            for (direction, &other) in around.iter().enumerate().filter(|(_, other)| **other != NONE) {
                assert_eq!(lattice.neighbours[other as usize][(direction + 3) % 6] as usize, node);
                let (from, to) = (lattice.places[node], lattice.places[other as usize]);
                assert!(from.distance(to) > 0.0597 && instance.is_way_free(from, to, 0.0));
            }
        }
    }
}

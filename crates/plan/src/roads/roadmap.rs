//! The graph for stop-and-go trajectories. Its nodes are all starts and ends, places beside corners and in gaps, and a
//! lattice. Its edges are all lines between nodes that are short enough and free. The pitch is the distance between
//! neighbouring nodes of the lattice.

use lightbots_base::Vec2;
use lightbots_base::shape::{nearest_in_rect, point_to_segment};
use lightbots_show::Obstacle;

use crate::instance::Instance;
use crate::margins::ROADMAP_M;
use crate::roads::graph::{Graph, cheapest_paths};
use crate::roads::visibility::VisibilityGraph;

/// Length of the longest edge, in pitches.
const REACH: f64 = 1.5;
/// Least value of [`Roadmap::reach_m`], metres: edges may be this long even if the pitch is small.
const LEAST_REACH_M: f64 = 0.075;
/// Least distance of a node from others, in pitches. Starts, ends and places beside corners may be closer.
const APART: f64 = 0.5;
/// Most nodes in a row that begins beside a corner of a wall.
const MOST_IN_ROW: usize = 40;
/// Number of bisections that find the last free place of a row.
const HALVINGS: usize = 12;
/// Most nodes of a roadmap; larger roadmaps are not made.
const MOST_NODES: usize = 5_000;
/// Cost of each stop, as metres of path: about the distance that a robot drives in the time of a stop.
const STOP_M: f64 = 0.05;

/// A roadmap: places, the nodes, and the edges between them.
pub(crate) struct Roadmap {
    /// Place of each node, stage metres.
    pub places: Vec<Vec2>,
    /// `[node]`: the nodes with an edge to it, nearest first.
    pub edges: Vec<Vec<u32>>,
    /// `[node]`: whether only robots that start or end at the node may use it, because it is too near to a wall for
    /// others.
    is_private: Vec<bool>,
    /// `[robot]`: the node of its start.
    pub starts: Vec<u32>,
    /// `[robot]`: the node of its end; `None` if it may end anywhere.
    pub ends: Vec<Option<u32>>,
    /// Greatest length of an edge, metres.
    pub reach_m: f64,
    /// Half the extents, metres, of the rectangle that contains all nodes except starts and ends.
    inner: Vec2,
}

impl Roadmap {
    /// The roadmap of an instance, with a lattice of this pitch, metres. All nodes except starts and ends keep rims at
    /// least `off_edge_m` metres from the floor's edge. `None` if it would have more than [`MOST_NODES`], its lattice
    /// would be too large, or the planner is cancelled.
    pub fn new(
        instance: &Instance,
        visibility: &VisibilityGraph,
        pitch_m: f64,
        off_edge_m: f64,
    ) -> Option<Self> {
        // Each start is a node of its own.
        if instance.robots() > MOST_NODES {
            return None;
        }
        let lattice = visibility.lattice(instance, pitch_m)?;
        let reach_m = (pitch_m * REACH).max(LEAST_REACH_M);
        let (places, edges, is_private) = (Vec::new(), Vec::new(), Vec::new());
        let (starts, ends) = (Vec::new(), Vec::new());
        let inner = instance.inner - Vec2::new(off_edge_m, off_edge_m);
        let mut roads = Self { places, edges, is_private, starts, ends, reach_m, inner };
        roads.starts = instance.starts.iter().map(|&start| roads.node_at(start)).collect();
        roads.ends = instance.ends.iter().map(|end| end.map(|end| roads.node_at(end))).collect();
        for &place in visibility.places() {
            roads.add(instance, place, 1e-4);
        }
        for &place in &lattice.places {
            if instance.cancel.is_wanted() {
                return None;
            }
            roads.add(instance, place, pitch_m * APART);
        }
        for &place in visibility.places() {
            for direction in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
                roads.add_row(
                    instance,
                    place,
                    Vec2::new(direction.0, direction.1) * pitch_m,
                    pitch_m * APART,
                );
            }
        }
        if roads.places.len() > MOST_NODES {
            return None;
        }
        roads.connect(instance);
        Some(roads)
    }

    fn node_at(&mut self, place: Vec2) -> u32 {
        let known = self.places.iter().position(|other| *other == place);
        known.unwrap_or_else(|| {
            self.places.push(place);
            self.places.len() - 1
        }) as u32
    }

    fn add(&mut self, instance: &Instance, place: Vec2, apart_m: f64) {
        let within = |at: f64, most: f64| at.clamp(-most, most);
        let place = Vec2::new(within(place.x, self.inner.x), within(place.y, self.inner.y));
        let is_new = self.places.iter().all(|other| other.distance(place) >= apart_m);
        if is_new && self.places.len() <= MOST_NODES && instance.is_free(place, ROADMAP_M) {
            self.places.push(place);
        }
    }

    /// Adds nodes in a row from `from`, one `step` apart, as far as the line is free. The last node is at the end of
    /// the free line. Nodes closer than `apart_m` metres to others are left out.
    fn add_row(&mut self, instance: &Instance, from: Vec2, step: Vec2, apart_m: f64) {
        let mut at = from;
        for _ in 0..MOST_IN_ROW {
            if is_clear(instance, at, at + step) {
                at += step;
                self.add(instance, at, apart_m);
                continue;
            }
            let mut share = 0.0;
            for halving in 1..=HALVINGS {
                let more = share + 0.5_f64.powi(halving as i32);
                share = if is_clear(instance, at, at + step * more) { more } else { share };
            }
            self.add(instance, at + step * share, apart_m);
            return;
        }
    }

    fn connect(&mut self, instance: &Instance) {
        let count = self.places.len();
        self.is_private = self.places.iter().map(|&place| !instance.is_free(place, ROADMAP_M)).collect();
        let mut edges: Vec<Vec<u32>> = vec![Vec::new(); count];
        for a in (0..count).take_while(|_| !instance.cancel.is_wanted()) {
            for b in 0..a {
                let (from, to) = (self.places[a], self.places[b]);
                if from.distance(to) <= self.reach_m && is_clear(instance, from, to) {
                    edges[a].push(b as u32);
                    edges[b].push(a as u32);
                }
            }
        }
        for (node, beside) in edges.iter_mut().enumerate() {
            let far_m = |other: u32| self.places[other as usize].distance(self.places[node]);
            beside.sort_by(|&a, &b| far_m(a).total_cmp(&far_m(b)).then(a.cmp(&b)));
        }
        self.edges = edges;
    }

    /// Whether a robot may be at a node: the node is far enough from walls, or it is the robot's start or end.
    pub fn may_be(&self, robot: usize, node: u32) -> bool {
        !self.is_private[node as usize] || self.starts[robot] == node || self.ends[robot] == Some(node)
    }

    /// Returns `[node]`: cost of a robot's path from the node to its end, metres, with [`STOP_M`] for each stop.
    /// Infinite if there is no path; 0 for a spare robot.
    pub fn far_m(&self, robot: usize) -> Vec<f64> {
        let Some(end) = self.ends[robot] else { return vec![0.0; self.places.len()] };
        let cost = |from: u32, to: u32| match self.may_be(robot, to) {
            true => self.length_m(from, to) + STOP_M,
            false => f64::INFINITY,
        };
        cheapest_paths(self, [(end, 0.0)], cost).costs
    }
}

impl Graph for Roadmap {
    fn places(&self) -> &[Vec2] {
        &self.places
    }

    fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> {
        self.edges[node as usize].iter().copied()
    }
}

/// Whether a robot can drive straight from one place to another on the floor, with its rim [`ROADMAP_M`] from every
/// wall. If the robot is closer to a wall at an end of the line, the line only has to keep that smaller distance.
fn is_clear(instance: &Instance, from: Vec2, to: Vec2) -> bool {
    let on_floor = |at: Vec2| at.x.abs() <= instance.inner.x + 1e-6 && at.y.abs() <= instance.inner.y + 1e-6;
    on_floor(from)
        && on_floor(to)
        && instance.walls.iter().enumerate().all(|(wall, shape)| {
            let ends_m = instance.off_wall(wall, from).0.min(instance.off_wall(wall, to).0);
            let least_m = instance.limits.radius_m + ROADMAP_M.min(ends_m - 1e-9);
            off_shape(shape, from, to) >= least_m
        })
}

/// Distance of a straight line from a shape, metres; 0 if the line goes through the shape.
fn off_shape(shape: &Obstacle, from: Vec2, to: Vec2) -> f64 {
    let to_line = |place: Vec2| point_to_segment(place, from, to);
    match *shape {
        Obstacle::Disc { at, radius_m } => (to_line(at) - radius_m).max(0.0),
        Obstacle::Rect { min, max } => {
            if meets(min, max, from, to) {
                return 0.0;
            }
            let corners = [min, Vec2::new(min.x, max.y), max, Vec2::new(max.x, min.y)].map(to_line);
            let ends = [from, to].map(|at| at.distance(nearest_in_rect(at, min, max)));
            corners.into_iter().chain(ends).fold(f64::INFINITY, f64::min)
        }
    }
}

/// Whether a straight line touches a rectangle or goes through it (Liang and Barsky 1984).
fn meets(min: Vec2, max: Vec2, from: Vec2, to: Vec2) -> bool {
    let line = to - from;
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for (at, along, low, high) in [(from.x, line.x, min.x, max.x), (from.y, line.y, min.y, max.y)] {
        if along == 0.0 {
            if at < low || at > high {
                return false;
            }
            continue;
        }
        let (a, b) = ((low - at) / along, (high - at) / along);
        (enters, leaves) = (enters.max(a.min(b)), leaves.min(a.max(b)));
    }
    enters <= leaves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use lightbots_base::Limits;

    #[test]
    fn a_line_is_as_far_off_a_rectangle_as_its_nearest_point() {
        let shape = Obstacle::Rect { min: Vec2::ZERO, max: Vec2::new(1.0, 1.0) };
        let off = |from: (f64, f64), to: (f64, f64)| {
            off_shape(&shape, Vec2::new(from.0, from.1), Vec2::new(to.0, to.1))
        };
        assert_eq!(off((-1.0, 0.5), (2.0, 0.6)), 0.0);
        assert_eq!(off((0.2, 0.2), (0.3, 0.3)), 0.0);
        assert!((off((2.0, 0.0), (0.0, 2.0)) - 0.0).abs() < 1e-12);
        assert!((off((3.0, 0.0), (0.0, 3.0)) - 0.5_f64.sqrt()).abs() < 1e-12);
        assert!((off((-1.0, 1.25), (3.0, 1.25)) - 0.25).abs() < 1e-12);
        assert!((off((1.5, 0.5), (4.0, 0.5)) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn every_way_is_free_and_leads_back() {
        let wall = |min: (f64, f64), max: (f64, f64)| Obstacle::Rect {
            min: Vec2::new(min.0, min.1),
            max: Vec2::new(max.0, max.1),
        };
        let problem = TransitionProblem {
            starts: vec![Vec2::new(-0.4, 0.0)],
            goals: vec![Vec2::new(0.4, 0.0)],
            obstacles: vec![wall((-0.1, 0.0305), (0.1, 0.2)), wall((-0.1, -0.2), (0.1, -0.0305))],
            ..TransitionProblem::on_floor(Vec2::new(0.5, 0.2), Limits::ELISA_3)
        };
        let instance = Instance::new(&problem, &[Some(0)]).unwrap();
        let roads = Roadmap::new(&instance, &VisibilityGraph::new(&instance), 0.072, 0.0).unwrap();
        assert!(roads.far_m(0)[roads.starts[0] as usize] < 1.6, "through the gap");
        for (node, beside) in roads.edges.iter().enumerate() {
            for &other in beside {
                assert!(roads.edges[other as usize].contains(&(node as u32)));
                let (from, to) = (roads.places[node], roads.places[other as usize]);
                let sampled = (0..=50).map(|i| from.lerp(to, f64::from(i) / 50.0));
                assert!(sampled.into_iter().all(|at| instance.is_free(at, 0.003)));
            }
        }
    }
}

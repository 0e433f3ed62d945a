//! A hexagonal lattice over the floor: the densest packing of discs, with six directions at each node.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::margins::MARGIN_M;
use crate::roads::graph::{Graph, NONE};

/// Most near nodes that are considered as neighbours of an added node.
const MOST_BESIDE: usize = 24;
/// Most nodes of a lattice, counted as if no place were blocked; larger lattices are not made.
const MOST_NODES: usize = 200_000;

/// A lattice: free places on the floor, the nodes, and their neighbours.
pub(crate) struct Lattice {
    /// Place of each node, stage metres.
    pub places: Vec<Vec2>,
    /// `[node][direction]`: the neighbour in direction k, which points at k · 60° from the x axis; [`NONE`] if there is
    /// no edge. At an added node, the true direction is up to 30° off.
    pub neighbours: Vec<[u32; 6]>,
    /// Distance between neighbours in rows and columns, metres.
    pub pitch_m: f64,
    columns: i64,
    rows: i64,
    /// Place of row 0, column 0, stage metres.
    corner: Vec2,
    /// `[row][column]`: its node, or [`NONE`].
    nodes: Vec<u32>,
    /// Number of nodes in rows and columns. Nodes with greater indices were added at other places.
    in_rows: usize,
}

impl Lattice {
    /// The lattice of an instance's floor with this pitch, metres. `None` if it would have more than [`MOST_NODES`].
    pub fn new(instance: &Instance, pitch_m: f64) -> Option<Self> {
        Self::around_places(instance, pitch_m, &[], 0.0)
    }

    /// [`Self::new`], but without nodes nearer than `apart_m` metres to any of `places`.
    pub fn around_places(instance: &Instance, pitch_m: f64, places: &[Vec2], apart_m: f64) -> Option<Self> {
        let rise = pitch_m * 3.0_f64.sqrt() / 2.0;
        let (width, depth) = (instance.inner.x * 2.0, instance.inner.y * 2.0);
        let (columns, rows) = ((width / pitch_m).floor() + 1.0, (depth / rise).floor() + 1.0);
        if columns * rows > MOST_NODES as f64 {
            return None;
        }
        let slack = Vec2::new(width - (columns - 0.5) * pitch_m, depth - (rows - 1.0) * rise) / 2.0;
        let corner = Vec2::new(slack.x.max(0.0), slack.y) - instance.inner;
        let (columns, rows) = (columns as i64, rows as i64);
        let mut lattice = Self {
            places: Vec::new(),
            neighbours: Vec::new(),
            pitch_m,
            columns,
            rows,
            corner,
            nodes: vec![NONE; (columns * rows) as usize],
            in_rows: 0,
        };
        lattice.lay_out(instance, rise, |at| places.iter().all(|place| place.distance(at) >= apart_m));
        lattice.in_rows = lattice.places.len();
        lattice.connect(instance);
        Some(lattice)
    }

    fn lay_out(&mut self, instance: &Instance, rise: f64, is_wanted: impl Fn(Vec2) -> bool) {
        for row in (0..self.rows).take_while(|_| !instance.cancel.is_wanted()) {
            for column in 0..self.columns {
                let shift = if row % 2 == 1 { 0.5 } else { 0.0 };
                let place =
                    self.corner + Vec2::new((column as f64 + shift) * self.pitch_m, row as f64 * rise);
                if instance.is_free(place, MARGIN_M) && is_wanted(place) {
                    self.nodes[(row * self.columns + column) as usize] = self.places.len() as u32;
                    self.places.push(place);
                }
            }
        }
    }

    fn connect(&mut self, instance: &Instance) {
        self.neighbours = vec![[NONE; 6]; self.places.len()];
        for row in (0..self.rows).take_while(|_| !instance.cancel.is_wanted()) {
            let odd = row % 2;
            let around = [(1, 0), (odd, 1), (odd - 1, 1), (-1, 0), (odd - 1, -1), (odd, -1)];
            for column in 0..self.columns {
                let node = self.node(row, column);
                if node == NONE {
                    continue;
                }
                for (direction, (right, up)) in around.into_iter().enumerate() {
                    let other = self.node(row + up, column + right);
                    if other == NONE {
                        continue;
                    }
                    let middle = self.places[node as usize].lerp(self.places[other as usize], 0.5);
                    if instance.walls.is_empty() || instance.is_free(middle, 0.0) {
                        self.neighbours[node as usize][direction] = other;
                    }
                }
            }
        }
    }

    /// Adds a node at any place. Connects it to nodes within `reach_m` metres for which `is_beside` holds, nearest
    /// first, at most one in each of six directions.
    pub fn add(&mut self, place: Vec2, reach_m: f64, is_beside: impl Fn(Vec2) -> bool) {
        let node = self.places.len() as u32;
        let near = self.around(place, reach_m, MOST_BESIDE);
        self.places.push(place);
        self.neighbours.push([NONE; 6]);
        for other in near {
            let at = self.places[other as usize];
            let turn = (at - place).angle() / core::f64::consts::FRAC_PI_3;
            let direction = turn.round().rem_euclid(6.0) as usize % 6;
            let back = (direction + 3) % 6;
            let is_free = self.neighbours[node as usize][direction] == NONE
                && self.neighbours[other as usize][back] == NONE;
            if is_free && is_beside(at) {
                self.neighbours[node as usize][direction] = other;
                self.neighbours[other as usize][back] = node;
            }
        }
    }

    fn node(&self, row: i64, column: i64) -> u32 {
        let inside = (0..self.rows).contains(&row) && (0..self.columns).contains(&column);
        if inside { self.nodes[(row * self.columns + column) as usize] } else { NONE }
    }

    /// The nodes within `reach_m` metres of a place, nearest first, at most `most`.
    pub fn around(&self, place: Vec2, reach_m: f64, most: usize) -> Vec<u32> {
        let rise = self.pitch_m * 3.0_f64.sqrt() / 2.0;
        let from = place - self.corner;
        let rows = ((from.y - reach_m) / rise).floor() as i64..=((from.y + reach_m) / rise).ceil() as i64;
        let left = ((from.x - reach_m) / self.pitch_m).floor() as i64 - 1;
        let right = ((from.x + reach_m) / self.pitch_m).ceil() as i64;
        let mut found: Vec<(f64, u32)> = Vec::new();
        for row in rows {
            for column in left..=right {
                let node = self.node(row, column);
                if node == NONE {
                    continue;
                }
                let far = self.places[node as usize].distance(place);
                if far <= reach_m {
                    found.push((far, node));
                }
            }
        }
        let others = self.places.iter().enumerate().skip(self.in_rows);
        let others = others.map(|(node, at)| (at.distance(place), node as u32));
        found.extend(others.filter(|(far, _)| *far <= reach_m));
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.truncate(most);
        found.into_iter().map(|(_, node)| node).collect()
    }
}

impl Graph for Lattice {
    fn places(&self) -> &[Vec2] {
        &self.places
    }

    fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> {
        self.neighbours[node as usize].into_iter().filter(|&node| node != NONE)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::roads::graph::steps_to;
    use lightbots_base::Limits;
    use lightbots_show::{Easing, Obstacle};

    fn instance(obstacles: Vec<Obstacle>) -> Instance<'static> {
        let problem = TransitionProblem {
            starts: Vec::new(),
            goals: Vec::new(),
            pinned: Vec::new(),
            standing: Vec::new(),
            obstacles,
            half_floor: Vec2::new(0.5, 0.5),
            limits: Limits::ELISA_3,
            duration: None,
            easing: Easing::Swift,
            prescribed: None,
        };
        Instance::new(&problem, &[]).unwrap()
    }

    #[test]
    fn neighbours_lie_in_their_direction_and_know_each_other() {
        let lattice = Lattice::new(&instance(Vec::new()), 0.072).unwrap();
        let mut edges = 0;
        for (node, around) in lattice.neighbours.iter().enumerate() {
            for (direction, &other) in around.iter().enumerate().filter(|(_, other)| **other != NONE) {
                let edge = lattice.places[other as usize] - lattice.places[node];
                let ideal = Vec2::unit(direction as f64 * std::f64::consts::FRAC_PI_3) * 0.072;
                assert!(edge.distance(ideal) < 1e-9);
                assert_eq!(lattice.neighbours[other as usize][(direction + 3) % 6] as usize, node);
                edges += 1;
            }
        }
        assert!(edges > 5 * lattice.places.len(), "{edges}");
    }

    #[test]
    fn steps_lead_around_walls() {
        let wall = Obstacle::Rect { min: Vec2::new(-0.02, -0.5), max: Vec2::new(0.02, 0.3) };
        let lattice = Lattice::new(&instance(vec![wall]), 0.072).unwrap();
        let near = |x: f64, y: f64| lattice.around(Vec2::new(x, y), 0.1, 1)[0];
        let steps = steps_to(&lattice, near(0.3, -0.4));
        assert!(steps[near(0.3, 0.0) as usize] <= 6);
        assert!(steps[near(-0.3, -0.4) as usize] > 18);
    }
}

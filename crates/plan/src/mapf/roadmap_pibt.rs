//! One step of all robots on a roadmap: priority inheritance with backtracking (PIBT; Okumura et al. 2022), with exact
//! distances as its conflict rule. All robots of a step leave, drive and arrive together, so their relative motion is
//! a straight line, and its least distance from the origin is exact.

use crate::instance::Instance;
use crate::mapf::lacam::{Constraint, Generator};
use crate::roads::roadmap::{Roadmap, nearest};

/// Not decided yet.
const OPEN: u32 = u32::MAX;
/// Most moves tried for one robot and all that it pushes.
const MOST_TRIES: usize = 600;
/// Longest row of robots that one may push.
const MOST_PUSHED: usize = 200;
/// Cost of one node in the search for all distances, in looks at pairs.
const LOOKS_A_NODE: usize = 10;
/// Cost of pushing a robot, metres.
const PUSH_M: f64 = 0.02;

/// Memory of a step; kept between steps.
pub(crate) struct RoadmapPibt<'a> {
    instance: &'a Instance<'a>,
    roads: &'a Roadmap,
    /// `[robot][node]`: cost to its end.
    far_m: Vec<Vec<f64>>,
    now: Vec<u32>,
    next: Vec<u32>,
    /// Decided robots, in order.
    decided: Vec<usize>,
    /// `[robot]`: robots that may be in its way in this step.
    near: Vec<Vec<usize>>,
    tries: usize,
    /// Pairs that may still be looked at.
    looks: usize,
}

impl<'a> RoadmapPibt<'a> {
    /// For all robots of an instance, and this many looks at pairs.
    pub fn new(instance: &'a Instance<'a>, roads: &'a Roadmap, looks: usize) -> Self {
        let robots = instance.robots();
        // The search for all distances costs about as much as a few looks for each node.
        let looks = looks.saturating_sub(robots * roads.places.len() * LOOKS_A_NODE);
        let far_m = |robot: usize| match instance.cancel.is_wanted() {
            true => vec![f64::INFINITY; roads.places.len()],
            false => roads.far_m(robot),
        };
        Self {
            instance,
            roads,
            far_m: (0..robots).map(far_m).collect(),
            now: Vec::new(),
            next: vec![OPEN; robots],
            decided: Vec::new(),
            near: vec![Vec::new(); robots],
            tries: 0,
            looks,
        }
    }

    /// Whether the planner is cancelled.
    pub fn is_given_up(&self) -> bool {
        self.instance.cancel.is_wanted()
    }

    /// Looks that are left.
    pub fn looks_left(&self) -> usize {
        self.looks
    }

    /// Cost of a robot from a node to its end.
    pub fn far_m(&self, robot: usize, node: u32) -> f64 {
        self.far_m[robot][node as usize]
    }

    /// Whether two moves `(robot, from, to)` keep their distance at the same time.
    pub fn are_apart(&self, a: (usize, u32, u32), b: (usize, u32, u32)) -> bool {
        let place = |node: u32| self.roads.places[node as usize];
        let closest = nearest(place(a.1) - place(b.1), place(a.2) - place(b.2)).length_squared();
        let wide_m = self.instance.widest_gap_m();
        closest >= wide_m * wide_m || {
            let gap_m = self.instance.least_gap(a.0, b.0);
            closest >= gap_m * gap_m
        }
    }

    fn look_around(&mut self) {
        self.looks = self.looks.saturating_sub(self.now.len() * self.now.len() / 8);
        let reach_m = 2.0 * self.roads.reach_m + self.instance.widest_gap_m();
        let place = |robot: usize| self.roads.places[self.now[robot] as usize];
        for a in 0..self.now.len() {
            self.near[a].clear();
            for b in 0..a {
                if (place(a) - place(b)).length_squared() < reach_m * reach_m {
                    self.near[a].push(b);
                    self.near[b].push(a);
                }
            }
        }
    }

    /// Robots that must make way for a move; `None` where it conflicts with what is decided.
    fn pushed_by(&self, robot: usize, node: u32) -> Option<Vec<usize>> {
        let mine = (robot, self.now[robot], node);
        let mut pushed = Vec::new();
        for &other in &self.near[robot] {
            let (from, to) = (self.now[other], self.next[other]);
            let is_open = to == OPEN;
            if !self.are_apart(mine, (other, from, if is_open { from } else { to })) {
                if !is_open {
                    return None;
                }
                pushed.push(other);
            }
        }
        Some(pushed)
    }

    fn decide(&mut self, robot: usize, node: u32) {
        self.next[robot] = node;
        self.decided.push(robot);
    }

    fn undo(&mut self, mark: usize) {
        for robot in self.decided.drain(mark..) {
            self.next[robot] = OPEN;
        }
    }

    /// Decides a move and those of all robots that must make way for it, or nothing.
    fn goes(&mut self, robot: usize, node: u32, depth: usize) -> bool {
        self.looks = self.looks.saturating_sub(self.near[robot].len() + 1);
        let Some(pushed) = self.pushed_by(robot, node) else { return false };
        if self.tries == 0 || self.looks == 0 || (depth >= MOST_PUSHED && !pushed.is_empty()) {
            return false;
        }
        self.tries -= 1;
        let mark = self.decided.len();
        self.decide(robot, node);
        let all = pushed.into_iter().all(|other| self.next[other] != OPEN || self.choose(other, depth + 1));
        if !all {
            self.undo(mark);
        }
        all
    }

    /// Lets a robot choose, and then the robots in its way. Returns whether there was a choice.
    fn choose(&mut self, robot: usize, depth: usize) -> bool {
        let here = self.now[robot];
        let place = |node: u32| self.roads.places[node as usize];
        let far_m = &self.far_m[robot];
        let costs = |node: u32| {
            let is_taken = self.near[robot].iter().any(|&other| self.now[other] == node);
            far_m[node as usize]
                + if is_taken { PUSH_M } else { 0.0 }
                + place(here).distance(place(node)) * 1e-3
        };
        let mut choices: Vec<(f64, u32)> =
            self.around(robot, here).chain([here]).map(|node| (costs(node), node)).collect();
        choices.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        choices.into_iter().any(|(_, node)| self.goes(robot, node, depth))
    }
}

impl Generator for RoadmapPibt<'_> {
    fn around(&self, robot: usize, node: u32) -> impl Iterator<Item = u32> {
        let edges = self.roads.edges[node as usize].iter().copied();
        edges.filter(move |&next| self.roads.may_be(robot, next))
    }

    fn far(&self, robot: usize, node: u32) -> f64 {
        self.far_m(robot, node)
    }

    fn step(&mut self, now: &[u32], ranks: &[usize], constraints: &[Constraint]) -> Option<Vec<u32>> {
        self.now.clear();
        self.now.extend_from_slice(now);
        self.undo(0);
        self.look_around();
        // Constraints first, and then the robots in their way: with a constraint for each robot, every legal step is
        // made.
        let mut pushed = Vec::new();
        for &(robot, node) in constraints {
            pushed.extend(self.pushed_by(robot, node)?);
            self.decide(robot, node);
        }
        for robot in pushed {
            self.tries = MOST_TRIES;
            if self.next[robot] == OPEN && !self.choose(robot, 0) {
                return None;
            }
        }
        for &robot in ranks {
            self.tries = MOST_TRIES;
            if self.next[robot] == OPEN && !self.choose(robot, 0) {
                // No decided robot comes near one that stays.
                self.decide(robot, now[robot]);
            }
        }
        Some(self.next.clone())
    }

    fn is_spent(&self) -> bool {
        self.looks == 0 || self.instance.cancel.is_wanted()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::roads::visibility::VisibilityGraph;
    use lightbots_base::{Limits, Vec2};

    fn instance(starts: Vec<Vec2>, goals: Vec<Vec2>) -> Instance<'static> {
        let ends: Vec<Option<usize>> = (0..starts.len()).map(Some).collect();
        let floor = TransitionProblem::on_floor(Vec2::new(0.3, 0.3), Limits::ELISA_3);
        Instance::new(&TransitionProblem { starts, goals, ..floor }, &ends).unwrap()
    }

    #[test]
    fn who_meets_on_the_way_is_not_apart_though_both_ends_are() {
        let (left, right, up) = (Vec2::new(-0.04, 0.0), Vec2::new(0.04, 0.0), Vec2::new(-0.04, 0.1));
        let instance = instance(vec![left, right, up], vec![right, left, up]);
        let roads = Roadmap::new(&instance, &VisibilityGraph::new(&instance), 0.072, 0.0).unwrap();
        let pibt = RoadmapPibt::new(&instance, &roads, usize::MAX);
        assert!(!pibt.are_apart((0, 0, 1), (1, 1, 0)), "through each other");
        assert!(pibt.are_apart((0, 0, 1), (2, 2, 0)), "one follows the other around a corner");
        assert!(pibt.are_apart((0, 0, 0), (1, 1, 1)) && !pibt.are_apart((0, 0, 1), (1, 1, 1)));
    }

    #[test]
    fn a_step_that_is_ordered_whole_is_made_as_ordered_or_not_at_all() {
        // Three robots so close in a ring that they can only move together.
        let place = |third: i32| Vec2::unit(f64::from(third) * std::f64::consts::TAU / 3.0) * 0.068;
        let instance = instance((0..3).map(place).collect(), (1..4).map(place).collect());
        let roads = Roadmap::new(&instance, &VisibilityGraph::new(&instance), 0.072, 0.0).unwrap();
        let mut pibt = RoadmapPibt::new(&instance, &roads, usize::MAX);
        let starts = roads.starts.clone();
        let around = [(0, starts[1]), (1, starts[2]), (2, starts[0])];
        let made = pibt.step(&starts, &[0, 1, 2], &around);
        assert_eq!(made, Some(vec![starts[1], starts[2], starts[0]]));
        assert_eq!(pibt.step(&starts, &[0, 1, 2], &[(0, starts[1]), (1, starts[0])]), None);
        let next = pibt.step(&starts, &[2, 1, 0], &[]).unwrap();
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            assert!(pibt.are_apart((a, starts[a], next[a]), (b, starts[b], next[b])));
        }
    }
}

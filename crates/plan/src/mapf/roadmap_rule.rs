//! The conflict rule of a roadmap: exact distances. All robots that move in a step leave, drive and arrive together.
//! The motion of one robot relative to another is therefore a straight line, and their least distance is exact.

use crate::instance::Instance;
use crate::mapf::pibt::{ConflictRule, Moves, Pibt, PibtBounds};
use crate::roads::graph::Graph;
use crate::roads::roadmap::Roadmap;
use lightbots_base::Vec2;
use lightbots_base::shape::point_to_segment_squared;

/// Most moves tried for one robot and all robots that it pushes.
const MOST_TRIES: usize = 600;
/// Longest chain of robots in which each pushes the next.
const MOST_PUSHED: usize = 200;
/// Work for one node in the search for one robot's distances, as a number of checks of pairs.
const LOOKS_A_NODE: usize = 10;
/// Comparing the distances of this many pairs of robots counts as one check of two robots' moves.
const LOOKS_A_PAIR: usize = 8;
/// Cost of a move to a node on which another robot is, as metres of path.
const PUSH_M: f64 = 0.02;
/// Cost of each metre of a move, as metres of path. It decides between nodes that are equally far from the robot's end.
const METRE: f64 = 1e-3;

/// Costs of robots' paths to their ends on a roadmap, and the pairs of robots that may conflict in a step.
pub(crate) struct RoadmapRule<'a> {
    instance: &'a Instance<'a>,
    roads: &'a Roadmap,
    /// `[robot][node]`: cost of the robot's path from the node to its end, with stops, metres.
    far_m: Vec<Vec<f64>>,
    /// `[robot]`: robots close enough to conflict with it in this step.
    near: Vec<Vec<usize>>,
}

/// A step generator for all robots of an instance, which may check `looks` pairs of robots.
pub(crate) fn roadmap_pibt<'a>(
    instance: &'a Instance<'a>,
    roads: &'a Roadmap,
    looks: usize,
) -> Pibt<'a, RoadmapRule<'a>> {
    let robots = instance.robots();
    // The search for the distances uses part of the budget.
    let looks = looks.saturating_sub(robots * roads.places.len() * LOOKS_A_NODE);
    let far_m = |robot: usize| match instance.cancel.is_wanted() {
        true => vec![f64::INFINITY; roads.places.len()],
        false => roads.far_m(robot),
    };
    let rule = RoadmapRule {
        instance,
        roads,
        far_m: (0..robots).map(far_m).collect(),
        near: vec![Vec::new(); robots],
    };
    let bounds = PibtBounds { tries: MOST_TRIES, pushed: MOST_PUSHED, looks };
    Pibt::new(rule, robots, bounds, instance.cancel)
}

impl RoadmapRule<'_> {
    /// Whether the planner is cancelled.
    pub fn is_given_up(&self) -> bool {
        self.instance.cancel.is_wanted()
    }

    /// Whether two robots keep the distance that they must keep, if both move in the same step. A move is `(robot, node
    /// before, node after)`.
    pub fn are_apart(&self, a: (usize, u32, u32), b: (usize, u32, u32)) -> bool {
        let place = |node: u32| self.roads.place(node);
        let (begin, end) = (place(a.1) - place(b.1), place(a.2) - place(b.2));
        let closest = point_to_segment_squared(Vec2::ZERO, begin, end);
        let wide_m = self.instance.widest_gap_m();
        closest >= wide_m * wide_m || {
            let gap_m = self.instance.least_gap(a.0, b.0);
            closest >= gap_m * gap_m
        }
    }
}

impl ConflictRule for RoadmapRule<'_> {
    fn around(&self, robot: usize, node: u32) -> impl Iterator<Item = u32> {
        self.roads.neighbours(node).filter(move |&next| self.roads.may_be(robot, next))
    }

    fn far(&self, robot: usize, node: u32) -> f64 {
        self.far_m[robot][node as usize]
    }

    fn reluctance(&self, moves: &Moves, robot: usize, node: u32) -> f64 {
        let is_taken = self.near[robot].iter().any(|&other| moves.now[other] == node);
        let push_m = if is_taken { PUSH_M } else { 0.0 };
        self.far(robot, node) + push_m + self.roads.length_m(moves.now[robot], node) * METRE
    }

    fn begin(&mut self, now: &[u32]) -> usize {
        let reach_m = 2.0 * self.roads.reach_m + self.instance.widest_gap_m();
        let place = |robot: usize| self.roads.place(now[robot]);
        for a in 0..now.len() {
            self.near[a].clear();
            for b in 0..a {
                if (place(a) - place(b)).length_squared() < reach_m * reach_m {
                    self.near[a].push(b);
                    self.near[b].push(a);
                }
            }
        }
        now.len() * now.len() / LOOKS_A_PAIR
    }

    fn may_go(&self, moves: &Moves, robot: usize, node: u32, must_make_way: &mut Vec<usize>) -> bool {
        let mine = (robot, moves.now[robot], node);
        self.near[robot].iter().all(|&other| {
            let (is_decided, from) = (moves.is_decided(other), moves.now[other]);
            let to = if is_decided { moves.next[other] } else { from };
            if self.are_apart(mine, (other, from, to)) {
                return true;
            }
            if !is_decided {
                must_make_way.push(other);
            }
            !is_decided
        })
    }

    fn looks(&self, robot: usize) -> usize {
        self.near[robot].len() + 1
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
    fn robots_that_meet_on_their_paths_are_not_apart_though_both_ends_are() {
        let (left, right, up) = (Vec2::new(-0.04, 0.0), Vec2::new(0.04, 0.0), Vec2::new(-0.04, 0.1));
        let instance = instance(vec![left, right, up], vec![right, left, up]);
        let roads = Roadmap::new(&instance, &VisibilityGraph::new(&instance), 0.072, 0.0).unwrap();
        let pibt = roadmap_pibt(&instance, &roads, usize::MAX);
        assert!(!pibt.rule.are_apart((0, 0, 1), (1, 1, 0)), "through each other");
        assert!(pibt.rule.are_apart((0, 0, 1), (2, 2, 0)), "one follows the other around a corner");
        assert!(pibt.rule.are_apart((0, 0, 0), (1, 1, 1)) && !pibt.rule.are_apart((0, 0, 1), (1, 1, 1)));
    }

    #[test]
    fn a_step_that_is_ordered_whole_is_made_as_ordered_or_not_at_all() {
        // Three robots in a ring, too close to move other than together.
        let place = |third: i32| Vec2::unit(f64::from(third) * std::f64::consts::TAU / 3.0) * 0.068;
        let instance = instance((0..3).map(place).collect(), (1..4).map(place).collect());
        let roads = Roadmap::new(&instance, &VisibilityGraph::new(&instance), 0.072, 0.0).unwrap();
        let mut pibt = roadmap_pibt(&instance, &roads, usize::MAX);
        let starts = roads.starts.clone();
        let around = [(0, starts[1]), (1, starts[2]), (2, starts[0])];
        let made = pibt.step(&starts, &[0, 1, 2], &around);
        assert_eq!(made, Some(vec![starts[1], starts[2], starts[0]]));
        assert_eq!(pibt.step(&starts, &[0, 1, 2], &[(0, starts[1]), (1, starts[0])]), None);
        let next = pibt.step(&starts, &[2, 1, 0], &[]).unwrap();
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            assert!(pibt.rule.are_apart((a, starts[a], next[a]), (b, starts[b], next[b])));
        }
    }
}

//! Shortens a solution of the depth-first search [`super::lacam`]. One robot after the other searches its cheapest path
//! through space and time while all others keep their paths. Then steps in which no robot moves are removed. The
//! solution never gets more steps.

use crate::mapf::pibt::ConflictRule;
use crate::mapf::roadmap_rule::RoadmapRule;
use crate::roads::graph::Graph;
use crate::roads::roadmap::Roadmap;

/// Most rounds over all robots.
const ROUNDS: usize = 4;
/// Most checks of two robots' moves in all rounds.
const MOST_LOOKS: usize = 30_000_000;
/// Cost of a step in which the robot waits at a node that is not its end.
const WAIT: f64 = 1.0;
/// Cost of a move. It exceeds [`WAIT`], so that robots do not move in vain.
const MOVE: f64 = 1.5;
/// Cost of each metre of a move.
const METRE: f64 = 4.0;
/// Marks a node that was not reached.
const NOWHERE: u32 = u32::MAX;

/// Returns a solution in at most as many steps as `steps[step][robot]`. Starts stay the same, and ends too, except that
/// spare robots may end elsewhere.
pub(crate) fn shorten(rule: &RoadmapRule, roads: &Roadmap, mut steps: Vec<Vec<u32>>) -> Vec<Vec<u32>> {
    let mut looks = MOST_LOOKS;
    for _ in 0..ROUNDS {
        let mut is_better = false;
        for robot in (0..roads.starts.len()).take_while(|_| !rule.is_given_up()) {
            let mut search = SingleRobotSearch { rule, roads, steps: &steps, robot, looks };
            let path = search.best();
            looks = search.looks;
            let Some(path) = path else { continue };
            is_better |= steps.iter().zip(&path).any(|(step, node)| step[robot] != *node);
            steps.iter_mut().zip(path).for_each(|(step, node)| step[robot] = node);
        }
        steps.dedup();
        if !is_better {
            break;
        }
    }
    steps
}

/// The search for one robot's path while all other robots keep theirs.
struct SingleRobotSearch<'a> {
    rule: &'a RoadmapRule<'a>,
    roads: &'a Roadmap,
    steps: &'a [Vec<u32>],
    robot: usize,
    looks: usize,
}

impl SingleRobotSearch<'_> {
    /// Returns `[step]`: the node of the robot on its cheapest path. `None` if there is no path, or `looks` are used
    /// up.
    fn best(&mut self) -> Option<Vec<u32>> {
        let nodes = self.roads.places.len();
        let last = self.steps.len() - 1;
        let mut costs = vec![f64::INFINITY; nodes];
        costs[self.roads.starts[self.robot] as usize] = 0.0;
        let mut before: Vec<Vec<u32>> = Vec::with_capacity(last);
        for step in 0..last {
            let (after, from) = self.spread(step, &costs)?;
            before.push(from);
            costs = after;
        }
        let end = self.roads.ends[self.robot].or_else(|| {
            let cheapest = (0..nodes).min_by(|&a, &b| costs[a].total_cmp(&costs[b]));
            cheapest.map(|node| node as u32)
        })?;
        let mut path = vec![end];
        for from in before.iter().rev() {
            path.push(from[path[path.len() - 1] as usize]);
        }
        path.reverse();
        (!path.contains(&NOWHERE)).then_some(path)
    }

    /// Returns `[node]`: the least cost of being there after a step, and the node before the step. `costs` are those
    /// before the step. `None` if `looks` are used up.
    fn spread(&mut self, step: usize, costs: &[f64]) -> Option<(Vec<f64>, Vec<u32>)> {
        let mut after = vec![f64::INFINITY; costs.len()];
        let mut from = vec![NOWHERE; costs.len()];
        let end = self.roads.ends[self.robot];
        for here in (0..costs.len() as u32).filter(|&node| costs[node as usize] < f64::INFINITY) {
            let wait = if end.is_none_or(|end| end == here) { 0.0 } else { WAIT };
            let stays = [(here, wait)];
            let moves = self.rule.around(self.robot, here);
            let moves = moves.map(|to| (to, MOVE + METRE * self.roads.length_m(here, to)));
            for (to, cost) in stays.into_iter().chain(moves) {
                let whole = costs[here as usize] + cost;
                if whole >= after[to as usize] {
                    continue;
                }
                self.looks = self.looks.checked_sub(self.roads.starts.len())?;
                if self.is_clear(step, here, to) {
                    (after[to as usize], from[to as usize]) = (whole, here);
                }
            }
        }
        Some((after, from))
    }

    fn is_clear(&self, step: usize, here: u32, to: u32) -> bool {
        let (now, next) = (&self.steps[step], &self.steps[step + 1]);
        let mut others = (0..now.len()).filter(|&other| other != self.robot);
        others.all(|other| self.rule.are_apart((self.robot, here, to), (other, now[other], next[other])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::instance::Instance;
    use crate::mapf::roadmap_rule::roadmap_pibt;
    use crate::roads::visibility::VisibilityGraph;
    use lightbots_base::{Limits, Vec2};

    #[test]
    fn detours_are_left_out_and_a_robot_in_the_way_still_makes_way() {
        let at = |x: f64, y: f64| Vec2::new(x, y);
        let floor = TransitionProblem::on_floor(at(0.3, 0.3), Limits::ELISA_3);
        let starts = vec![at(-0.15, 0.0), at(0.0, 0.0)];
        let goals = vec![at(0.15, 0.0), at(0.0, 0.0)];
        let instance =
            Instance::new(&TransitionProblem { starts, goals, ..floor }, &[Some(0), Some(1)]).unwrap();
        let roads = Roadmap::new(&instance, &VisibilityGraph::new(&instance), 0.072, 0.0).unwrap();
        let pibt = roadmap_pibt(&instance, &roads, usize::MAX);
        // The first robot drives far around the second, back, and around it again.
        let mut path = vec![roads.starts[0]];
        let far_m = pibt.rule.far(0, path[0]);
        let node = |x: f64, y: f64| {
            let far = |node: &u32| roads.places[*node as usize].distance(at(x, y));
            (0..roads.places.len() as u32).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap()
        };
        let around = [(-0.15, 0.1), (-0.08, 0.14), (0.0, 0.14), (0.08, 0.14), (0.15, 0.1)];
        path.extend(around.map(|(x, y)| node(x, y)));
        path.extend(around.map(|(x, y)| node(x, y)).iter().rev());
        path.extend(around.map(|(x, y)| node(x, y)));
        path.extend(roads.ends[0]);
        let steps: Vec<Vec<u32>> = path.iter().map(|&node| vec![node, roads.starts[1]]).collect();
        let short = shorten(&pibt.rule, &roads, steps.clone());
        assert!(short.len() < 9 && short.first() == steps.first() && short.last() == steps.last());
        for pair in short.windows(2) {
            assert!(pibt.rule.are_apart((0, pair[0][0], pair[1][0]), (1, pair[0][1], pair[1][1])));
            assert!(pair[0] != pair[1] && pibt.rule.far(0, pair[0][0]) <= far_m + 0.2);
        }
    }
}

//! Lazy constraints addition search over configurations, which are the nodes of all robots at one step (LaCAM; Okumura
//! 2023). The search goes depth first: [`Pibt`] generates the next configuration from the current one. If that
//! configuration is known already, constraints force single robots to other nodes, one constraint more each time.
//! Without its bound on work, the search is complete on the graph.

use std::collections::BTreeMap;
use std::collections::VecDeque;

use crate::mapf::pibt::{ConflictRule, Constraint, Pibt};
use crate::roads::graph::NONE;

/// Bound on the work of a search: the number of robots times the number of expanded configurations.
const MOST_WORK: usize = 1_500_000;

/// A configuration that the search has reached, and what it still has to try from there.
struct SearchNode {
    /// `[robot]`: its node.
    nodes: Vec<u32>,
    /// Index of the search node that this configuration was reached from.
    from: usize,
    /// Indices of robots, the most urgent first.
    ranks: Vec<usize>,
    /// `[robot]`: its urgency. It begins with a share from 0 to 1, by the cost of the robot's path. It rises by 1 with
    /// each step that does not end at the robot's goal. With a step that ends there, it falls to the share − 1.
    urgency: Vec<f64>,
    /// Lists of constraints that were not tried yet, the shortest lists first.
    constraints: VecDeque<Vec<Constraint>>,
}

/// Finds `[step][robot]`: nodes from `starts` until all robots with a goal are at their goals at the same time. `None`
/// if there is no solution, or if the search exceeds its bounds or is cancelled.
pub(crate) fn search(
    pibt: &mut Pibt<'_, impl ConflictRule>,
    starts: &[u32],
    goals: &[u32],
) -> Option<Vec<Vec<u32>>> {
    assert_eq!(starts.len(), goals.len(), "each robot has a goal or NONE");
    let far: Vec<f64> = (0..starts.len()).map(|robot| pibt.rule.far(robot, starts[robot])).collect();
    if far.contains(&f64::INFINITY) {
        return None;
    }
    let longest = far.iter().copied().fold(0.0, f64::max) + 1.0;
    let share: Vec<f64> = far.iter().map(|far| far / longest).collect();
    let mut search_nodes = vec![SearchNode::new(starts.to_vec(), 0, share.clone())];
    let mut known = BTreeMap::from([(starts.to_vec(), 0)]);
    let mut open = vec![0];
    let mut work = MOST_WORK / starts.len().max(1);
    while let Some(&top) = open.last().filter(|_| !pibt.is_spent()) {
        work = work.checked_sub(1)?;
        let expanded = &mut search_nodes[top];
        if expanded.nodes.iter().zip(goals).all(|(node, goal)| *goal == NONE || node == goal) {
            return Some(trace(&search_nodes, top));
        }
        let Some(constraints) = expanded.constraints.pop_front() else {
            open.pop();
            continue;
        };
        expanded.branch(&pibt.rule, &constraints);
        let expanded = &search_nodes[top];
        let Some(next) = pibt.step(&expanded.nodes, &expanded.ranks, &constraints) else { continue };
        if let Some(&seen) = known.get(&next) {
            open.push(seen);
            continue;
        }
        let urgency = (0..next.len()).map(|robot| {
            let there = goals[robot] == NONE || next[robot] == goals[robot];
            if there { share[robot] - 1.0 } else { expanded.urgency[robot] + 1.0 }
        });
        let urgency = urgency.collect();
        known.insert(next.clone(), search_nodes.len());
        open.push(search_nodes.len());
        search_nodes.push(SearchNode::new(next, top, urgency));
    }
    None
}

impl SearchNode {
    fn new(nodes: Vec<u32>, from: usize, urgency: Vec<f64>) -> Self {
        let mut ranks: Vec<usize> = (0..nodes.len()).collect();
        ranks.sort_by(|&a, &b| urgency[b].total_cmp(&urgency[a]).then(a.cmp(&b)));
        Self { nodes, from, ranks, urgency, constraints: VecDeque::from([Vec::new()]) }
    }

    /// Adds lists of constraints to try: `constraints` and one more on the next robot by urgency, for each node to
    /// which that robot may go.
    fn branch(&mut self, rule: &impl ConflictRule, constraints: &[Constraint]) {
        let Some(&robot) = self.ranks.get(constraints.len()) else { return };
        let here = self.nodes[robot];
        for node in rule.around(robot, here).chain([here]) {
            self.constraints.push_back(constraints.iter().copied().chain([(robot, node)]).collect());
        }
    }
}

fn trace(search_nodes: &[SearchNode], mut at: usize) -> Vec<Vec<u32>> {
    let mut steps = vec![search_nodes[at].nodes.clone()];
    while at != 0 {
        at = search_nodes[at].from;
        steps.push(search_nodes[at].nodes.clone());
    }
    steps.reverse();
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::cancel::Cancel;
    use crate::instance::Instance;
    use crate::mapf::lattice_rule::lattice_pibt;
    use crate::roads::lattice::Lattice;
    use lightbots_base::{Limits, Vec2};
    use lightbots_show::Easing;

    fn lattice(half: f64) -> Lattice {
        let problem = TransitionProblem {
            starts: Vec::new(),
            goals: Vec::new(),
            pinned: Vec::new(),
            standing: Vec::new(),
            obstacles: Vec::new(),
            half_floor: Vec2::new(half, half),
            limits: Limits::ELISA_3,
            duration: None,
            easing: Easing::Swift,
            prescribed: None,
        };
        Lattice::new(&Instance::new(&problem, &[]).unwrap(), 0.072).unwrap()
    }

    /// Asserts for all steps that no two robots share a node, exchange their nodes, or follow each other around a sharp
    /// corner.
    fn assert_legal(lattice: &Lattice, steps: &[Vec<u32>]) {
        for pair in steps.windows(2) {
            for (a, (&a0, &a1)) in pair[0].iter().zip(&pair[1]).enumerate() {
                assert!(a0 == a1 || lattice.neighbours[a0 as usize].contains(&a1));
                for (&b0, &b1) in pair[0].iter().zip(&pair[1]).take(a) {
                    assert_ne!(a1, b1);
                    let place = |node: u32| lattice.places[node as usize];
                    let (before, after) = (place(a0) - place(b0), place(a1) - place(b1));
                    let closest = (0..=20).map(|i| before.lerp(after, f64::from(i) / 20.0).length());
                    assert!(closest.fold(1.0, f64::min) > 0.86 * 0.072);
                }
            }
        }
    }

    #[test]
    fn a_crowd_is_turned_around() {
        let lattice = lattice(0.4);
        let count = lattice.places.len();
        let starts: Vec<u32> = (0..count as u32).filter(|node| node % 2 == 0).collect();
        let goals: Vec<u32> = starts.iter().rev().copied().collect();
        let steps =
            search(&mut lattice_pibt(&lattice, &goals, Cancel::NEVER).unwrap(), &starts, &goals).unwrap();
        assert_eq!(steps.first(), Some(&starts));
        assert_eq!(steps.last(), Some(&goals));
        assert_legal(&lattice, &steps);
    }

    #[test]
    fn a_robot_without_a_goal_makes_way() {
        let lattice = lattice(0.2);
        let starts: Vec<u32> = (0..lattice.places.len() as u32 - 3).collect();
        let mut goals = vec![NONE; starts.len()];
        goals[0] = lattice.places.len() as u32 / 2;
        goals[1] = 0;
        let steps =
            search(&mut lattice_pibt(&lattice, &goals, Cancel::NEVER).unwrap(), &starts, &goals).unwrap();
        assert_legal(&lattice, &steps);
        assert_eq!(steps.last().unwrap()[1], 0);
    }
}

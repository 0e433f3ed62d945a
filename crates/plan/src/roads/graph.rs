//! A trait for graphs of places on the floor, and the searches over them.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, VecDeque};

use lightbots_base::Vec2;

/// Marks a missing node, where the index of a node is expected.
pub(crate) const NONE: u32 = u32::MAX;

/// Places on the floor, and the lines between them along which a robot may drive.
pub(crate) trait Graph {
    /// Place of each node, stage metres.
    fn places(&self) -> &[Vec2];

    /// Returns the nodes that a robot may drive to from a node in one straight line. Each line leads both ways.
    fn neighbours(&self, node: u32) -> impl Iterator<Item = u32>;

    /// Place of a node, stage metres.
    fn place(&self, node: u32) -> Vec2 {
        self.places()[node as usize]
    }

    /// Length of the straight line between two nodes, metres.
    fn length_m(&self, a: u32, b: u32) -> f64 {
        self.place(a).distance(self.place(b))
    }
}

/// Returns `[node]`: the least number of lines from the node to `goal` (breadth-first search). It is `u16::MAX` if
/// there is no path, or none with fewer lines than that.
pub(crate) fn steps_to(graph: &impl Graph, goal: u32) -> Vec<u16> {
    let mut steps = vec![u16::MAX; graph.places().len()];
    let mut queue = VecDeque::from([goal]);
    steps[goal as usize] = 0;
    while let Some(node) = queue.pop_front() {
        let next = steps[node as usize].saturating_add(1);
        for other in graph.neighbours(node) {
            if steps[other as usize] == u16::MAX && next < u16::MAX {
                steps[other as usize] = next;
                queue.push_back(other);
            }
        }
    }
    steps
}

/// The cheapest paths from some nodes to all others.
pub(crate) struct CheapestPaths {
    /// `[node]`: least cost from a source to the node; infinite if there is no path.
    pub costs: Vec<f64>,
    /// `[node]`: the node before it on its cheapest path; [`NONE`] at a source, and if there is no path.
    pub before: Vec<u32>,
}

/// Finds the cheapest paths from `sources` to all nodes (Dijkstra 1959). Each source is a node and an initial cost.
/// `cost(from, to)` of a line is positive, or infinite if the line must not be used.
pub(crate) fn cheapest_paths(
    graph: &impl Graph,
    sources: impl IntoIterator<Item = (u32, f64)>,
    cost: impl Fn(u32, u32) -> f64,
) -> CheapestPaths {
    let count = graph.places().len();
    let mut paths = CheapestPaths { costs: vec![f64::INFINITY; count], before: vec![NONE; count] };
    let mut open = BinaryHeap::new();
    for (node, cost) in sources {
        if cost < paths.costs[node as usize] {
            paths.costs[node as usize] = cost;
            open.push(Reached { cost, node });
        }
    }
    while let Some(Reached { cost: so_far, node }) = open.pop() {
        if so_far > paths.costs[node as usize] {
            continue;
        }
        for next in graph.neighbours(node) {
            let whole = so_far + cost(node, next);
            if whole < paths.costs[next as usize] {
                (paths.costs[next as usize], paths.before[next as usize]) = (whole, node);
                open.push(Reached { cost: whole, node: next });
            }
        }
    }
    paths
}

/// A node that the search has reached. Its order is reversed, so that a max-heap returns the cheapest node first.
#[derive(PartialEq)]
struct Reached {
    cost: f64,
    node: u32,
}

impl Eq for Reached {}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        other.cost.total_cmp(&self.cost).then(other.node.cmp(&self.node))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square with sides of 1 m and no line along its upper side, and a fifth node without lines.
    struct Square([Vec2; 5]);

    impl Graph for Square {
        fn places(&self) -> &[Vec2] {
            &self.0
        }

        fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> {
            [&[1, 3][..], &[0, 2], &[1], &[0], &[]][node as usize].iter().copied()
        }
    }

    fn square() -> Square {
        Square([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (5.0, 5.0)].map(|(x, y)| Vec2::new(x, y)))
    }

    #[test]
    fn steps_are_counted_along_lines() {
        assert_eq!(steps_to(&square(), 2), [2, 1, 0, 3, u16::MAX]);
    }

    #[test]
    fn the_cheapest_path_begins_at_the_source_with_the_least_cost_in_all() {
        let graph = square();
        let length_m = |a, b| graph.length_m(a, b);
        let paths = cheapest_paths(&graph, [(2, 0.0), (3, 0.5)], length_m);
        assert_eq!(paths.costs, [1.5, 1.0, 0.0, 0.5, f64::INFINITY]);
        assert_eq!(paths.before, [3, 2, NONE, NONE, NONE]);
        let closed = |a: u32, b: u32| if a.min(b) == 0 { f64::INFINITY } else { graph.length_m(a, b) };
        assert_eq!(cheapest_paths(&graph, [(3, 0.0)], closed).costs[..2], [f64::INFINITY; 2]);
    }
}

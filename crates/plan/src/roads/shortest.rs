//! The shortest paths of robots around walls: over the lattice, then without needless corners. If the lattice has no
//! path, because it does not fit through a gap, the path follows the visibility graph.

use std::cell::OnceCell;

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::margins::COMFORT_M;
use crate::roads::graph::{Graph, steps_to};
use crate::roads::lattice::Lattice;
use crate::roads::visibility::VisibilityGraph;

/// Radius around a start or end within which its path must enter or leave the lattice. In pitches, which are distances
/// between neighbouring lattice nodes.
const REACH: f64 = 3.0;

/// Returns `[robot]`: the corners of its path, from its start to its end. A spare robot stays at its start. `None` if
/// no path is found for a robot that has an end, or the planner is cancelled.
pub(crate) fn shortest_paths(
    instance: &Instance,
    lattice: &Lattice,
    visibility: &OnceCell<VisibilityGraph>,
) -> Option<Vec<Vec<Vec2>>> {
    (0..instance.robots())
        .map(|robot| {
            if instance.cancel.is_wanted() {
                return None;
            }
            let start = instance.starts[robot];
            let Some(end) = instance.ends[robot] else { return Some(vec![start, start]) };
            if instance.walls.is_empty() || instance.is_way_free(start, end, COMFORT_M) {
                return Some(vec![start, end]);
            }
            shortest_path(instance, lattice, start, end).or_else(|| {
                visibility.get_or_init(|| VisibilityGraph::new(instance)).path(instance, start, end)
            })
        })
        .collect()
}

fn shortest_path(instance: &Instance, lattice: &Lattice, start: Vec2, end: Vec2) -> Option<Vec<Vec2>> {
    let door = |place: Vec2| {
        let near = lattice.around(place, REACH * lattice.pitch_m, 40);
        near.into_iter().find(|&node| instance.is_way_free(place, lattice.place(node), 0.0))
    };
    let (mut node, goal) = (door(start)?, door(end)?);
    let steps = steps_to(lattice, goal);
    let mut path = vec![start, lattice.place(node)];
    if steps[node as usize] == u16::MAX {
        return None;
    }
    while node != goal {
        let key = |next: u32| (steps[next as usize], lattice.place(next).distance(end));
        let near = lattice.neighbours(node);
        node = near.min_by(|&a, &b| key(a).0.cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)))?;
        path.push(lattice.place(node));
    }
    path.push(end);
    Some(without_detours(instance, &path))
}

/// Removes corners of a path that a robot can bypass on a straight line with a gap of [`COMFORT_M`] from walls.
fn without_detours(instance: &Instance, path: &[Vec2]) -> Vec<Vec2> {
    let mut without_detours = vec![path[0]];
    let mut at = 0;
    while at + 1 < path.len() {
        let sees = |&next: &usize| instance.is_way_free(path[at], path[next], COMFORT_M);
        at = (at + 2..path.len()).rev().find(sees).unwrap_or(at + 1);
        without_detours.push(path[at]);
    }
    without_detours
}

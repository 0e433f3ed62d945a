//! The shortest way of one robot around walls: over the lattice, then pulled tight; where the lattice does not fit
//! through, from corner to corner.

use std::cell::OnceCell;

use lightbots_base::Vec2;

use crate::instance::Scene;
use crate::margins::COMFORT_M;
use crate::roads::lattice::{Lattice, NONE};
use crate::roads::visibility::Corners;

/// How far from its ends a way may reach the lattice, in pitches.
const REACH: f64 = 3.0;

/// Corners of each robot's way from its start to its end; `None` where somebody is walled in.
pub(crate) fn courses(
    scene: &Scene,
    lattice: &Lattice,
    corners: &OnceCell<Corners>,
) -> Option<Vec<Vec<Vec2>>> {
    (0..scene.robots())
        .map(|robot| {
            if scene.cancel.is_wanted() {
                return None;
            }
            let start = scene.starts[robot];
            let Some(end) = scene.ends[robot] else { return Some(vec![start, start]) };
            if scene.walls.is_empty() || scene.is_way_free(start, end, COMFORT_M) {
                return Some(vec![start, end]);
            }
            around(scene, lattice, start, end)
                .or_else(|| corners.get_or_init(|| Corners::new(scene)).way(scene, start, end))
        })
        .collect()
}

fn around(scene: &Scene, lattice: &Lattice, start: Vec2, end: Vec2) -> Option<Vec<Vec2>> {
    let door = |place: Vec2| {
        let near = lattice.around(place, REACH * lattice.pitch_m, 40);
        near.into_iter().find(|&node| scene.is_way_free(place, lattice.places[node as usize], 0.0))
    };
    let (mut node, goal) = (door(start)?, door(end)?);
    let steps = lattice.steps_to(goal);
    let mut way = vec![start, lattice.places[node as usize]];
    if steps[node as usize] == u16::MAX {
        return None;
    }
    while node != goal {
        let near = lattice.neighbours[node as usize].into_iter().filter(|&next| next != NONE);
        let key = |next: u32| (steps[next as usize], lattice.places[next as usize].distance(end));
        node = near.min_by(|&a, &b| key(a).0.cmp(&key(b).0).then(key(a).1.total_cmp(&key(b).1)))?;
        way.push(lattice.places[node as usize]);
    }
    way.push(end);
    Some(tight(scene, &way))
}

/// The way without the corners it does not need.
fn tight(scene: &Scene, way: &[Vec2]) -> Vec<Vec2> {
    let mut tight = vec![way[0]];
    let mut at = 0;
    while at + 1 < way.len() {
        let sees = |&next: &usize| scene.is_way_free(way[at], way[next], COMFORT_M);
        at = (at + 2..way.len()).rev().find(sees).unwrap_or(at + 1);
        tight.push(way[at]);
    }
    tight
}

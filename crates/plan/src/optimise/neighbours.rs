//! Near pairs of robots on a span (a piece of their splines), if at least one of the two has moved since the last
//! detection. Pairs of robots that have not moved are not compared again.

use lightbots_base::Vec2;

use crate::optimise::cells::{Cells, Disc};
use crate::optimise::displacement::Displacement;

/// Number of straight stretches by which a span is approximated.
pub(crate) const STRETCHES: usize = 4;
/// A robot counts as still if its control points moved at most this far since the last detection, metres.
/// [`SKIN_M`](super::contacts) includes this distance.
pub(crate) const MOVED_M: f64 = 0.002;
/// If at most one robot in this many has moved, each moved robot is compared with all others directly, without cells.
const FEW: usize = 40;

/// Buffers of a detection of contacts on one span.
#[derive(Default)]
pub(crate) struct MovedNeighbours {
    cells: Cells,
    /// `[robot]`: the disc around its places during the span.
    pub discs: Vec<Disc>,
    /// `[robot]`: ends of the straight stretches on the span.
    pub places: Vec<Places>,
    /// `[robot]`: how far it moved since it was last compared with all others, metres.
    moved_m: Vec<f64>,
    /// Indices of the robots that moved farther than [`MOVED_M`].
    pub moved: Vec<usize>,
}

/// Ends of the straight stretches of a span.
pub(crate) type Places = [Vec2; STRETCHES + 1];

impl MovedNeighbours {
    /// Finds the robots that have moved on a span since they were last compared with all others.
    pub fn find_moved(&mut self, robots: usize, span: usize, displacement: &Displacement) {
        self.moved_m.clear();
        self.moved_m.extend((0..robots).map(|robot| displacement.since_mark_m(robot, span)));
        self.moved.clear();
        self.moved.extend((0..robots).filter(|&robot| self.moved_m[robot] > MOVED_M));
    }

    /// How far a robot moved on the span since it was last compared with all others, metres.
    pub fn moved_m(&self, robot: usize) -> f64 {
        self.moved_m[robot]
    }

    /// Calls `near` once for every two robots of which at least one has moved, if their discs are less than `apart`
    /// metres from each other.
    pub fn pairs(&mut self, apart: f64, mut near: impl FnMut(usize, usize)) {
        let (discs, has_moved) = (&self.discs, |robot: usize| self.moved_m[robot] > MOVED_M);
        if self.moved.len() * FEW > discs.len() {
            self.cells.near_pairs(discs, apart, |one, other| {
                let (a, b) = (one.owner.min(other.owner) as usize, one.owner.max(other.owner) as usize);
                if has_moved(a) || has_moved(b) {
                    near(a, b);
                }
            });
            return;
        }
        for &one in &self.moved {
            for (other, disc) in discs.iter().enumerate() {
                let touch = apart + discs[one].radius + disc.radius;
                let is_near = (discs[one].at - disc.at).length_squared() < touch * touch;
                if is_near && other != one && !(other < one && has_moved(other)) {
                    near(one.min(other), one.max(other));
                }
            }
        }
    }
}

/// Distance of a span's middle from its farther end, metres.
pub(crate) fn reach(places: &Places) -> f64 {
    let middle = places[STRETCHES / 2];
    let (first, last) = (places[0] - middle, places[STRETCHES] - middle);
    first.length_squared().max(last.length_squared()).sqrt()
}

/// Whether the straight stretches between places come nearer to the origin than `near` metres. `places`: places of one
/// robot relative to another.
pub(crate) fn come_near(places: &Places, near: f64) -> bool {
    // Skips a pair if its distance in the middle of the span rules out that it is near at the ends. In between, robots
    // with similar motion hardly come nearer.
    let far = near + reach(places);
    let square = near * near;
    let comes_near = |pair: &[Vec2]| {
        let (before, way) = (pair[0], pair[1] - pair[0]);
        let (toward, whole, beside) = (-before.dot(way), way.length_squared(), before.cross(way));
        let passes = toward > 0.0 && toward < whole && beside * beside < square * whole;
        passes || pair[1].length_squared() < square
    };
    places[STRETCHES / 2].length_squared() < far * far
        && (places[0].length_squared() < square || places.windows(2).any(comes_near))
}

//! The trajectories that a show contains, which are used unchanged.

use std::collections::BTreeMap;

use lightbots_base::{Piece, Span, Vec2};
use lightbots_show::{Show, Trajectory};

use super::way::PrescribedWay;
use crate::{BoundFrame, Path};

/// Returns `[goal]`: the trajectory to that pixel of frame `index`. The robot of a pixel without a trajectory rests at
/// the pixel's place. `None` if the show has no trajectory to this frame.
pub(super) fn ways(show: &Show, index: usize, bound: &BoundFrame<'_>) -> Option<Vec<PrescribedWay>> {
    let id = show.frames[index].id.as_deref()?;
    let mut given: BTreeMap<u32, &Trajectory> = BTreeMap::new();
    for trajectory in show.trajectories.iter().filter(|trajectory| trajectory.frame.as_deref() == Some(id)) {
        given.entry(trajectory.pixel).or_insert(trajectory);
    }
    if given.is_empty() {
        return None;
    }
    let ways = bound.pixels.iter().map(|pixel| {
        let rest = Path { start: pixel.at, pieces: Vec::new() };
        PrescribedWay::Timed(given.get(&pixel.id).map_or(rest, |trajectory| path_of(trajectory)))
    });
    Some(ways.collect())
}

fn path_of(trajectory: &Trajectory) -> Path {
    let mut path = Path { start: trajectory.start, pieces: Vec::new() };
    let span = |seconds: f64| Span::from_secs(seconds.clamp(0.0, 1e6));
    if trajectory.at_s > 0.0 {
        path.pieces.push(Piece::rest(trajectory.start, span(trajectory.at_s)));
    }
    let (mut from, mut begin) = (trajectory.start, Span::ZERO);
    for piece in &trajectory.pieces {
        let duration = span(piece.end_s) - begin;
        let cubic = |[c1, c2]: [Vec2; 2]| Piece { duration, c1, c2, end: piece.end };
        path.pieces.push(piece.controls.map_or(Piece::straight(from, piece.end, duration), cubic));
        (from, begin) = (piece.end, span(piece.end_s));
    }
    path
}

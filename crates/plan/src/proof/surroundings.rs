//! Whether a path keeps to the floor and clear of obstacles.

use super::curve::{Cubic, nearest, split};
use super::grid::Bounds;
use super::input::{ProofInput, SLACK_M};
use super::verdict::FaultKind;
use crate::Path;
use lightbots_base::{Span, Vec2};
use lightbots_show::Obstacle;

/// Number of bisections after which an undecided curve counts as a fault.
const HALVINGS: u32 = 24;

/// Calls `fault` with the beginning of the first piece that leaves the floor. Also calls it with the beginning of the
/// first piece that comes too near to an obstacle. Only the first such obstacle of the list is reported.
pub(super) fn judge(path: &Path, input: &ProofInput<'_>, mut fault: impl FnMut(FaultKind, Span)) {
    let (start, end) = (path.start, path.as_ref().end());
    // A robot that starts or ends off the floor may be as far off as that start or end.
    let radius = input.limits.radius_m;
    let room = |half: f64, a: f64, b: f64| (half - radius).max(a.abs()).max(b.abs()) + SLACK_M;
    let limit = Vec2::new(room(input.half_floor.x, start.x, end.x), room(input.half_floor.y, start.y, end.y));
    let inside = |place: Vec2| place.x.abs() <= limit.x && place.y.abs() <= limit.y;
    let leaves =
        |curve: &Cubic| !keeps(curve, HALVINGS, &|part| part.iter().all(|&place| inside(place)), &inside);
    let first = |wrong: &dyn Fn(&Cubic) -> bool| {
        path.as_ref()
            .timed()
            .find(|(from, _, piece)| wrong(&[*from, piece.c1, piece.c2, piece.end]))
            .map(|found| found.1)
    };
    if let Some(at) = first(&leaves) {
        fault(FaultKind::Floor, at);
    }
    let wanted = radius + input.obstacle_gap_m;
    for thing in input.obstacles {
        let need = wanted.min(distance(thing, start)).min(distance(thing, end)) - SLACK_M;
        if let Some(at) = first(&|curve| touches(thing, curve, need)) {
            fault(FaultKind::Obstacle, at);
            break;
        }
    }
}

/// Distance of a place from an obstacle's rim, metres; 0 inside the obstacle.
fn distance(thing: &Obstacle, place: Vec2) -> f64 {
    match *thing {
        Obstacle::Disc { at, radius_m } => (at.distance(place) - radius_m).max(0.0),
        Obstacle::Rect { min, max } => {
            Bounds { min, max }.distance_squared(&Bounds { min: place, max: place }).sqrt()
        }
    }
}

/// Whether a curve comes nearer to an obstacle's rim than `need` metres; always `false` if `need` is not positive. An
/// undecided curve counts as too near.
fn touches(thing: &Obstacle, curve: &Cubic, need: f64) -> bool {
    match *thing {
        Obstacle::Disc { at, radius_m } => {
            let relative = [curve[0] - at, curve[1] - at, curve[2] - at, curve[3] - at];
            need > 0.0 && nearest(&relative, radius_m + need).is_some()
        }
        Obstacle::Rect { min, max } => {
            let rect = Bounds { min, max };
            let clear = |part: &Cubic| {
                let mut bounds = Bounds::EMPTY;
                part.iter().for_each(|&place| bounds.include(place));
                bounds.distance_squared(&rect) >= need * need
            };
            need > 0.0 && !keeps(curve, HALVINGS, &clear, &|place| distance(thing, place) >= need)
        }
    }
}

/// Whether a condition on places holds everywhere on a curve. `holds(place)` is the condition. `surely(part)` may only
/// return `true` if the condition holds on the whole part. A curve that is undecided after `halvings` bisections counts
/// as `false`.
fn keeps(
    curve: &Cubic,
    halvings: u32,
    surely: &dyn Fn(&Cubic) -> bool,
    holds: &dyn Fn(Vec2) -> bool,
) -> bool {
    if surely(curve) {
        return true;
    }
    if halvings == 0 || !holds(curve[0]) || !holds(curve[3]) {
        return false;
    }
    let (left, right) = split(curve, 0.5);
    keeps(&left, halvings - 1, surely, holds) && keeps(&right, halvings - 1, surely, holds)
}

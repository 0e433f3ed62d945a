//! Ways of robots in a picture that moves as a whole. A way is the whole path of one robot.

use std::collections::BTreeMap;
use std::sync::Arc;

use lightbots_base::Vec2;
use lightbots_show::{Frame, PictureMotion};

use super::picture::{PlacesById, picture};
use super::shape::{Shape, ShapeCurve};
use super::smooth_line::SmoothLine;
use super::way::{PrescribedWay, WayPart};

/// Length over which the corners of a curve that a user has drawn are rounded, metres, so that robots turn there
/// without a stop.
const ROUNDING_M: f64 = 0.06;
/// Tolerance when a place is searched along a rounded track, metres: lengths along the track differ from those along
/// straight lines.
const SLACK_M: f64 = 0.05;
/// Latest moment at which a robot's circles may begin, as a share of the duration of the drive.
const MOST_LATE: f64 = 0.75;

/// Returns the places of the pixels of `frame` after `motion`, by pixel id, stage metres. For staggered starts and
/// drives through pictures, the places are returned unchanged, because their goals are the pixels of the next frame.
/// They are unchanged too for a line of robots without a curve.
pub fn moved(motion: &PictureMotion, frame: &Frame) -> PlacesById {
    let before = picture(frame);
    let ways = ways(motion, &before);
    before.iter().map(|(&id, &at)| (id, ways.get(&id).and_then(PrescribedWay::end).unwrap_or(at))).collect()
}

/// Returns the way of each pixel's robot, by pixel id; `before`: places of the pixels. Empty for staggered starts and
/// drives through pictures, which are made elsewhere, and for a line of robots without a curve.
pub(super) fn ways(motion: &PictureMotion, before: &PlacesById) -> BTreeMap<u32, PrescribedWay> {
    match motion {
        PictureMotion::Travel { along } => {
            let travel = travel(along);
            each(before, |at| whole(travel(at)))
        }
        PictureMotion::Turn { center, turn, size } => {
            let kind = |at| ShapeCurve::Turn { center: *center, arm: at - *center, turn: *turn, size: *size };
            each(before, |at| whole(kind(at)))
        }
        PictureMotion::Breathe { center, size, times } => {
            each(before, |at| breathe(*center, *size, *times, at))
        }
        PictureMotion::Follow { along } => follow(along, before),
        PictureMotion::Wave { radius_m, direction, length_m, times } => {
            wave(*radius_m, Vec2::unit(*direction), *length_m, *times, before)
        }
        PictureMotion::Stagger { .. } | PictureMotion::Morph { .. } => BTreeMap::new(),
    }
}

fn each(before: &PlacesById, way: impl Fn(Vec2) -> Vec<WayPart>) -> BTreeMap<u32, PrescribedWay> {
    before.iter().map(|(&id, &at)| (id, PrescribedWay::Parts(way(at)))).collect()
}

/// Returns a way of one part, which lasts for the whole drive.
fn whole(curve: ShapeCurve) -> Vec<WayPart> {
    vec![WayPart { during: (0.0, 1.0), shape: curve.into() }]
}

/// Returns a function that takes a robot's place and returns the robot's curve, which begins there. `along` holds
/// offsets from that place, metres. One offset gives a straight line; several give a smooth track that all curves
/// share.
fn travel(along: &[Vec2]) -> impl Fn(Vec2) -> ShapeCurve {
    let points: Vec<Vec2> = [Vec2::ZERO].into_iter().chain(along.iter().copied()).collect();
    let track = Arc::new(SmoothLine::through(&points, ROUNDING_M));
    move |at| match along {
        [by] => ShapeCurve::Line { from: at, to: at + *by },
        _ => ShapeCurve::Stretch { from_m: 0.0, to_m: track.length_m(), offset: at, track: track.clone() },
    }
}

/// Returns the way of the robot at `at`, `times` times to the place `size` times as far from `center` and back. Robots
/// drive back in reverse, so that they need no time to turn.
fn breathe(center: Vec2, size: f64, times: u32, at: Vec2) -> Vec<WayPart> {
    let wide = center + (at - center) * size;
    let parts = 2 * times.max(1);
    let part = |nth: u32| {
        let (from, to) = if nth.is_multiple_of(2) { (at, wide) } else { (wide, at) };
        let share = |nth: u32| f64::from(nth) / f64::from(parts);
        WayPart { during: (share(nth), share(nth + 1)), shape: ShapeCurve::Line { from, to }.into() }
    };
    (0..parts).map(part).collect()
}

/// Moves all robots along one track: through their own places, from the last robot to the first (the leader), and then
/// along the curve `along`. Each robot advances by the same length, about that of the curve.
fn follow(along: &[Vec2], before: &PlacesById) -> BTreeMap<u32, PrescribedWay> {
    let Some(&begin) = along.first() else { return BTreeMap::new() };
    let chain = chain(before, begin);
    let points: Vec<Vec2> = chain.iter().rev().map(|id| before[id]).chain(along.iter().copied()).collect();
    let track = Arc::new(SmoothLine::through(&points, ROUNDING_M));
    let along_m: f64 = along.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    // The leader stands about where the curve begins. Along the track, each robot is about as far behind the robot
    // ahead as their places are apart.
    let mut ahead = (begin, track.length_m() - along_m);
    let mut goes_m = None;
    let ways = chain.iter().map(|id| {
        let at = before[id];
        let gap_m = ahead.0.distance(at);
        let from_m = track.nearest_m(at, (ahead.1 - 2.0 * gap_m - SLACK_M, ahead.1 + SLACK_M));
        ahead = (at, from_m - SLACK_M);
        let goes_m = *goes_m.get_or_insert(track.length_m() - from_m);
        let kind =
            ShapeCurve::Stretch { track: track.clone(), from_m, to_m: from_m + goes_m, offset: Vec2::ZERO };
        let shape = Shape::from(kind).between(Some(at), None);
        (*id, PrescribedWay::Parts(vec![WayPart { during: (0.0, 1.0), shape }]))
    });
    ways.collect()
}

/// Returns the ids of all pixels in the order of a line. The first is the pixel nearest to `begin`. Each further one is
/// the remaining pixel nearest to the last one.
fn chain(before: &PlacesById, begin: Vec2) -> Vec<u32> {
    let mut left: Vec<(u32, Vec2)> = before.iter().map(|(&id, &at)| (id, at)).collect();
    let (mut chain, mut here) = (Vec::with_capacity(left.len()), begin);
    while !left.is_empty() {
        let gap = |entry: &(u32, Vec2)| (entry.1 - here).length_squared();
        let nearest = (0..left.len()).min_by(|&a, &b| gap(&left[a]).total_cmp(&gap(&left[b])));
        let (id, at) = left.remove(nearest.unwrap_or(0));
        chain.push(id);
        here = at;
    }
    chain
}

/// Returns ways of `times` circles for all robots. The farther a robot stands along `direction`, the later its circles
/// begin. As in a wave, the delay is the time of one circle for each `length_m` metres, but at most as [`MOST_LATE`]
/// allows.
fn wave(
    radius_m: f64,
    direction: Vec2,
    length_m: f64,
    times: u32,
    before: &PlacesById,
) -> BTreeMap<u32, PrescribedWay> {
    let along = |at: Vec2| at.dot(direction);
    let first_m = before.values().map(|&at| along(at)).fold(f64::INFINITY, f64::min);
    let last_m = before.values().map(|&at| along(at)).fold(f64::NEG_INFINITY, f64::max);
    let times = f64::from(times.max(1));
    // Number of circles that the first robot has driven before the last robot begins.
    let late = ((last_m - first_m) / length_m.max(1e-3)).clamp(0.0, times * MOST_LATE / (1.0 - MOST_LATE));
    let begin = direction.angle() - core::f64::consts::FRAC_PI_2;
    each(before, |at| {
        let share = (along(at) - first_m) / (last_m - first_m).max(1e-9);
        let from = share * late / (times + late);
        let during = (from, from + times / (times + late));
        vec![WayPart { during, shape: ShapeCurve::Circles { at, radius_m, begin, times }.into() }]
    })
}

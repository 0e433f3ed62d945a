//! Validation of the motion to a frame.

use std::ops::RangeInclusive;

use lightbots_base::Vec2;

use super::findings::Findings;
use super::limits::{MAX_MOTION_PLACES, MAX_PICTURES_BETWEEN};
use super::words::number;
use crate::{PictureMotion, Show};

/// Allowed factors on the size of a formation. They leave room to shrink a formation of 10 m to 1 m, and to enlarge it
/// again.
const SIZES: RangeInclusive<f64> = 0.05..=20.0;
/// Largest turn or direction in either sense, radians: a little more than 16 whole turns.
const MOST_TURN: f64 = 101.0;
/// Largest number of circles, or of changes of size.
const MOST_TIMES: u32 = 50;
/// Allowed lengths of waves and radii of circles, metres.
const LENGTHS_M: RangeInclusive<f64> = 0.001..=1_000.0;
/// Largest magnitude of a coordinate of a place, metres: five times the largest floor.
const FARTHEST_M: f64 = 1_000.0;
/// Longest time from the start of the first robot to the start of the last one in a staggered drive, seconds.
const MOST_DELAY_S: f64 = 600.0;

pub(super) fn check(show: &Show, index: usize, findings: &mut Findings) {
    let Some(motion) = &show.frames[index].motion else { return };
    if let Some(what) = wrong(motion) {
        let what = format!("the motion \"{}\": {what}", motion.name());
        findings.frame(show, index, "bad-motion", &what);
    }
}

/// What is wrong with the numbers of a motion, for people; `None` if all are valid.
fn wrong(motion: &PictureMotion) -> Option<String> {
    match motion {
        PictureMotion::Travel { along } | PictureMotion::Follow { along } => wrong_places(along),
        PictureMotion::Turn { center, turn, size } => wrong_place(*center)
            .or_else(|| outside("the turn", *turn, -MOST_TURN..=MOST_TURN, "rad"))
            .or_else(|| outside("the size", *size, SIZES, "times")),
        PictureMotion::Breathe { center, size, times } => wrong_place(*center)
            .or_else(|| outside("the size", *size, SIZES, "times"))
            .or_else(|| wrong_times(*times)),
        PictureMotion::Wave { radius_m, direction, length_m, times } => {
            outside("the radius", *radius_m, LENGTHS_M, "m")
                .or_else(|| outside("the direction", *direction, -MOST_TURN..=MOST_TURN, "rad"))
                .or_else(|| outside("the length of the wave", *length_m, LENGTHS_M, "m"))
                .or_else(|| wrong_times(*times))
        }
        PictureMotion::Stagger { direction, delay_s } => {
            outside("the direction", *direction, -MOST_TURN..=MOST_TURN, "rad")
                .or_else(|| outside("the delay", *delay_s, 0.0..=MOST_DELAY_S, "s"))
        }
        PictureMotion::Morph { through } if !(1..=MAX_PICTURES_BETWEEN).contains(&through.len()) => Some(
            format!("it has {} pictures in between; it needs 1 to {MAX_PICTURES_BETWEEN}", through.len()),
        ),
        PictureMotion::Morph { through } => through.iter().flatten().find_map(|&at| wrong_place(at)),
    }
}

fn wrong_places(along: &[Vec2]) -> Option<String> {
    if !(1..=MAX_MOTION_PLACES).contains(&along.len()) {
        return Some(format!("its curve has {} places; it needs 1 to {MAX_MOTION_PLACES}", along.len()));
    }
    along.iter().find_map(|&at| wrong_place(at))
}

fn wrong_place(at: Vec2) -> Option<String> {
    // Comparisons with NaN are false.
    let is_place = at.x.abs() <= FARTHEST_M && at.y.abs() <= FARTHEST_M;
    (!is_place).then(|| format!("({}, {}) is no place on a floor", number(at.x), number(at.y)))
}

fn wrong_times(times: u32) -> Option<String> {
    (!(1..=MOST_TIMES).contains(&times)).then(|| format!("{times} times; it can be 1 to {MOST_TIMES}"))
}

fn outside(name: &str, value: f64, range: RangeInclusive<f64>, unit: &str) -> Option<String> {
    (!range.contains(&value)).then(|| {
        let (least, most) = (number(*range.start()), number(*range.end()));
        format!("{name} is {} {unit}; it can be {least} to {most}", number(value))
    })
}

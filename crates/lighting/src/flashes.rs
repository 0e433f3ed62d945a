//! Flashes of a show that can cause seizures: WCAG 2.2, success criterion 2.3.1.
//!
//! A general flash is a pair of opposing changes of relative luminance by a tenth of the maximum or more, the darker
//! state below 0.8. A red flash is a pair of opposing changes that involve a saturated red: R/(R + G + B) ≥ 0.8, and (R
//! − G − B)·320 changes by more than 20. More than three flashes in a second must not cover more than a quarter of any
//! 10° of the viewer's field of view. Here such a field is a square whose side is a quarter of the floor's depth, and
//! each robot lights a square around itself. Three flashes a second are too many if they go on for more than five
//! seconds (Ofcom's guidance).

use crate::driven::{DrivenLight, LightMoment};
use crate::show_light::{FrameLight, ShowLight};
use crate::times::FrameTimes;
use lightbots_base::{Span, Vec2};
use lightbots_light::Linear;
use std::collections::VecDeque;

/// Samples per second, as in the films that are tested for flashes.
const RATE: u32 = 60;
/// Samples between two counts of flashes.
const COUNTED_EVERY: u32 = 15;
/// Largest number of robots that are sampled. Of a larger fleet, every second, third or n-th robot is sampled.
const ROBOTS_MAX: usize = 400;
/// Largest number of colours that are computed, so that checking takes seconds. In a long show, fewer robots are
/// sampled, but at least 20.
const COLOURS_MAX: usize = 4_000_000;
/// Smallest change of relative luminance that counts towards a flash.
const CHANGE: f64 = 0.1;
/// Relative luminance below which the darker state of a flash lies.
const DARK: f64 = 0.8;
/// Smallest change of R − G − B that counts towards a red flash: 20/320.
const RED_CHANGE: f64 = 0.0625;
/// Share of red in R + G + B from which a colour is a saturated red.
const RED_SHARE: f64 = 0.8;
/// Largest number of flashes in a second that is allowed.
const FLASHES_MAX: u32 = 3;
/// Number of counts in a row, 5 s, that may find `FLASHES_MAX` flashes a second or more.
const COUNTS_MAX: u32 = 5 * RATE / COUNTED_EVERY;
/// Share of a field that flashes may cover.
const COVERED: f64 = 0.25;
/// Side of a field, as a share of the floor's depth.
const FIELD: f64 = 0.25;
/// Largest side of the square that a robot lights on the floor, metres.
const CELL_MAX_M: f64 = 0.3;

/// A frame with the drive to it, for counting flashes.
#[derive(Clone, Debug)]
pub struct LitFrame<'a> {
    /// Air time of the frame.
    pub air: Span,
    /// The robots with their light, the same robots in the same order in all frames.
    pub robots: Vec<DrivenLight<'a>>,
}

/// A finding: too many flashes at a moment of a show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlashWarning {
    /// The moment, seconds of show time.
    pub show_s: f64,
    /// Number of flashes in the second before the moment.
    pub flashes: u32,
    /// Whether they are red flashes.
    pub is_red: bool,
    /// Number of the layer in the show without which the flashes would be few enough; `None`: no single layer.
    pub layer: Option<usize>,
}

/// Opposing changes of one quantity of one robot.
#[derive(Clone, Debug, Default)]
struct Swings {
    is_rising: bool,
    extreme: f64,
    /// Samples at which a change was complete, within the last second.
    at: VecDeque<u32>,
}

impl Swings {
    fn add(&mut self, sample: u32, value: f64, change: f64, counts: impl Fn(f64) -> bool) {
        while self.at.front().is_some_and(|&at| at + RATE <= sample) {
            self.at.pop_front();
        }
        let moved = if self.is_rising { self.extreme - value } else { value - self.extreme };
        if moved >= change && counts(self.extreme.min(value)) {
            self.at.push_back(sample);
            (self.is_rising, self.extreme) = (!self.is_rising, value);
        } else if moved < 0.0 {
            self.extreme = value;
        }
    }

    /// Flashes in the last second.
    fn flashes(&self) -> u32 {
        self.at.len() as u32 / 2
    }
}

/// One robot's flashes: general ones and red ones.
#[derive(Clone, Debug, Default)]
struct Watched {
    general: Swings,
    red: Swings,
    /// Place of the robot when flashes were last counted, stage metres.
    place: Vec2,
}

impl Watched {
    fn add(&mut self, sample: u32, light: Linear) {
        self.general.add(sample, light.luminance(), CHANGE, |darker| darker < DARK);
        let sum = light.r + light.g + light.b;
        let is_red = sum > 0.0 && light.r / sum >= RED_SHARE;
        let red = if is_red { (light.r - light.g - light.b).max(0.0) } else { 0.0 };
        self.red.add(sample, red, RED_CHANGE, |_| true);
    }
}

/// Returns the first moment at which a show flashes too often; `None` if there is none. `depth_m`: extent of its floor
/// away from the viewer, metres; `area_m2`: the floor's area.
pub fn flashes(
    show: &ShowLight,
    frames: &[LitFrame<'_>],
    (depth_m, area_m2): (f64, f64),
) -> Option<FlashWarning> {
    let robots = frames.first()?.robots.len();
    let samples = frames.iter().map(|frame| (duration_s(frame) * f64::from(RATE)) as usize).sum::<usize>();
    let most = (COLOURS_MAX / samples.max(1)).clamp(20, ROBOTS_MAX);
    let every = robots.div_ceil(most).max(1);
    let looked_at = robots.div_ceil(every);
    let cell_m2 = (area_m2 / looked_at.max(1) as f64).min(CELL_MAX_M * CELL_MAX_M * every as f64);
    let field_m = depth_m * FIELD;
    let mut watched = vec![Watched::default(); looked_at];
    let (mut sample, mut lasting, mut end_s) = (0, [0; 2], None);
    let mut times: Vec<FrameTimes> = Vec::new();
    for (number, frame) in frames.iter().enumerate() {
        let drive = frame.robots.first().map_or(Span::ZERO, |robot| robot.drive);
        let own = FrameTimes::after(end_s, drive.as_secs(), frame.air.as_secs());
        times.push(own);
        end_s = Some(own.end_s);
        let light = show.in_frame(number, |frame| times.get(frame).copied());
        let samples = ((own.end_s - own.drive_s) * f64::from(RATE)) as u32;
        for step in 0..samples {
            let moment = moment(own, step);
            for (robot, watched) in frame.robots.iter().step_by(every).zip(&mut watched) {
                watched.add(sample, robot.light(&light, show.pictures(), moment, usize::MAX));
            }
            sample += 1;
            if !sample.is_multiple_of(COUNTED_EVERY) {
                continue;
            }
            for (robot, watched) in frame.robots.iter().step_by(every).zip(&mut watched) {
                watched.place = robot.lit(moment.elapsed).place;
            }
            for is_red in [false, true] {
                let kind = if is_red {
                    |one: &Watched| one.red.flashes()
                } else {
                    |one: &Watched| one.general.flashes()
                };
                let many = covering(&watched, kind, (field_m, cell_m2));
                let lasting = &mut lasting[usize::from(is_red)];
                *lasting = if many >= FLASHES_MAX { *lasting + 1 } else { 0 };
                if many > FLASHES_MAX || *lasting > COUNTS_MAX {
                    let layer = blamed(show, frame, &light, (own, step), many);
                    return Some(FlashWarning { show_s: moment.show_s, flashes: many, is_red, layer });
                }
            }
        }
    }
    None
}

/// Duration of the drive and the air time, seconds.
fn duration_s(frame: &LitFrame<'_>) -> f64 {
    frame.robots.first().map_or(0.0, |robot| robot.drive.as_secs()) + frame.air.as_secs()
}

fn moment(times: FrameTimes, step: u32) -> LightMoment {
    let elapsed_s = f64::from(step) / f64::from(RATE);
    LightMoment {
        elapsed: Span::from_secs(elapsed_s),
        show_s: times.drive_s + elapsed_s,
        lead_s: 0.0,
        clock_s: 0.0,
    }
}

/// Returns the largest number of flashes in the last second that robots on more than a quarter of a field reach.
/// Returns 0 for a number below `FLASHES_MAX`.
fn covering(watched: &[Watched], flashes: fn(&Watched) -> u32, (field_m, cell_m2): (f64, f64)) -> u32 {
    let needed = (COVERED * field_m * field_m / cell_m2).floor() as usize + 1;
    let mut many = 0;
    for least in FLASHES_MAX..=RATE / 2 {
        let flashing: Vec<Vec2> =
            watched.iter().filter(|one| flashes(one) >= least).map(|one| one.place).collect();
        let is_near = |one: Vec2, other: Vec2| {
            (one.x - other.x).abs() <= field_m / 2.0 && (one.y - other.y).abs() <= field_m / 2.0
        };
        let covers = |one: &Vec2| flashing.iter().filter(|other| is_near(*one, **other)).count() >= needed;
        if flashing.len() < needed || !flashing.iter().any(covers) {
            break;
        }
        many = least;
    }
    many
}

/// Returns the number of the first layer without which each robot would flash fewer than `FLASHES_MAX` times in the
/// last second. Checks the first `ROBOTS_MAX` robots.
fn blamed(
    show: &ShowLight,
    frame: &LitFrame<'_>,
    light: &FrameLight,
    (times, step): (FrameTimes, u32),
    many: u32,
) -> Option<usize> {
    let flashes = |left_out: usize| {
        let of = |robot: &DrivenLight<'_>| {
            let mut watched = Watched::default();
            for step in step.saturating_sub(RATE)..=step {
                let light = robot.light(light, show.pictures(), moment(times, step), left_out);
                watched.add(step, light);
            }
            watched.general.flashes().max(watched.red.flashes())
        };
        frame.robots.iter().take(ROBOTS_MAX).map(of).max().unwrap_or(0)
    };
    (0..light.numbers.len())
        .find(|&index| flashes(index) < many.min(FLASHES_MAX))
        .map(|index| light.numbers[index])
}

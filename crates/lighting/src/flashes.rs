//! Flashes of a show that can cause seizures: WCAG 2.2, success criterion 2.3.1.
//!
//! A general flash is a pair of opposing changes of relative luminance by a tenth of the maximum or more, the darker
//! state below 0.8. A red flash is a pair of opposing changes of (R − G − B)·320 by 20 or more. They involve a
//! saturated red: R/(R + G + B) ≥ 0.8. More than three flashes in a second must not cover more than a quarter of any
//! 10° of the viewer's field of view. Here such a field is a square whose side is a quarter of the floor's depth, and
//! each robot lights a square around itself. Three flashes a second are too many if they go on for more than five
//! seconds (Ofcom's guidance).

use crate::driven::{DrivenLight, LightMoment};
use crate::show_light::{FrameLight, ShowLight};
use crate::times::FrameTimes;
use lightbots_base::{Span, Vec2};
use lightbots_light::Linear;
use std::collections::VecDeque;

/// Number of samples of light per second, as in films that are tested for flashes.
const RATE: u32 = 60;
/// Number of samples between two counts of flashes: a quarter of a second.
const COUNTED_EVERY: u32 = 15;
/// Largest number of robots whose light is sampled. In a larger fleet, only every n-th robot is sampled.
const ROBOTS_MAX: usize = 400;
/// Largest number of colours that are computed, so that the check takes seconds. In a long show, fewer robots are sampled to
/// keep it. At least 20 robots are sampled, even if more colours are computed then.
const COLOURS_MAX: usize = 4_000_000;
/// Smallest change of relative luminance, 0 to 1, that counts towards a flash (WCAG 2.2).
const CHANGE: f64 = 0.1;
/// A change of luminance counts towards a flash only if its darker state has a relative luminance below this (WCAG 2.2).
const DARK: f64 = 0.8;
/// Smallest change of R − G − B, in linear light, that counts towards a red flash: 20/320 (WCAG 2.2).
const RED_CHANGE: f64 = 0.0625;
/// Share of red in R + G + B, in linear light, from which a colour is a saturated red (WCAG 2.2).
const RED_SHARE: f64 = 0.8;
/// Largest number of flashes in a second that WCAG 2.2 allows.
const FLASHES_MAX: u32 = 3;
/// Largest number of consecutive counts, 5 s of them, that may find `FLASHES_MAX` flashes or more in the last second.
const COUNTS_MAX: u32 = 5 * RATE / COUNTED_EVERY;
/// Largest share of a field that may flash too often; see [`FIELD`].
const COVERED: f64 = 0.25;
/// Side of a field, as a share of the floor's depth. A field is a square of the floor that stands for 10° of the
/// viewer's field of view.
const FIELD: f64 = 0.25;
/// Largest side of the square around a robot that counts as lit by the robot, metres.
const CELL_MAX_M: f64 = 0.3;

/// A frame with the drive to it, for counting flashes.
#[derive(Clone, Debug)]
pub struct LitFrame<'a> {
    /// Air time of the frame.
    pub air: Span,
    /// The light of each robot in the drive and the frame. All frames have the same robots in the same order.
    pub robots: Vec<DrivenLight<'a>>,
}

/// A finding: too many flashes at a moment of a show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlashWarning {
    /// The moment, seconds of show time.
    pub show_s: f64,
    /// Number of flashes in the second before the moment.
    pub flashes: u32,
    /// Whether the flashes are red flashes; otherwise they are general flashes.
    pub is_red: bool,
    /// Index, counted from 0, of a layer of the show without which there would be few enough flashes; `None`: no single
    /// layer causes them.
    pub layer: Option<usize>,
}

/// Alternating rises and falls of one quantity of a robot's light, such as luminance.
#[derive(Clone, Debug, Default)]
struct Swings {
    is_rising: bool,
    extreme: f64,
    /// Numbers of the samples in the last second at which a rise or fall had become large enough.
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

    /// Number of flashes in the last second: a flash is a rise and a fall.
    fn flashes(&self) -> u32 {
        self.at.len() as u32 / 2
    }
}

/// General and red flashes of one robot.
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

/// Returns the first moment at which the light of a show flashes too often. It looks every quarter of a second. `None`
/// if the light never flashes too often, or there are no frames. `frames` are the show's frames in order. `depth_m` is
/// the extent of the floor away from the viewer, metres; `area_m2` is its area.
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

/// Duration of a frame: the drive to it and its air time, seconds.
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

/// Returns the largest number of flashes in the last second that robots reach which light more than a quarter of a field.
/// A number below `FLASHES_MAX` counts as 0. `field_m` is the side of a field, `cell_m2` the area that a robot lights.
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

/// Returns the index in the show of the lowest layer without which no robot would reach `FLASHES_MAX` flashes in the last
/// second. `None` if no single layer is enough. Only the first `ROBOTS_MAX` robots are checked.
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

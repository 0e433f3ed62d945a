//! Turns the colours of one robot, sampled every 10 ms, into a light track with few records.
//!
//! The method is a swing filter. From the end colour of the record before, a line goes as far as it is within the
//! tolerance at every sample. It ends at whole codes. If holding the colour reaches farther, it is held and then steps
//! instead. A line is straight in sRGB codes and rounded, as on the robot, so the tolerance holds for what the robot
//! shows.

use lightbots_base::{LightRecord, LightTrack, Rgb};
use lightbots_light::lightness;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// How far a line may be outside of the bounds of a sample, in codes: rounding brings it back inside. A little less than a
/// half, because a robot's arithmetic may differ in its last digits.
const ROUNDING: f64 = 0.49;
/// Largest number of records in a block whose repetitions are searched for. Chosen by us: a pattern of five records a
/// second that repeats every 10 s has 50.
const BLOCK_MAX: usize = 64;

/// `[code]`: lightness L* of an sRGB code. A table, because each fit needs it thousands of times.
static LIGHTNESS: LazyLock<[f64; 256]> = LazyLock::new(|| std::array::from_fn(|code| lightness(code as u8)));

/// Largest difference in lightness L* (CIE 1976) with which two colours look different only side by side.
const SIDE_BY_SIDE: f64 = 2.0;

/// How far each channel of the colour that a robot shows may be from that of the wanted colour.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Tolerance {
    /// One sRGB code.
    OneStep,
    /// This difference in lightness L* (CIE 1976) of greys with the two codes. A difference of one code is always allowed.
    Lightness(f64),
}

impl Tolerance {
    /// The tolerance that allows differences which are visible only side by side.
    pub const SIDE_BY_SIDE: Self = Self::Lightness(SIDE_BY_SIDE);
}

/// A track's start colour and records.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LightFit {
    /// The colour at the start.
    pub start: Rgb,
    /// The records in order.
    pub records: Vec<LightRecord>,
}

impl LightFit {
    /// The fit as a track.
    pub fn track(&self) -> LightTrack<'_> {
        LightTrack { start: self.start, records: &self.records }
    }
}

/// `[code]`: the lowest and the highest sRGB code that may be shown in place of the code.
struct Bounds([(u8, u8); 256]);

impl Bounds {
    fn new(tolerance: Tolerance) -> Self {
        let units = match tolerance {
            Tolerance::OneStep => 0.0,
            Tolerance::Lightness(units) => units,
        };
        let near = |one: u8, other: u8| {
            one.abs_diff(other) <= 1
                || (LIGHTNESS[usize::from(one)] - LIGHTNESS[usize::from(other)]).abs() <= units
        };
        let mut bounds = [(0, 0); 256];
        for code in 0..=u8::MAX {
            let low = (0..=code).rev().take_while(|&low| near(low, code)).last().unwrap_or(code);
            let high = (code..=u8::MAX).take_while(|&high| near(high, code)).last().unwrap_or(code);
            bounds[usize::from(code)] = (low, high);
        }
        Self(bounds)
    }

    fn of(&self, colour: Rgb) -> [(u8, u8); 3] {
        channels(colour).map(|code| self.0[usize::from(code)])
    }
}

/// Fits a track to the colours of a robot that are a [`TICK`](lightbots_base::TICK) apart. The track lasts from the first
/// colour to the last. If it has more than `records_max` records, the tolerance is raised until it has not. 0 records
/// count as 1.
pub fn fit(samples: &[Rgb], tolerance: Tolerance, records_max: usize) -> LightFit {
    let start = samples.first().copied().unwrap_or_default();
    let mut tolerance = tolerance;
    loop {
        let records = repeated(&lines(samples, &Bounds::new(tolerance)));
        if records.len() <= records_max.max(1) {
            return LightFit { start, records };
        }
        tolerance = match tolerance {
            Tolerance::OneStep => Tolerance::Lightness(1.0),
            Tolerance::Lightness(units) => Tolerance::Lightness(2.0 * units.max(0.5)),
        };
    }
}

/// Whether two colours look different even if they are not side by side: in one channel, the lightness L* differs by more
/// than `SIDE_BY_SIDE`.
pub fn is_seen_apart(one: Rgb, other: Rgb) -> bool {
    let pairs = channels(one).into_iter().zip(channels(other));
    let units = |code: u8| LIGHTNESS[usize::from(code)];
    pairs.into_iter().any(|(one, other)| (units(one) - units(other)).abs() > SIDE_BY_SIDE)
}

fn lines(samples: &[Rgb], bounds: &Bounds) -> Vec<LightRecord> {
    let wanted: Vec<[(u8, u8); 3]> = samples.iter().map(|&colour| bounds.of(colour)).collect();
    let mut records = Vec::new();
    let mut from = 0;
    let mut colour = samples.first().copied().unwrap_or_default();
    while from + 1 < samples.len() {
        let held = held(&wanted, from, colour);
        let (to, record) = match line(samples, &wanted, from, colour) {
            _ if held == samples.len() => (held - 1, line_to(held - 1 - from, colour)),
            Some((to, end)) if to >= held => (to, line_to(to - from, end)),
            _ => (held, LightRecord::Step { ticks: (held - from) as u32, to: samples[held] }),
        };
        colour = match record {
            LightRecord::Line { to, .. } | LightRecord::Step { to, .. } => to,
            LightRecord::Repeat { .. } => colour,
        };
        records.push(record);
        from = to;
    }
    records
}

fn line_to(ticks: usize, to: Rgb) -> LightRecord {
    LightRecord::Line { ticks: ticks as u32, to }
}

/// Returns the index of the first sample after `from` whose bounds exclude `colour`, so that the colour cannot be held
/// until there. The number of samples if no bounds exclude it.
fn held(wanted: &[[(u8, u8); 3]], from: usize, colour: Rgb) -> usize {
    let own = channels(colour);
    let fits = |bounds: &[(u8, u8); 3]| {
        bounds.iter().zip(own).all(|(&(low, high), code)| (low..=high).contains(&code))
    };
    let first = from + 1;
    wanted[first..].iter().position(|bounds| !fits(bounds)).map_or(wanted.len(), |count| first + count)
}

/// Finds the longest line from `colour` at the sample `from` that stays within the bounds of all samples on the way.
/// Returns the index of the sample at which it ends, and its end colour. `None` if no line reaches even the next sample.
fn line(samples: &[Rgb], wanted: &[[(u8, u8); 3]], from: usize, colour: Rgb) -> Option<(usize, Rgb)> {
    let start = channels(colour).map(f64::from);
    let mut slopes = [(f64::NEG_INFINITY, f64::INFINITY); 3];
    let mut best = None;
    for to in from + 1..wanted.len() {
        let ticks = (to - from) as f64;
        for ((slope, &(low, high)), start) in slopes.iter_mut().zip(&wanted[to]).zip(start) {
            slope.0 = slope.0.max((f64::from(low) - ROUNDING - start) / ticks);
            slope.1 = slope.1.min((f64::from(high) + ROUNDING - start) / ticks);
        }
        if slopes.iter().any(|(low, high)| low > high) {
            break;
        }
        let end = |channel: usize, code: u8| {
            let (low, high) = slopes[channel];
            let least = (start[channel] + low * ticks).ceil().max(0.0);
            let most = (start[channel] + high * ticks).floor().min(255.0);
            (least <= most).then(|| f64::from(code).clamp(least, most) as u8)
        };
        let [r, g, b] = channels(samples[to]);
        if let (Some(r), Some(g), Some(b)) = (end(0, r), end(1, g), end(2, b)) {
            best = Some((to, Rgb::new(r, g, b)));
        }
    }
    best
}

/// Returns fewer records with the same light. Where a block of records is repeated immediately, one `Repeat` record stands
/// for all repetitions, if that saves records.
fn repeated(records: &[LightRecord]) -> Vec<LightRecord> {
    let mut short = Vec::with_capacity(records.len());
    let mut from = 0;
    while from < records.len() {
        let times = |block: usize| {
            let again = records[from..].chunks_exact(block);
            again.skip(1).take_while(|next| **next == records[from..from + block]).count()
        };
        let longest = BLOCK_MAX.min((records.len() - from) / 2);
        // Of blocks that save the same number of records, the shortest is taken.
        let best = (1..=longest)
            .map(|block| (block, times(block)))
            .max_by_key(|&(block, times)| (block * times, core::cmp::Reverse(block)));
        match best {
            Some((block, times)) if block * times > 1 => {
                short.extend_from_slice(&records[from..from + block]);
                short.push(LightRecord::Repeat { records: block as u32, times: times as u32 });
                from += block * (times + 1);
            }
            _ => {
                short.push(records[from]);
                from += 1;
            }
        }
    }
    short
}

fn channels(colour: Rgb) -> [u8; 3] {
    [colour.r, colour.g, colour.b]
}

//! Finds beats by dynamic programming: strong onsets that are a period apart (D. Ellis, "Beat Tracking by Dynamic
//! Programming", Journal of New Music Research 36, 2007).

use crate::onsets::{FRAMES_PER_S, Onsets, onsets};
use crate::sound::{NoBeats, Sound};
use crate::tempo::{largest, periods};

/// How strictly the distances between beats keep to the period: factor of the cost ln(distance / period)². The unit is the
/// standard deviation of the onsets.
const TIGHTNESS: f64 = 100.0;

/// The previous beat of a beat is searched between these multiples of the period before the beat.
const BACK: [f64; 2] = [0.5, 2.0];

/// The first and the last beats are left out while they are weaker than this share of the mean beat, because nothing is
/// played there.
const END_SHARE: f64 = 0.5;

/// All beats move by half a beat if the bass half-way between them is more than this factor stronger than on them.
const BASS_RATIO: f64 = 1.5;

/// Correction that is added to times of beats, seconds (measured). Onsets rise before the middle of a window of sound
/// reaches the note, so that beats are found too early.
const EARLY_S: f64 = 0.006;

/// The beats of a piece of music.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundBeats {
    /// Times of the beats, seconds from the start of the music, increasing.
    pub times_s: Vec<f64>,
    /// Median tempo, beats per minute.
    pub bpm: f64,
}

/// Finds the beats of music.
///
/// # Errors
/// [`NoBeats::Silent`] if no onsets of notes or fewer than two beats are found.
pub fn find_beats(sound: &Sound<'_>) -> Result<FoundBeats, NoBeats> {
    let onsets = onsets(sound);
    let periods = periods(&onsets);
    let Onsets { all: onsets, bass } = onsets;
    let deviation = deviation(&onsets);
    if deviation <= 0.0 {
        return Err(NoBeats::Silent);
    }
    let period_at = |frame: usize| {
        let second = (frame as f64 / FRAMES_PER_S - 0.5).max(0.0);
        let (index, part) = (second as usize, second.fract());
        let value = |i: usize| periods[i.min(periods.len() - 1)];
        value(index) * (1.0 - part) + value(index + 1) * part
    };
    let strength: Vec<f64> =
        (0..onsets.len()).map(|frame| blurred(&onsets, frame, period_at(frame)) / deviation).collect();
    let chain = best_chain(&strength, period_at);
    let chain = if bass_is_between(&chain, &bass) { between(&chain) } else { chain };
    let beats = without_weak_ends(chain, &strength);
    if beats.len() < 2 {
        return Err(NoBeats::Silent);
    }
    let times_s: Vec<f64> =
        beats.into_iter().map(|frame| peak(&strength, frame) / FRAMES_PER_S + EARLY_S).collect();
    let bpm = 60.0 / median(times_s.windows(2).map(|pair| pair[1] - pair[0]).collect());
    Ok(FoundBeats { times_s, bpm })
}

fn deviation(onsets: &[f32]) -> f64 {
    let count = onsets.len() as f64;
    let mean = onsets.iter().map(|v| f64::from(*v)).sum::<f64>() / count;
    (onsets.iter().map(|v| (f64::from(*v) - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// Returns the sum of the onsets around a frame, weighted by a Gaussian. Its standard deviation is 1/32 of `period`, the
/// length of a beat in frames.
fn blurred(onsets: &[f32], frame: usize, period: f64) -> f64 {
    let width = period / 32.0;
    let reach = (3.0 * width).ceil() as usize;
    (frame.saturating_sub(reach)..(frame + reach + 1).min(onsets.len()))
        .map(|i| f64::from(onsets[i]) * (-0.5 * ((i as f64 - frame as f64) / width).powi(2)).exp())
        .sum()
}

/// Returns the increasing sequence of frames with the largest sum of onset strengths minus costs. Only sequences that
/// end in the last beat length of the music count. Distances that differ from the period have a cost. `period_at` gives
/// the length of a beat at a frame, in frames.
fn best_chain(strength: &[f64], period_at: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut sums = strength.to_vec();
    let mut before: Vec<Option<usize>> = vec![None; strength.len()];
    for frame in 0..strength.len() {
        let period = period_at(frame);
        let from = frame.saturating_sub((BACK[1] * period) as usize);
        let to = frame.saturating_sub((BACK[0] * period).ceil() as usize);
        let mut best = 0.0;
        for (back, sum) in sums.iter().enumerate().take(to).skip(from) {
            let uneven = ((frame - back) as f64 / period).ln();
            let sum = sum - TIGHTNESS * uneven * uneven;
            if sum > best {
                best = sum;
                before[frame] = Some(back);
            }
        }
        sums[frame] += best;
    }
    let last_period = period_at(strength.len() - 1) as usize;
    let last_from = strength.len().saturating_sub(last_period.max(1));
    let mut chain = vec![last_from + largest(&sums[last_from..])];
    while let Some(back) = before[chain[chain.len() - 1]] {
        chain.push(back);
    }
    chain.reverse();
    chain
}

/// Whether the bass half-way between the found beats is stronger than on them by [`BASS_RATIO`]. Loud notes off the beat
/// were then taken for beats.
fn bass_is_between(beats: &[usize], bass: &[f32]) -> bool {
    let sum = |frames: &[usize]| -> f64 { frames.iter().map(|&frame| near(bass, frame)).sum() };
    sum(&between(beats)) > BASS_RATIO * sum(beats)
}

/// Returns the largest value at most two frames away from `frame`, because musicians do not play exactly.
fn near(values: &[f32], frame: usize) -> f64 {
    let around = &values[frame.saturating_sub(2)..(frame + 3).min(values.len())];
    around.iter().fold(0.0, |a, b| f64::from(*b).max(a))
}

/// The frames half-way between neighbouring beats. Beats are given as frames.
fn between(beats: &[usize]) -> Vec<usize> {
    beats.windows(2).map(|pair| pair[0].midpoint(pair[1])).collect()
}

fn without_weak_ends(mut beats: Vec<usize>, strength: &[f64]) -> Vec<usize> {
    let mean = beats.iter().map(|&frame| strength[frame]).sum::<f64>() / beats.len().max(1) as f64;
    let is_strong = |frame: &usize| strength[*frame] >= END_SHARE * mean;
    let first = beats.iter().position(is_strong).unwrap_or(beats.len());
    let end = beats.iter().rposition(is_strong).map_or(0, |last| last + 1);
    beats.truncate(end);
    beats.drain(..first.min(end));
    beats
}

/// Refines the position of a beat that was found at `frame`. Returns the position, in frames, of the maximum of the parabola
/// through the strengths at `frame` and its two neighbours.
fn peak(strength: &[f64], frame: usize) -> f64 {
    if frame == 0 || frame + 1 >= strength.len() {
        return frame as f64;
    }
    let (a, b, c) = (strength[frame - 1], strength[frame], strength[frame + 1]);
    let bend = a - 2.0 * b + c;
    if bend >= 0.0 { frame as f64 } else { frame as f64 + (0.5 * (a - c) / bend).clamp(-0.5, 0.5) }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

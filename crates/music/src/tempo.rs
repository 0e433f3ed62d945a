//! Estimates the tempo at each second: a comb over the autocorrelation of the onsets, and the most likely sequence of
//! tempi.

use crate::onsets::{FRAMES_PER_S, Onsets};

/// The slowest tempo that is tried, beats per minute.
const SLOWEST_BPM: f64 = 45.0;
/// The fastest tempo that is tried, beats per minute.
const FASTEST_BPM: f64 = 230.0;

/// Number of tempi that are tried per octave, which is a factor of two: steps of 1.5 %.
const PER_OCTAVE: f64 = 48.0;

/// Length of sound from which one tempo is estimated, seconds.
const SPAN_S: f64 = 8.0;

/// Weights of the autocorrelation at a lag of one, two, three and four beats, in the measure of how well a tempo fits.
const COMB: [f64; 4] = [1.0, 0.7, 0.5, 0.4];

/// The tempo that people tap most readily, beats per minute.
const USUAL_BPM: f64 = 115.0;
/// Standard deviation of the tempi that people tap, octaves (factors of two).
const USUAL_OCTAVES: f64 = 0.7;

/// Weight of the fit to the bass band, relative to the fit to all bands. Bass counts extra, because notes between beats
/// seldom have bass.
const BASS: f64 = 0.5;

/// Cost of a change of tempo by one octave from one second to the next, subtracted from the logarithm of the likelihood.
const CHANGE: f64 = 20.0;

/// Added to each likelihood. Where all likelihoods are much smaller, as in silence, no tempo is preferred, so that the tempo
/// before and after is kept.
const FLOOR: f64 = 0.05;

/// Returns the length of a beat at each second of the music, in frames.
pub(crate) fn periods(onsets: &Onsets) -> Vec<f64> {
    let tempi = tempi();
    let seconds = (onsets.all.len() as f64 / FRAMES_PER_S).ceil().max(1.0) as usize;
    let likeness: Vec<Vec<f64>> = (0..seconds)
        .map(|second| {
            let (all, bass) =
                (combs(around(&onsets.all, second), &tempi), combs(around(&onsets.bass, second), &tempi));
            let fits = all.iter().zip(&bass).zip(&tempi);
            fits.map(|((all, bass), &bpm)| (all + BASS * bass).max(0.0) / (1.0 + BASS) * readiness(bpm))
                .collect()
        })
        .collect();
    likeliest(&likeness).into_iter().map(|tempo| period(tempi[tempo])).collect()
}

/// Converts a tempo, in beats per minute, to the length of a beat in frames.
fn period(bpm: f64) -> f64 {
    60.0 / bpm * FRAMES_PER_S
}

/// Returns the tempi that are tried, beats per minute, in increasing order.
fn tempi() -> Vec<f64> {
    let count = ((FASTEST_BPM / SLOWEST_BPM).log2() * PER_OCTAVE) as usize;
    (0..=count).map(|i| SLOWEST_BPM * (i as f64 / PER_OCTAVE).exp2()).collect()
}

/// Returns the onsets of a span of [`SPAN_S`] around the middle of a second. Near the start and the end of the music, the
/// span is moved inwards and not shortened.
fn around(onsets: &[f32], second: usize) -> &[f32] {
    let span = ((SPAN_S * FRAMES_PER_S) as usize).min(onsets.len());
    let middle = ((second as f64 + 0.5) * FRAMES_PER_S) as usize;
    let from = middle.saturating_sub(span / 2).min(onsets.len() - span);
    &onsets[from..from + span]
}

/// Returns how readily people tap a tempo: 1 at [`USUAL_BPM`], less for other tempi.
fn readiness(bpm: f64) -> f64 {
    let octaves = (bpm / USUAL_BPM).log2() / USUAL_OCTAVES;
    (-0.5 * octaves * octaves).exp()
}

/// Returns how well each of `tempi`, in beats per minute, fits a span of onsets: about 1 at best.
fn combs(onsets: &[f32], tempi: &[f64]) -> Vec<f64> {
    let correlation = autocorrelation(onsets);
    let weights: f64 = COMB.iter().sum();
    let fit = |bpm: f64| -> f64 {
        COMB.iter()
            .enumerate()
            .map(|(i, weight)| weight * at(&correlation, (i + 1) as f64 * period(bpm)))
            .sum()
    };
    tempi.iter().map(|&bpm| fit(bpm) / weights).collect()
}

/// Returns the autocorrelation of the onsets at each lag in frames, divided by that at lag 0. All 0 if the onsets do not
/// vary.
fn autocorrelation(onsets: &[f32]) -> Vec<f64> {
    let mean = onsets.iter().map(|v| f64::from(*v)).sum::<f64>() / onsets.len() as f64;
    // Smoothed a little wider than a frame, because musicians do not play exactly.
    let smooth: Vec<f64> = (0..onsets.len())
        .map(|i| {
            let value = |j: usize| f64::from(onsets[j.min(onsets.len() - 1)]);
            0.25 * value(i.saturating_sub(1)) + 0.5 * value(i) + 0.25 * value(i + 1) - mean
        })
        .collect();
    let lags = (COMB.len() as f64 * period(SLOWEST_BPM)) as usize + 2;
    let sum = |lag: usize| -> f64 {
        let overlap = onsets.len().saturating_sub(lag);
        if overlap == 0 {
            0.0
        } else {
            smooth[lag..].iter().zip(&smooth).map(|(a, b)| a * b).sum::<f64>() / overlap as f64
        }
    };
    let whole = sum(0);
    if whole <= 0.0 { vec![0.0; lags] } else { (0..lags).map(|lag| sum(lag) / whole).collect() }
}

/// Interpolates linearly between the values at the two frames around `frame`. Values beyond the end are 0.
fn at(values: &[f64], frame: f64) -> f64 {
    let (index, part) = (frame as usize, frame.fract());
    let value = |i: usize| values.get(i).copied().unwrap_or(0.0);
    value(index) * (1.0 - part) + value(index + 1) * part
}

/// Finds the most likely sequence of tempi with the Viterbi algorithm. `likeness` has, for each second, the likelihood of
/// each tempo. Returns the index of a tempo for each second.
fn likeliest(likeness: &[Vec<f64>]) -> Vec<usize> {
    let count = likeness[0].len();
    let mut total: Vec<f64> = likeness[0].iter().map(|fit| (fit + FLOOR).ln()).collect();
    let mut from: Vec<Vec<usize>> = Vec::new();
    for fits in &likeness[1..] {
        let steps: Vec<(usize, f64)> = (0..count).map(|to| best_step(&total, to)).collect();
        total = steps.iter().zip(fits).map(|((_, sum), fit)| sum + (fit + FLOOR).ln()).collect();
        from.push(steps.into_iter().map(|(index, _)| index).collect());
    }
    let mut course = vec![largest(&total)];
    for steps in from.iter().rev() {
        course.push(steps[course[course.len() - 1]]);
    }
    course.reverse();
    course
}

/// Returns the index of the best previous tempo for the tempo `to`, and its sum in `total` minus the cost of the change.
fn best_step(total: &[f64], to: usize) -> (usize, f64) {
    let cost = |from: usize| CHANGE * from.abs_diff(to) as f64 / PER_OCTAVE;
    let sums: Vec<f64> = total.iter().enumerate().map(|(from, sum)| sum - cost(from)).collect();
    let index = largest(&sums);
    (index, sums[index])
}

/// Index of the largest value; of several equal values, the first.
pub(crate) fn largest(values: &[f64]) -> usize {
    (0..values.len()).fold(0, |best, i| if values[i] > values[best] { i } else { best })
}

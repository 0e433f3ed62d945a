//! Measures how strongly notes begin over time, by rises of the logarithmic spectrum in three bands.

use core::f64::consts::TAU;
use realfft::RealFftPlanner;

use crate::sound::Sound;

/// Number of frames, at which onsets are measured, per second: one every 256 samples at 22,050 samples per second, which is
/// usual for beat trackers.
pub(crate) const FRAMES_PER_S: f64 = 22_050.0 / 256.0;

/// Length of the window of sound around a frame, seconds: 1,024 samples at 22,050 samples per second. At other rates, the
/// number of samples is the nearest power of two.
const WINDOW_S: f64 = 1_024.0 / 22_050.0;

/// A magnitude m of the spectrum is compressed as ln(1 + `LOUD` × m). A sine of full scale has m = 1; with this factor, a
/// sine of -60 dB still counts.
const LOUD: f32 = 1_000.0;

/// A band of the spectrum that is measured separately, so that a bass drum counts beside cymbals.
struct Band {
    /// Upper end of the band, Hz. The band begins at the end of the previous band.
    to_hz: f64,
    /// Weight of the band's onsets in the sum over all bands.
    weight: f32,
}

/// The bands: bass; voices and instruments; cymbals, which have a small weight because they often play between beats.
const BANDS: [Band; 3] = [
    Band { to_hz: 150.0, weight: 1.0 },
    Band { to_hz: 4_000.0, weight: 0.9 },
    Band { to_hz: f64::INFINITY, weight: 0.25 },
];

/// Length of the time around a rise over which the mean that is subtracted from it is taken, seconds.
const MEAN_S: f64 = 1.0;

/// Rises above this share of the largest rise nearby all count as 1. A single crash then does not hide the beats around it.
const PEAK_SHARE: f32 = 0.6;

/// Length of the time around a rise in which the largest rise nearby is searched, seconds.
const PEAK_S: f64 = 4.0;

/// The largest rise nearby counts as at least this share of the largest rise in the whole music. Noise in quiet passages
/// thus stays small.
const PEAK_LEAST: f32 = 0.05;

/// How strongly notes begin at each frame. Frame `i` is at `i / FRAMES_PER_S` seconds from the start of the music.
pub(crate) struct Onsets {
    /// Weighted sum of the onsets in all bands.
    pub all: Vec<f32>,
    /// Onsets in the bass band alone, 0 to 1.
    pub bass: Vec<f32>,
}

/// Measures the onsets of notes in a sound.
pub(crate) fn onsets(sound: &Sound<'_>) -> Onsets {
    let levels = rises(sound).map(|rises| level(&rises));
    let sum = |frame: usize| BANDS.iter().zip(&levels).map(|(band, level)| band.weight * level[frame]).sum();
    let all = (0..levels[0].len()).map(sum).collect();
    let [bass, ..] = levels;
    Onsets { all, bass }
}

/// Returns the rises of each band: for each frame, the mean increase of the compressed magnitudes in the band since the
/// previous frame. Decreases count as 0.
fn rises(sound: &Sound<'_>) -> [Vec<f32>; 3] {
    let rate_hz = sound.rate_hz();
    let size = 1_usize << (WINDOW_S * rate_hz).log2().round() as u32;
    let fft = RealFftPlanner::<f32>::new().plan_fft_forward(size);
    let (mut input, mut spectrum, mut scratch) =
        (fft.make_input_vec(), fft.make_output_vec(), fft.make_scratch_vec());
    let window: Vec<f32> =
        (0..size).map(|i| (0.5 - 0.5 * (TAU * i as f64 / size as f64).cos()) as f32).collect();
    let full_scale = 4.0 / size as f32;
    let band_of: Vec<usize> = (0..spectrum.len())
        .map(|bin| {
            let hz = bin as f64 * rate_hz / size as f64;
            BANDS.iter().position(|band| hz < band.to_hz).unwrap_or(BANDS.len() - 1)
        })
        .collect();
    let mut bins = [0.0_f32; 3];
    band_of.iter().for_each(|&band| bins[band] += 1.0);

    let frames = (sound.lasts_s() * FRAMES_PER_S) as usize + 1;
    let mut last = vec![0.0_f32; spectrum.len()];
    let mut rises = core::array::from_fn(|_| Vec::with_capacity(frames));
    for frame in 0..frames {
        let first = (frame as f64 / FRAMES_PER_S * rate_hz).round() as i64 - size as i64 / 2;
        for (i, (value, weight)) in input.iter_mut().zip(&window).enumerate() {
            *value = sound.sample(first + i as i64) * weight;
        }
        let done = fft.process_with_scratch(&mut input, &mut spectrum, &mut scratch);
        debug_assert!(done.is_ok(), "buffers are of the sizes that the transform names");
        let mut sums = [0.0_f32; 3];
        for ((value, last), &band) in spectrum.iter().zip(&mut last).zip(&band_of) {
            let now = (1.0 + LOUD * full_scale * value.norm()).ln();
            // The first window has none before it. A sound at that point need not begin there.
            if frame > 0 {
                sums[band] += (now - *last).max(0.0);
            }
            *last = now;
        }
        for (band, rises) in rises.iter_mut().enumerate() {
            rises.push(sums[band] / bins[band].max(1.0));
        }
    }
    rises
}

/// Converts the rises of a band to onsets, 0 to 1. The mean around each rise is subtracted, and negative results become
/// 0. Each result is divided by [`PEAK_SHARE`] times the largest result nearby (see [`PEAK_LEAST`]), and is at most 1.
fn level(rises: &[f32]) -> Vec<f32> {
    let above: Vec<f32> = rises.iter().zip(mean(rises)).map(|(rise, mean)| (rise - mean).max(0.0)).collect();
    let largest = above.iter().copied().fold(0.0, f32::max);
    if largest <= 0.0 {
        return above;
    }
    let reach = (PEAK_S * FRAMES_PER_S / 2.0) as usize;
    (0..above.len())
        .map(|i| {
            let near = &above[i.saturating_sub(reach)..(i + reach + 1).min(above.len())];
            let peak = PEAK_SHARE * near.iter().copied().fold(PEAK_LEAST * largest, f32::max);
            (above[i] / peak).min(1.0)
        })
        .collect()
}

/// Returns, for each value, the mean of the values around it, over [`MEAN_S`].
fn mean(values: &[f32]) -> Vec<f32> {
    let reach = (MEAN_S * FRAMES_PER_S / 2.0) as usize;
    let mut sums = vec![0.0_f64];
    for value in values {
        sums.push(sums[sums.len() - 1] + f64::from(*value));
    }
    (0..values.len())
        .map(|i| {
            let (from, to) = (i.saturating_sub(reach), (i + reach + 1).min(values.len()));
            ((sums[to] - sums[from]) / (to - from) as f64) as f32
        })
        .collect()
}

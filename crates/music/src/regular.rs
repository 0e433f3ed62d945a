//! A steady tempo through beats, where they keep one.

/// Beats at a steady tempo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyBeats {
    /// Beats a minute.
    pub bpm: f64,
    /// A beat, whole bars before the first found one: as early as the music allows, seconds.
    pub offset_s: f64,
}

/// Beats are steady if this share of them is near to a steady tempo: a few are found beside the true ones.
const STEADY_SHARE: f64 = 0.95;

/// How near, seconds: half of what counts as the same beat, and more than the errors of beats found in steady music.
const STEADY_S: f64 = 0.025;

/// Beats of a bar in most music: the first beat that was found is taken for the first of a bar.
const BAR: f64 = 4.0;

/// The steady tempo that beats keep (least squares), if they keep one.
#[must_use]
pub fn steady(times_s: &[f64]) -> Option<SteadyBeats> {
    if times_s.len() < 8 {
        return None;
    }
    let count = times_s.len() as f64;
    let (middle, mean) = ((count - 1.0) / 2.0, times_s.iter().sum::<f64>() / count);
    let (mut over, mut under) = (0.0, 0.0);
    for (i, time) in times_s.iter().enumerate() {
        over += (i as f64 - middle) * (time - mean);
        under += (i as f64 - middle).powi(2);
    }
    let beat_s = over / under;
    let at = |i: f64| mean + (i - middle) * beat_s;
    let near =
        times_s.iter().enumerate().filter(|(i, time)| (*time - at(*i as f64)).abs() <= STEADY_S).count();
    let is_steady = near as f64 >= STEADY_SHARE * count;
    let bars_before = (at(0.0) / (beat_s * BAR)).floor();
    is_steady.then(|| SteadyBeats { bpm: 60.0 / beat_s, offset_s: at(-BAR * bars_before).max(0.0) })
}

//! Fits a steady tempo to beats that keep one.

/// Beats at a steady tempo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyBeats {
    /// Beats per minute.
    pub bpm: f64,
    /// Time of the first beat, seconds from the start of the music. It is a whole number of bars of four beats before the
    /// first beat that was found, and as early as possible.
    pub offset_s: f64,
}

/// Share of the found beats that must be near those of a steady tempo. Less than 1, because a few found beats are wrong.
const STEADY_SHARE: f64 = 0.95;

/// Largest distance of a found beat from the nearest beat of the steady tempo at which it is near, seconds. It is more
/// than the errors in steady music.
const STEADY_S: f64 = 0.025;

/// Number of beats in a bar of most music. The first beat that was found is taken as the first of a bar.
const BAR: f64 = 4.0;

/// Fits a steady tempo to beats by least squares. `times_s` are their times, seconds from the start of the music. `None` if
/// there are fewer than eight beats, or they keep no steady tempo.
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

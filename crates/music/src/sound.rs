//! The sound in which beats are searched.

use core::fmt;

/// The shortest sound in which a tempo can be found, seconds.
const SHORTEST_S: f64 = 4.0;

/// The longest sound in which beats are searched, seconds. Shows are shorter, and the samples of an hour take 635 MB in a
/// browser.
const LONGEST_S: f64 = 3600.0;

/// Range of sample rates of sound files, samples per second.
const RATES_HZ: core::ops::RangeInclusive<f64> = 8_000.0..=192_000.0;

/// One channel of sound.
#[derive(Clone, Copy, Debug)]
pub struct Sound<'a> {
    samples: &'a [f32],
    rate_hz: f64,
}

impl<'a> Sound<'a> {
    /// Makes a sound of `samples`, `rate_hz` of them per second. A sample of 1 is full scale. NaN and infinite samples count
    /// as 0.
    ///
    /// # Errors
    /// If the sound is shorter than 4 s or longer than an hour, or its rate is not between 8 and 192 kHz.
    pub fn new(samples: &'a [f32], rate_hz: f64) -> Result<Self, NoBeats> {
        if !RATES_HZ.contains(&rate_hz) {
            return Err(NoBeats::Rate(rate_hz));
        }
        let lasts_s = samples.len() as f64 / rate_hz;
        if lasts_s < SHORTEST_S {
            return Err(NoBeats::Short(lasts_s));
        }
        if lasts_s > LONGEST_S {
            return Err(NoBeats::Long(lasts_s));
        }
        Ok(Sound { samples, rate_hz })
    }

    /// Length of the sound, seconds.
    #[must_use]
    pub fn lasts_s(&self) -> f64 {
        self.samples.len() as f64 / self.rate_hz
    }

    /// Number of samples per second.
    pub(crate) fn rate_hz(&self) -> f64 {
        self.rate_hz
    }

    /// Returns the sample at an index; 0 before the start and after the end.
    pub(crate) fn sample(&self, index: i64) -> f32 {
        let sample = usize::try_from(index).ok().and_then(|i| self.samples.get(i)).copied();
        sample.filter(|value| value.is_finite()).unwrap_or(0.0)
    }
}

/// Why no beats were found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoBeats {
    /// The sound is shorter than 4 s. The value is its length, seconds.
    Short(f64),
    /// The sound is longer than an hour. The value is its length, seconds.
    Long(f64),
    /// The sample rate is out of range. The value is the rate, samples per second.
    Rate(f64),
    /// No onsets of notes, or fewer than two beats were found.
    Silent,
}

impl fmt::Display for NoBeats {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoBeats::Short(s) => {
                write!(f, "The music lasts {s:.1} s. Beats are found in {SHORTEST_S} s or more.")
            }
            NoBeats::Long(s) => {
                let (minutes, longest) = (s / 60.0, LONGEST_S / 60.0);
                write!(
                    f,
                    "The music lasts {minutes:.0} min. Beats are found in up to {longest:.0} min: cut it to the show."
                )
            }
            NoBeats::Rate(hz) => {
                write!(f, "The music has {hz} samples a second; 8,000 to 192,000 can be used.")
            }
            NoBeats::Silent => {
                write!(f, "The music has no notes that begin. Tap the beats, or choose another file.")
            }
        }
    }
}

impl std::error::Error for NoBeats {}

//! Sounds of a few instruments, mixed into one channel. All are calculated from seeds, so pieces are ours and
//! repeatable.

use std::f64::consts::TAU;

/// Sampling rate, Hz.
pub const RATE_HZ: f64 = 22_050.0;

/// A generator of random numbers (SplitMix64).
pub struct Noise(pub u64);

impl Noise {
    /// A uniform random number from 0 to 1.
    pub fn even(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A uniform random number from -1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.even() - 1.0
    }

    /// A random number of about normal distribution, with standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }
}

/// A piece that is being made.
pub struct Tape {
    /// Samples. Full scale is 1.
    pub samples: Vec<f32>,
    noise: Noise,
}

impl Tape {
    /// A silent piece.
    pub fn new(lasts_s: f64, seed: u64) -> Tape {
        Tape { samples: vec![0.0; (lasts_s * RATE_HZ) as usize], noise: Noise(seed) }
    }

    /// Adds the values of `sound` for `lasts_s` seconds from `at_s` on. `sound` gets the seconds since `at_s`.
    fn add(&mut self, at_s: f64, lasts_s: f64, mut sound: impl FnMut(f64, &mut Noise) -> f64) {
        let first = (at_s * RATE_HZ).round() as i64;
        for i in 0..(lasts_s * RATE_HZ) as i64 {
            let value = sound(i as f64 / RATE_HZ, &mut self.noise);
            if let Some(sample) = usize::try_from(first + i).ok().and_then(|at| self.samples.get_mut(at)) {
                *sample += value as f32;
            }
        }
    }

    /// A bass drum: a sine that falls from 150 to 50 Hz.
    pub fn kick(&mut self, at_s: f64, gain: f64) {
        self.add(at_s, 0.3, |t, _| {
            let turns = 50.0 * t + 100.0 * 0.04 * (1.0 - (-t / 0.04).exp());
            gain * 0.9 * (TAU * turns).sin() * (-t / 0.09).exp()
        });
    }

    /// A snare drum: noise and a tone.
    pub fn snare(&mut self, at_s: f64, gain: f64) {
        self.add(at_s, 0.25, |t, noise| {
            gain * (0.4 * noise.signed() * (-t / 0.06).exp()
                + 0.3 * (TAU * 190.0 * t).sin() * (-t / 0.04).exp())
        });
    }

    /// A closed cymbal: bright, short noise.
    pub fn hat(&mut self, at_s: f64, gain: f64) {
        let mut last = 0.0;
        self.add(at_s, 0.08, |t, noise| {
            let now = noise.signed();
            let bright = now - last;
            last = now;
            gain * 0.25 * bright * (-t / 0.02).exp()
        });
    }

    /// A bass note.
    pub fn bass(&mut self, at_s: f64, lasts_s: f64, hz: f64, gain: f64) {
        self.add(at_s, lasts_s, |t, _| {
            let tone: f64 = (1..5).map(|k| (TAU * hz * f64::from(k) * t).sin() / f64::from(k)).sum();
            gain * 0.25 * tone * (t / 0.008).min(1.0) * ((lasts_s - t) / 0.03).clamp(0.0, 1.0)
        });
    }

    /// A held chord that swells in.
    pub fn pad(&mut self, at_s: f64, lasts_s: f64, root_hz: f64, gain: f64) {
        self.add(at_s, lasts_s, |t, _| {
            let tone: f64 = [1.0, 1.26, 1.5].iter().map(|r| (TAU * root_hz * r * t).sin()).sum();
            gain * 0.08 * tone * (t / 0.15).min(1.0) * ((lasts_s - t) / 0.15).clamp(0.0, 1.0)
        });
    }

    /// A short chord like that of a guitar.
    pub fn stab(&mut self, at_s: f64, root_hz: f64, gain: f64) {
        self.add(at_s, 0.2, |t, _| {
            let tone: f64 = [1.0, 1.26, 1.5, 2.0].iter().map(|r| saw(root_hz * r * t)).sum();
            gain * 0.12 * tone * (t / 0.003).min(1.0) * (-t / 0.06).exp()
        });
    }

    /// A note of a piano.
    pub fn piano(&mut self, at_s: f64, hz: f64, gain: f64) {
        self.add(at_s, 1.6, |t, _| {
            let tone: f64 = (1..7)
                .map(|k| {
                    let k = f64::from(k);
                    (TAU * hz * k * (1.0 + 0.0004 * k * k) * t).sin() / k * (-t * k / 0.7).exp()
                })
                .sum();
            gain * 0.3 * tone * (t / 0.004).min(1.0)
        });
    }

    /// Steady noise during the whole piece.
    pub fn hiss(&mut self, gain: f64) {
        let lasts_s = self.samples.len() as f64 / RATE_HZ;
        self.add(0.0, lasts_s, |_, noise| gain * noise.signed());
    }
}

/// A sawtooth wave from -1 to 1, at this number of cycles.
fn saw(turns: f64) -> f64 {
    2.0 * turns.fract() - 1.0
}

//! The pace of a simulation: how long its steps take in real time.

use std::time::Duration;

/// The timing of a world. A real Webots (R2023b) that could run faster keeps 0.967 to 0.972 of real time, and less on a
/// busy machine. It pauses now and then while it loads, draws or its window is moved.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// Simulated seconds per real second.
    pub rate: f64,
    /// Largest deviation of a step's duration from the usual one, seconds.
    pub jitter_s: f64,
    /// Duration of each pause, seconds. 0 for a world without pauses.
    pub pause_s: f64,
    /// Least and most simulated time between two pauses, seconds.
    pub apart_s: (f64, f64),
}

impl Pace {
    /// The pace of an idle Webots.
    pub const WEBOTS: Self = Self { rate: 0.97, jitter_s: 0.003, pause_s: 0.0, apart_s: (3.0, 7.0) };

    /// Webots' pace at another rate.
    pub const fn at(rate: f64) -> Self {
        Self { rate, ..Self::WEBOTS }
    }

    /// Webots' pace with pauses of this length.
    pub const fn pausing(pause_s: f64) -> Self {
        Self { pause_s, ..Self::WEBOTS }
    }
}

/// Durations of the steps of one world.
pub struct Steps {
    pace: Pace,
    step_s: f64,
    until_pause_s: f64,
    dice: u64,
}

impl Steps {
    /// Steps of `step_s` simulated seconds. The same seed gives the same jitter and pauses.
    pub fn new(pace: Pace, step_s: f64, seed: u64) -> Self {
        let mut steps =
            Self { pace, step_s, until_pause_s: 0.0, dice: seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1 };
        steps.until_pause_s = steps.apart_s();
        steps
    }

    /// Real duration of the next step.
    pub fn take(&mut self) -> Duration {
        let mut took_s = self.step_s / self.pace.rate + (2.0 * self.even() - 1.0) * self.pace.jitter_s;
        self.until_pause_s -= self.step_s;
        if self.pace.pause_s > 0.0 && self.until_pause_s <= 0.0 {
            took_s += self.pace.pause_s;
            self.until_pause_s = self.apart_s();
        }
        Duration::from_secs_f64(took_s.max(0.0))
    }

    fn apart_s(&mut self) -> f64 {
        let (least_s, most_s) = self.pace.apart_s;
        least_s + (most_s - least_s) * self.even()
    }

    fn even(&mut self) -> f64 {
        self.dice ^= self.dice << 13;
        self.dice ^= self.dice >> 7;
        self.dice ^= self.dice << 17;
        (self.dice >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn steps_take_what_the_pace_says() {
    let total_s = |pace| {
        let mut steps = Steps::new(pace, 0.016, 1);
        (0..10_000).map(|_| steps.take().as_secs_f64()).sum::<f64>()
    };
    let (usual_s, slow_s) = (total_s(Pace::WEBOTS), total_s(Pace::at(0.8)));
    assert!((usual_s - 160.0 / 0.97).abs() < 1.0 && (slow_s - 200.0).abs() < 1.0, "{usual_s} {slow_s}");
    // One pause per 3 to 7 s of 160 s.
    let pauses = (total_s(Pace::pausing(0.9)) - usual_s) / 0.9;
    assert!((25.0..45.0).contains(&pauses), "{pauses}");
}

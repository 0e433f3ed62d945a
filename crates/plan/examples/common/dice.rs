//! Repeatable random numbers.
// Each example uses only a part of this module.
#![allow(dead_code)]

use lightbots_base::Vec2;
use lightbots_base::random::split_mix;

/// A small generator (SplitMix64).
pub struct Dice(u64);

impl Dice {
    /// The generator for a case of a kind of transition.
    pub fn new(kind: u64, case: u64) -> Self {
        Self(kind.wrapping_mul(0xd1b5_4a32_d192_ed03).wrapping_add(case))
    }

    /// A random number from 0 to below 1.
    pub fn share(&mut self) -> f64 {
        (split_mix(&mut self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A random number from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    /// A random whole number from `low` to `high`, both included.
    pub fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.share() * (high + 1 - low) as f64) as usize
    }

    /// A random number from `low` to `high`, log-uniform: small numbers are more frequent than large ones.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        (low as f64 * (high as f64 / low as f64).powf(self.share())).round() as usize
    }

    /// A random place on a floor of this half size.
    pub fn place(&mut self, half: Vec2) -> Vec2 {
        Vec2::new(self.between(-half.x, half.x), self.between(-half.y, half.y))
    }

    /// Shuffles a slice.
    pub fn shuffle<T>(&mut self, things: &mut [T]) {
        for last in (1..things.len()).rev() {
            things.swap(last, self.whole(0, last));
        }
    }
}

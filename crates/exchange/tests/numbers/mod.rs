//! Random numbers for seeded tests.

use lightbots_base::random::split_mix;

/// A generator of pseudo-random numbers (SplitMix64). Each run gives the same numbers.
pub struct Numbers(pub u64);

impl Numbers {
    /// A whole number from 0 to below `sides`.
    pub fn below(&mut self, sides: usize) -> usize {
        (split_mix(&mut self.0) % sides.max(1) as u64) as usize
    }
}

//! Random numbers. A seed and a purpose give the same stream of numbers on every machine.

use std::sync::LazyLock;

use lightbots_base::random::split_mix;

/// Purpose of a stream of random numbers. Each purpose has its own stream, so that more numbers for one (a noisier
/// sensor) do not change another (which message is lost).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Names, clocks and batteries of robots.
    Robots = 1,
    /// Slip of wheels.
    Slip = 2,
    /// Noise of position fixes.
    Sensors = 3,
    /// Delay, loss and order of messages.
    Links = 4,
    /// Random breakdowns.
    Breakdowns = 5,
    /// Generated shows.
    Scene = 6,
    /// Noise of proximity sensors.
    Proximity = 7,
    /// When clients find a broker again.
    Broker = 8,
    /// Faults of a campaign.
    Campaign = 9,
}

/// A stream of random numbers: xoshiro256++ (Blackman and Vigna, 2019), seeded through SplitMix64.
#[derive(Clone, Debug)]
pub struct Dice {
    state: [u64; 4],
}

/// Quantiles of the normal distribution at (i + ½) / 4096 for i from 0, scaled to a standard deviation of 1.
static NORMAL: LazyLock<Box<[f32; NORMAL_LEN]>> = LazyLock::new(normal_table);
/// Length of [`NORMAL`]. An index takes 12 bits of a draw, and the table 16 KB, half of a first-level cache.
const NORMAL_LEN: usize = 4096;

impl Dice {
    /// The stream of a seed for a purpose.
    pub fn new(seed: u64, purpose: Purpose) -> Self {
        let mut mix = seed ^ (purpose as u64).wrapping_mul(0xd1b5_4a32_d192_ed03);
        Self { state: std::array::from_fn(|_| split_mix(&mut mix)) }
    }

    /// 64 random bits.
    #[inline]
    pub fn bits(&mut self) -> u64 {
        let s = &mut self.state;
        let result = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let t = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= t;
        s[3] = s[3].rotate_left(45);
        result
    }

    /// Draws a uniformly distributed number from 0 (included) to 1 (excluded).
    #[inline]
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Draws a uniformly distributed number from `low` (included) to `high` (excluded).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Draws a uniformly distributed whole number from 0 to `end - 1`; 0 if `end` is 0.
    pub fn below(&mut self, end: u64) -> u64 {
        ((u128::from(self.bits()) * u128::from(end)) >> 64) as u64
    }

    /// Returns true with this probability. If the probability is 0, no number is drawn.
    #[inline]
    pub fn chance(&mut self, probability: f64) -> bool {
        probability > 0.0 && self.unit() < probability
    }

    /// Four independent normal numbers of mean 0 and standard deviation 1, cut off at ±3.7, from one draw.
    #[inline]
    pub fn normal4(&mut self) -> [f64; 4] {
        normal_of(self.bits(), [52, 40, 28, 16])
    }

    /// Three independent normal numbers of mean 0 and standard deviation 1, cut off at ±3.7. One draw and three
    /// look-ups are enough, because every robot needs these numbers at every step.
    #[inline]
    pub fn normal3(&mut self) -> [f64; 3] {
        normal3_of(self.bits())
    }
}

/// The three normal numbers of one draw.
#[inline]
pub(crate) fn normal3_of(bits: u64) -> [f64; 3] {
    normal_of(bits, [52, 40, 28])
}

/// Normal numbers of mean 0 and standard deviation 1. Each uses 12 bits of `bits`, which begin at one of the positions
/// `shifts`.
#[inline]
fn normal_of<const COUNT: usize>(bits: u64, shifts: [u32; COUNT]) -> [f64; COUNT] {
    let table: &[f32; NORMAL_LEN] = &NORMAL;
    shifts.map(|shift| f64::from(table[(bits >> shift) as usize % NORMAL_LEN]))
}

fn normal_table() -> Box<[f32; NORMAL_LEN]> {
    let mut raw = [0.0; NORMAL_LEN];
    let mut below = -4.0;
    for place in 0..NORMAL_LEN / 2 {
        below = quantile((place as f64 + 0.5) / NORMAL_LEN as f64, below);
        (raw[place], raw[NORMAL_LEN - 1 - place]) = (below, -below);
    }
    let deviation = libm::sqrt(raw.iter().map(|z| z * z).sum::<f64>() / NORMAL_LEN as f64);
    Box::new(raw.map(|z| (z / deviation) as f32))
}

/// Quantile of the standard normal distribution at probability `p`, by Newton's method from the start value `near`.
fn quantile(p: f64, mut near: f64) -> f64 {
    for _ in 0..50 {
        let density = libm::exp(-0.5 * near * near) / libm::sqrt(core::f64::consts::TAU);
        let step = (below(near) - p) / density;
        near -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    near
}

/// The probability of a normal number below `z`.
fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / core::f64::consts::SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_repeats_and_purposes_differ() {
        let throws = |seed, purpose| Dice::new(seed, purpose).bits();
        assert_eq!(throws(7, Purpose::Slip), throws(7, Purpose::Slip));
        assert_ne!(throws(7, Purpose::Slip), throws(7, Purpose::Links));
        assert_ne!(throws(7, Purpose::Slip), throws(8, Purpose::Slip));
    }

    #[test]
    fn the_table_holds_quantiles() {
        let table: &[f32; NORMAL_LEN] = &NORMAL;
        let p = |place: usize| (place as f64 + 0.5) / NORMAL_LEN as f64;
        // The 2.5 % quantile is in any table of the distribution. Scaling makes up for the ends that are cut off.
        assert!((quantile(0.025, -1.0) + 1.959_963_985).abs() < 1e-9);
        let widened = f64::from(table[100]) / quantile(p(100), -1.0);
        assert!((1.0..1.001).contains(&widened), "{widened}");
        for (place, &z) in table.iter().enumerate() {
            assert!((below(f64::from(z) / widened) - p(place)).abs() < 1e-7, "{place}: {z}");
            assert_eq!(z, -table[NORMAL_LEN - 1 - place]);
        }
    }

    #[test]
    fn normal_numbers_are_normal() {
        let mut dice = Dice::new(1, Purpose::Sensors);
        let (mut sum, mut squares, mut outside, mut product) = (0.0, 0.0, 0, 0.0);
        let rounds = 100_000;
        for _ in 0..rounds {
            let [a, b, c] = dice.normal3();
            sum += a + b + c;
            squares += a * a + b * b + c * c;
            outside += [a, b, c].iter().filter(|z| z.abs() > 1.96).count();
            product += a * b + b * c;
        }
        let n = 3.0 * f64::from(rounds);
        assert!((sum / n).abs() < 0.01);
        assert!((squares / n - 1.0).abs() < 0.01);
        assert!((outside as f64 / n - 0.05).abs() < 0.003);
        assert!((product / n).abs() < 0.01);
    }

    #[test]
    fn even_numbers_fill_their_range() {
        let mut dice = Dice::new(3, Purpose::Links);
        let mut seen = [0; 10];
        for _ in 0..10_000 {
            seen[dice.below(10) as usize] += 1;
        }
        assert!(seen.iter().all(|count| (900..1100).contains(count)), "{seen:?}");
        assert_eq!(dice.below(0), 0);
        assert!(!dice.chance(0.0) && dice.chance(1.0));
    }
}

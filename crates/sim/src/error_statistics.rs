//! How far robots are from where they believe to be and from where their routes are, and their clocks from each other.

use lightbots_base::Instant;

use crate::robot_set::Ours;
use crate::statistics::Spread;
use crate::world::World;

/// A robot is looked at every so many steps, each at another one.
const EVERY: u64 = 8;
/// Width of a bin, metres.
const BIN_M: f64 = 0.0001;
/// Bins; what is further off counts in the last, its greatest apart.
const BINS: usize = 1_000;

/// What is known so far. Only robots with a route under way count.
#[derive(Debug, Default)]
pub(crate) struct ErrorStatistics {
    estimate: Tally,
    tracking: Tally,
    /// Of the clocks of all robots at once, seconds, one a sampling.
    clocks_s: Vec<f64>,
}

/// Distances counted in bins: a rehearsal has millions.
#[derive(Debug)]
struct Tally {
    bins: Vec<u32>,
    count: u64,
    max_m: f64,
}

impl ErrorStatistics {
    /// Looks at a robot after the world moved and before it thinks: where its last step wanted it to be by now.
    #[inline]
    pub fn look(&mut self, step: u64, index: usize, robot: &Ours, world: &World) {
        if !(step + index as u64).is_multiple_of(EVERY) {
            return;
        }
        if let Some(wanted) = robot.route_place() {
            self.tracking.add(world.places()[index].distance(wanted));
        }
    }

    /// Looks at a robot after it took in what its sensors said.
    #[inline]
    pub fn look_again(&mut self, step: u64, index: usize, robot: &Ours, world: &World) {
        if !(step + index as u64).is_multiple_of(EVERY) || robot.route_place().is_none() {
            return;
        }
        if let Some(believed) = robot.pose() {
            self.estimate.add(world.places()[index].distance(believed.at));
        }
    }

    /// Takes what robots believe the show clock says at one moment.
    pub fn clocks(&mut self, shown: impl Iterator<Item = Instant>) {
        let (first, last, count) = shown
            .fold((Instant::FAR, Instant::ZERO, 0), |(first, last, count), at| {
                (at.min(first), at.max(last), count + 1)
            });
        if count > 0 {
            self.clocks_s.push((last - first).as_secs());
        }
    }

    /// Between where robots believe to be and where they are, metres.
    pub fn estimate_m(&self) -> Spread {
        self.estimate.spread()
    }

    /// Between where robots should be by their routes and where they are, metres.
    pub fn tracking_m(&self) -> Spread {
        self.tracking.spread()
    }

    /// Between the clocks that are furthest apart, seconds.
    pub fn clocks_s(&self) -> Spread {
        Spread::of(&self.clocks_s)
    }
}

impl Default for Tally {
    fn default() -> Self {
        Self { bins: vec![0; BINS], count: 0, max_m: 0.0 }
    }
}

impl Tally {
    #[inline]
    fn add(&mut self, metres: f64) {
        let bin = ((metres * (1.0 / BIN_M)) as usize).min(BINS - 1);
        self.bins[bin] = self.bins[bin].saturating_add(1);
        self.count += 1;
        self.max_m = self.max_m.max(metres);
    }

    /// Median and 99th percentile are upper ends of bins.
    fn spread(&self) -> Spread {
        let rank = |percent: u64| {
            let wanted = (self.count * percent).div_ceil(100);
            let mut counted = 0;
            let bin = self.bins.iter().position(|&count| {
                counted += u64::from(count);
                counted >= wanted
            });
            bin.map_or(0.0, |bin| (bin as f64 + 1.0) * BIN_M).min(self.max_m)
        };
        Spread { median: rank(50), p99: rank(99), max: self.max_m }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_give_the_ranks_within_a_tenth_of_a_millimetre() {
        let mut tally = Tally::default();
        assert_eq!(tally.spread(), Spread::default());
        for number in 1..=200 {
            tally.add(f64::from(number) * 0.000301);
        }
        let Spread { median, p99, max } = tally.spread();
        let near = |value: f64, wanted: f64| (value - wanted).abs() < 1.5 * BIN_M;
        assert!(near(median, 0.0301) && near(p99, 0.0596) && near(max, 0.0602), "{median} {p99} {max}");
        tally.add(f64::INFINITY);
        assert_eq!(tally.spread().max, f64::INFINITY);
    }

    #[test]
    fn clocks_are_apart_as_far_as_the_first_and_the_last() {
        let mut errors = ErrorStatistics::default();
        errors.clocks([Instant(5_000), Instant(2_000), Instant(3_000)].into_iter());
        errors.clocks(std::iter::empty());
        assert_eq!(errors.clocks_s(), Spread { median: 0.003, p99: 0.003, max: 0.003 });
    }
}

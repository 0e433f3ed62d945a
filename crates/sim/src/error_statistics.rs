//! Statistics of errors: of the robots' position estimates, of following routes, and between the robots' clocks.

use lightbots_base::Instant;

use crate::firmware::Ours;
use crate::statistics::Spread;
use crate::world::World;

/// Each robot is sampled once in this number of steps. Robots take turns, so that each step samples an eighth of them.
const EVERY: u64 = 8;
/// Width of a bin of the error histograms, metres.
const BIN_M: f64 = 0.0001;
/// Number of bins of a histogram. Larger errors count in the last bin; the largest error is stored separately.
const BINS: usize = 1_000;

/// The errors sampled until now. Places are sampled only of robots that are on a route.
#[derive(Debug, Default)]
pub(crate) struct ErrorStatistics {
    estimate: Tally,
    tracking: Tally,
    /// In each sample, the largest difference between the show clocks of two robots, seconds.
    clocks_s: Vec<f64>,
}

/// A histogram of distances. Single distances are not stored, because a rehearsal has millions.
#[derive(Debug)]
struct Tally {
    bins: Vec<u32>,
    count: u64,
    max_m: f64,
}

impl ErrorStatistics {
    /// Samples the tracking error of a robot, if it is the robot's turn (see [`EVERY`]) and it is on a route: the
    /// distance of its true place from its place on the route. Call it after the world moved and before the robot's
    /// step.
    #[inline]
    pub fn sample_tracking(&mut self, step: u64, index: usize, robot: &Ours, world: &World) {
        if !(step + index as u64).is_multiple_of(EVERY) {
            return;
        }
        if let Some(wanted) = robot.route_place() {
            self.tracking.add(world.places()[index].distance(wanted));
        }
    }

    /// Samples the error of a robot's estimated place, if it is the robot's turn (see [`EVERY`]), it is on a route and
    /// it has an estimate: the distance from the true place. Call it after the robot's step.
    #[inline]
    pub fn sample_estimate(&mut self, step: u64, index: usize, robot: &Ours, world: &World) {
        if !(step + index as u64).is_multiple_of(EVERY) || robot.route_place().is_none() {
            return;
        }
        if let Some(believed) = robot.pose() {
            self.estimate.add(world.places()[index].distance(believed.at));
        }
    }

    /// Samples the largest difference between two show clocks. `shown`: what the robots' show clocks read at one
    /// moment. Without clocks, nothing is sampled.
    pub fn sample_clocks(&mut self, shown: impl Iterator<Item = Instant>) {
        let (first, last, count) = shown
            .fold((Instant::FAR, Instant::ZERO, 0), |(first, last, count), at| {
                (at.min(first), at.max(last), count + 1)
            });
        if count > 0 {
            self.clocks_s.push((last - first).as_secs());
        }
    }

    /// Distance of the estimated from the true place, metres.
    pub fn estimate_m(&self) -> Spread {
        self.estimate.spread()
    }

    /// Distance between the robot's true place and its place on the route, metres.
    pub fn tracking_m(&self) -> Spread {
        self.tracking.spread()
    }

    /// Largest difference between the show clocks of two robots, one value a sample, seconds.
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

    /// Median, 99th percentile and maximum, metres; all 0 without samples. The first two are upper ends of bins, but
    /// never more than the maximum. Errors beyond the last bin count as its upper end.
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
        errors.sample_clocks([Instant(5_000), Instant(2_000), Instant(3_000)].into_iter());
        errors.sample_clocks(std::iter::empty());
        assert_eq!(errors.clocks_s(), Spread { median: 0.003, p99: 0.003, max: 0.003 });
    }
}

//! The robot's own clock: the simulation's, unless that does not keep pace.

use std::time::Duration;

use lightbots_base::Instant;

/// A simulation that is this far beside real time has lost its pace, seconds. What is less the robot's own show clock
/// follows more gently.
const OFF_PACE_S: f64 = 0.25;
/// The clock goes on by at least this in every step, microseconds.
const LEAST_US: u64 = 500;

/// Simulated time, moved along where the simulation falls behind real time or runs ahead of it. All robots of a show
/// share its clock: one that went by a slow simulation alone would be ever later on its route than it knows, and each by
/// another amount.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    /// What is added to simulated time, seconds, once the first step was.
    ahead_s: Option<f64>,
    last: Instant,
}

impl Pace {
    /// The moment it is when the simulation shows `simulated_s` and so much real time has passed since some start.
    pub(crate) fn now(&mut self, simulated_s: f64, passed: Duration) -> Instant {
        let real_s = passed.as_secs_f64();
        // Both begin together: what stood on the simulation's clock before is of no interest.
        let ahead_s = self.ahead_s.get_or_insert(real_s - simulated_s);
        let behind_s = real_s - (simulated_s + *ahead_s);
        if behind_s.abs() > OFF_PACE_S {
            *ahead_s += behind_s;
        }
        self.last = Instant::from_secs(simulated_s + *ahead_s).max(Instant(self.last.0 + LEAST_US));
        self.last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The clock after so much simulated and real time, milliseconds.
    fn at(pace: &mut Pace, simulated_ms: u64, real_ms: u64) -> u64 {
        pace.now(simulated_ms as f64 * 1e-3, Duration::from_millis(real_ms)).0 / 1000
    }

    #[test]
    fn a_simulation_that_keeps_pace_is_the_clock() {
        let mut pace = Pace::default();
        let seen: Vec<u64> =
            [(16, 0), (32, 31), (48, 40), (64, 70)].map(|(sim, real)| at(&mut pace, sim, real)).into();
        assert!(seen.windows(2).all(|pair| pair[1] - pair[0] == 16), "{seen:?}");
    }

    #[test]
    fn where_it_falls_behind_real_time_counts() {
        let mut pace = Pace::default();
        at(&mut pace, 0, 0);
        assert_eq!(at(&mut pace, 16, 2_000), 2_000);
        assert_eq!(at(&mut pace, 32, 2_020), 2_016);
    }

    #[test]
    fn where_it_runs_ahead_the_clock_waits_but_never_goes_back() {
        let mut pace = Pace::default();
        at(&mut pace, 0, 0);
        let first = at(&mut pace, 2_000, 1_000);
        assert_eq!(first, 1_000);
        let mut last = first;
        for step in 1..100 {
            let now = at(&mut pace, 2_000 + 16 * step, 1_000 + step);
            assert!((last..=1_000 + step + 260).contains(&now), "{now}");
            last = now;
        }
    }
}

//! Two clocks that connect the time of the simulation with the show clock.
//!
//! The *own clock* is this machine's clock. It is synchronised with the show clock, so it must not be adjusted. The
//! *world clock* counts the steps of the simulation, but runs slightly faster or slower than the simulation to follow
//! the own clock. Routes use the world clock. All robots of a simulation step together and read one machine's clock, so
//! their world clocks agree. Therefore robots keep their planned distances even in a simulation that pauses or is
//! slower than real time.

use std::time::Duration;

use lightbots_base::{Instant, Span};

/// Share of the lag (own clock minus world clock) that a driving robot makes up in a step. In the step after a pause,
/// any robot makes up this share. With a larger share, a late reading of the clock on a busy machine moves the robot.
/// With a smaller share, the lag grows. A simulation at 0.967 of real time (docs/webots.md) lags by 0.034 of a step
/// divided by this share, which is 11 ms or 3 mm.
const DRIVING_SHARE: f64 = 0.05;
/// Like `DRIVING_SHARE`, for a robot without a route. The share is larger, because making up the lag does not move a
/// robot at rest.
const RESTING_SHARE: f64 = 0.3;
/// Largest rate of the world clock for a driving robot, world seconds per simulated second. Accelerations grow with the
/// square of this rate, and an Elisa-3 stumbles between 1 and 2 m/s² (docs/simulator.md).
const DRIVING_RATE: f64 = 1.1;
/// Like `DRIVING_RATE`, for a robot without a route. At this rate, a robot makes up a lag of 4 s within 0.3 s. With a
/// smaller rate, the last robot to arrive would begin its next route late.
const RESTING_RATE: f64 = 14.0;
/// A step that takes longer than this in real time counts as a pause, seconds: about three steps of 16 ms. With a
/// smaller value, jitter of a busy machine counts as pauses. With a larger value, short pauses move robots. Chosen, not
/// measured.
const PAUSE_S: f64 = 0.05;
/// Least advance of the world clock in a step, seconds. Without it the robot core could see one moment twice.
const LEAST_S: f64 = 0.000_5;

/// The time of one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tick {
    /// Present time on the own clock.
    pub now: Instant,
    /// Own clock minus world clock; negative if the world clock is ahead.
    pub lag: Span,
    /// Rate of the world clock, world seconds per simulated second, but at most `DRIVING_RATE`; 1 if no simulated time
    /// has passed. The driver multiplies wheel rates by it. Speeds per world time are then those that the robot core
    /// commands.
    pub rate: f64,
}

/// The two clocks of a robot.
#[derive(Debug, Default)]
pub(crate) struct WorldClock {
    /// Simulated time and world clock at the latest step, both in seconds; `None` before the first step.
    last: Option<(f64, f64)>,
    /// Own clock at the latest step, seconds.
    last_real_s: f64,
}

impl WorldClock {
    /// Returns the times of a step. `simulated_s`: time of the simulation, seconds. `passed`: time on the own clock.
    /// `drives`: whether a route is under way.
    pub(crate) fn tick(&mut self, simulated_s: f64, passed: Duration, drives: bool) -> Tick {
        let real_s = passed.as_secs_f64();
        // The first step after a pause counts as one usual step.
        let paused = real_s - std::mem::replace(&mut self.last_real_s, real_s) > PAUSE_S;
        let (share, rate_max) =
            if drives || paused { (DRIVING_SHARE, DRIVING_RATE) } else { (RESTING_SHARE, RESTING_RATE) };
        // Both clocks begin together, at any time of the simulation.
        let (last_simulated_s, last_world_s) = self.last.unwrap_or((simulated_s, real_s));
        let step_s = (simulated_s - last_simulated_s).max(0.0);
        let missing_s = (real_s - (last_world_s + step_s)) * share;
        let went_s = (step_s + missing_s).min(step_s * rate_max).max(LEAST_S);
        let world_s = last_world_s + went_s;
        self.last = Some((simulated_s, world_s));
        let rate = if step_s > 0.0 { (went_s / step_s).min(DRIVING_RATE) } else { 1.0 };
        Tick { now: Instant::from_secs(real_s), lag: Span::from_secs(real_s - world_s), rate }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Duration of a step, simulated seconds.
    const STEP_S: f64 = 0.016;

    /// A simulation with the clocks of some robots. Each robot reads the own clock late, by up to 4 ms.
    struct World {
        robots: Vec<(WorldClock, u64)>,
        simulated_s: f64,
        real_s: f64,
        ticks: Vec<Tick>,
    }

    impl World {
        fn new(robots: u64) -> Self {
            let robots = (1..=robots).map(|seed| (WorldClock::default(), seed * 7_919)).collect();
            Self { robots, simulated_s: 0.0, real_s: 0.0, ticks: Vec::new() }
        }

        /// Runs `steps` steps, each of which takes this real time, seconds.
        fn run(&mut self, steps: usize, real_step_s: f64, drives: bool) {
            for _ in 0..steps {
                self.simulated_s += STEP_S;
                self.real_s += real_step_s;
                let (simulated_s, real_s) = (self.simulated_s, self.real_s);
                self.ticks.clear();
                for (clock, seed) in &mut self.robots {
                    *seed =
                        seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    let late_s = (*seed >> 40) as f64 / (1_u64 << 24) as f64 * 0.004;
                    let passed = Duration::from_secs_f64(real_s + late_s);
                    self.ticks.push(clock.tick(simulated_s, passed, drives));
                }
            }
        }

        /// Returns the largest difference of the robots' world clocks, and the lag of the first one, seconds.
        fn apart_and_behind_s(&self) -> (f64, f64) {
            let world = self.ticks.iter().map(|tick| (tick.now - tick.lag).as_secs());
            let (least, most) =
                world.fold((f64::INFINITY, 0.0_f64), |(least, most), s| (least.min(s), most.max(s)));
            (most - least, self.ticks[0].lag.as_secs())
        }
    }

    #[test]
    fn webots_usual_pace_costs_three_millimetres() {
        let mut world = World::new(30);
        world.run(2_000, STEP_S / 0.967, true);
        let (apart_s, behind_s) = world.apart_and_behind_s();
        assert!(apart_s < 0.002, "{apart_s}");
        assert!((0.008..0.016).contains(&behind_s), "{behind_s}");
        assert!(world.ticks.iter().all(|tick| (tick.rate - 1.034).abs() < 0.015));
    }

    #[test]
    fn pauses_leave_robots_together_and_are_worked_off() {
        // Near 0.25 s, the readings of the robots differ in what they take for a pause.
        for pause_s in [0.2, 0.25, 0.4, 0.9, 2.5] {
            let mut world = World::new(30);
            world.run(500, STEP_S / 0.97, true);
            let mut last_s = (world.ticks[0].now - world.ticks[0].lag).as_secs();
            world.real_s += pause_s;
            for _ in 0..2_500 {
                world.run(1, STEP_S / 0.97, true);
                let (apart_s, _) = world.apart_and_behind_s();
                assert!(apart_s < 0.005, "pause {pause_s}: path times are {apart_s} s apart");
                let now_s = (world.ticks[0].now - world.ticks[0].lag).as_secs();
                assert!(now_s > last_s && now_s - last_s < DRIVING_RATE * STEP_S + 1e-5);
                last_s = now_s;
            }
            let (_, behind_s) = world.apart_and_behind_s();
            assert!(behind_s < 0.02, "pause {pause_s}: still {behind_s} s behind");
        }
    }

    #[test]
    fn what_a_slow_simulation_lags_is_made_good_at_rest() {
        let mut world = World::new(30);
        world.run(500, STEP_S / 0.8, true);
        let (apart_s, behind_s) = world.apart_and_behind_s();
        assert!(apart_s < 0.005 && (0.8..1.5).contains(&behind_s), "{apart_s} {behind_s}");
        world.run(60, STEP_S / 0.8, false);
        let (apart_s, behind_s) = world.apart_and_behind_s();
        assert!(apart_s < 0.005 && behind_s < 0.02, "{apart_s} {behind_s}");
    }

    #[test]
    fn a_robot_that_arrives_last_after_a_long_pause_begins_its_next_route_with_the_others() {
        let mut world = World::new(2);
        world.run(100, STEP_S / 0.97, true);
        world.real_s += 2.5;
        world.run(1, STEP_S / 0.97, true);
        // 0.32 s from its arrival to the next START.
        world.run(20, STEP_S / 0.97, false);
        let (_, behind_s) = world.apart_and_behind_s();
        assert!(behind_s < 0.05, "{behind_s}");
    }

    #[test]
    fn a_simulation_that_runs_ahead_has_its_clock_wait_but_not_go_back() {
        let mut world = World::new(1);
        world.run(10, STEP_S, false);
        let mut last = Instant::ZERO;
        for _ in 0..300 {
            world.run(1, STEP_S / 12.0, false);
            let now = world.ticks[0].now - world.ticks[0].lag;
            assert!(now > last);
            last = now;
        }
        let (_, behind_s) = world.apart_and_behind_s();
        assert!(behind_s.abs() < 0.05, "{behind_s}");
    }
}

//! How the time of the simulation and that of the show clock go together.
//!
//! Two clocks. The *own clock* is this machine's: it tells moments to the controller and is compared with the show clock,
//! so nothing may bend it. The *world's clock* goes by the steps of the simulation, a little faster or slower, so that it
//! follows the own clock. Routes go by the world's clock. All robots of a simulation take its steps together and read
//! the same machine's clock, so their world clocks agree, whatever the simulation does: it may be slower than real time
//! or stand for a while, and the robots stay where the plan has them with respect to each other.

use std::time::Duration;

use lightbots_base::{Instant, Span};

/// Share of the lag that is worked off in a step: of robots that drive, and of robots that have no route. What a busy
/// machine reads too late by a few milliseconds must not move a robot, so less is smoother; a simulation at 0.967 of
/// real time lags by 0.034 of a step over this share: 11 ms, which are 3 mm.
const DRIVING_SHARE: f64 = 0.05;
const RESTING_SHARE: f64 = 0.3;
/// Seconds of the world's clock in a second of the simulation, at most: of robots that drive, because accelerations grow
/// with its square and an Elisa-3 stumbles somewhere between 1 and 2 m/s² (docs/simulator.md); and of robots that have
/// no route: fast enough for one that arrives last to be where the others are before the next START, 0.3 s later.
const DRIVING_RATE: f64 = 1.1;
const RESTING_RATE: f64 = 14.0;
/// A step that takes longer than this is a pause, seconds.
const PAUSE_S: f64 = 0.05;
/// The world's clock goes on by at least this in every step, seconds.
const LEAST_S: f64 = 0.000_5;

/// The moment of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Tick {
    /// By the own clock.
    pub now: Instant,
    /// How far the world's clock is behind it; negative: ahead.
    pub lag: Span,
    /// Seconds of the world's clock in a second of the simulation: wheels must turn faster by this for speeds to be as
    /// the robot means them.
    pub rate: f64,
}

/// The two clocks of a robot.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    /// What the simulation showed at the latest step, and the world's clock then, seconds.
    last: Option<(f64, f64)>,
    /// This machine's clock then, seconds.
    last_real_s: f64,
}

impl Pace {
    /// The moment it is when the simulation shows `simulated_s` and `real` time has passed since some start;
    /// `drives`: a route is under way.
    pub(crate) fn tick(&mut self, simulated_s: f64, passed: Duration, drives: bool) -> Tick {
        let real_s = passed.as_secs_f64();
        // The first step after a pause is one like the others: the robot takes it for as long as this machine did.
        let paused = real_s - std::mem::replace(&mut self.last_real_s, real_s) > PAUSE_S;
        let (share, rate_max) =
            if drives || paused { (DRIVING_SHARE, DRIVING_RATE) } else { (RESTING_SHARE, RESTING_RATE) };
        // Both begin together: what stood on the simulation's clock before is of no interest.
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

    const STEP_S: f64 = 0.016;

    /// A simulation and the clocks of some of its robots, each of which reads this machine's clock too late by its own
    /// amount, up to 4 ms, at each step.
    struct World {
        robots: Vec<(Pace, u64)>,
        simulated_s: f64,
        real_s: f64,
        ticks: Vec<Tick>,
    }

    impl World {
        fn new(robots: u64) -> Self {
            let robots = (1..=robots).map(|seed| (Pace::default(), seed * 7_919)).collect();
            Self { robots, simulated_s: 0.0, real_s: 0.0, ticks: Vec::new() }
        }

        /// `steps` steps, each of which takes this much real time.
        fn run(&mut self, steps: usize, real_step_s: f64, drives: bool) {
            for _ in 0..steps {
                self.simulated_s += STEP_S;
                self.real_s += real_step_s;
                let (simulated_s, real_s) = (self.simulated_s, self.real_s);
                self.ticks.clear();
                for (pace, seed) in &mut self.robots {
                    *seed =
                        seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    let late_s = (*seed >> 40) as f64 / (1_u64 << 24) as f64 * 0.004;
                    let passed = Duration::from_secs_f64(real_s + late_s);
                    self.ticks.push(pace.tick(simulated_s, passed, drives));
                }
            }
        }

        /// How far the robots' world clocks are apart, and how far the first is behind, seconds.
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
        // 0.25 s was where half of a fleet used to jump.
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

//! The robot set: real firmware cores in simulated bodies, each with its own clock.

mod mishaps;

use lightbots_base::{Instant, Pose, Rgb, RobotId, Span, Vec2};
use lightbots_robot::{Config, Fix, Inputs, Message};
use lightbots_show::Stage;
use lightbots_wire::{RobotState, Topic};

use crate::brakes::{BrakeCounts, Brakes};
use crate::conditions::Conditions;
use crate::dice::{Dice, Purpose};
use crate::error_statistics::ErrorStatistics;
use crate::firmware::{Ours, RobotFirmware};
use crate::fix_sensors::FixSensors;
use crate::message_log::MessageLog;
use crate::original::{Original, OriginalOutputs};
use crate::prefetch::prefetch;
use crate::proximity::ProximityReadings;
use crate::world::{STEP, World};

/// Each robot's own clock begins at a random value below this, microseconds: an hour, so that no two clocks agree.
const CLOCK_BEGIN_US: u64 = 3_600_000_000;
/// Number of steps in which a battery loses one percent: three minutes.
const STEPS_PER_PERCENT: u64 = 11_250;
/// Up to this number of robots, nothing is prefetched, because the cache still holds the robots from the step before.
/// Tuned on `--example speed`.
const CACHED: usize = 1_500;
/// A robot is prefetched this number of turns before its own. The first number is for its first cache line, which
/// tells whether it runs our firmware. The second number is for the state that a step reads. With fewer turns, memory
/// arrives too late. With more, it has left the cache.
const AHEAD: [usize; 2] = [5, 2];

/// All robots of a rehearsal or a fleet, and their world.
pub(crate) struct RobotSet {
    pub world: World,
    sensors: FixSensors,
    /// `[robot]`: constant error of the headings of its fixes, radians; empty if no marker is turned.
    markers_rad: Vec<f64>,
    robots: Vec<SimulatedRobot>,
    /// Up to this number of robots, no robot is prefetched.
    pub cached: usize,
    /// `[robot]`: whether the robot has power. The last entry is for a person's foot, which counts as without power.
    alive: Vec<bool>,
    steps: u64,
    errors: ErrorStatistics,
    brakes: Brakes,
    payload: Message,
    log: MessageLog,
}

/// A simulated robot. The order of its fields is fixed, so that its first cache line tells which firmware it runs.
#[repr(C, align(64))]
struct SimulatedRobot {
    id: RobotId,
    /// Whether its wheels are blocked.
    stuck: bool,
    /// Whether it gets no fixes.
    blind: bool,
    light: Rgb,
    battery: u8,
    clock: LocalClock,
    firmware: RobotFirmware,
}

/// The clock of one robot, which drifts against virtual time.
#[derive(Clone, Copy, Debug)]
struct LocalClock {
    /// What the clock read when virtual time began, microseconds, modulo 2⁶⁴.
    begin_us: u64,
    /// Drift against virtual time, parts per thousand million; positive: fast.
    drift_ppb: i64,
}

impl LocalClock {
    #[inline]
    fn own(self, now: Instant) -> Instant {
        let drift = (now.0 as i64).wrapping_mul(self.drift_ppb) / 1_000_000_000;
        Instant(now.0.wrapping_add(self.begin_us).wrapping_add_signed(drift))
    }

    /// Sets the clock to 0.
    fn restart(&mut self, now: Instant) {
        self.begin_us = self.begin_us.wrapping_sub(self.own(now).0);
    }
}

impl RobotSet {
    /// Robots at rest on a stage, just switched on and without a link. `names[robot]`: its name, if one is given.
    /// `says_simulated`: robots with our firmware add `sim=1` to their reports. Rehearsals leave it out, so that
    /// messages are as long as those of real robots.
    pub fn new(
        stage: &Stage,
        starts: &[Vec2],
        names: &[Option<RobotId>],
        conditions: &Conditions,
        seed: u64,
        says_simulated: bool,
    ) -> Self {
        // Facing away from the viewer, as the original's robots do.
        let poses: Vec<Pose> =
            starts.iter().map(|&start| Pose::new(start, core::f64::consts::FRAC_PI_2)).collect();
        let mut dice = Dice::new(seed, Purpose::Robots);
        let first_original = starts.len().saturating_sub(conditions.originals);
        let simulated = |robot| {
            let name = names.get(robot).copied().flatten();
            SimulatedRobot::new(stage, conditions, robot >= first_original, name, says_simulated, &mut dice)
        };
        let robots = (0..starts.len()).map(simulated).collect();
        let mut world = World::with_people(stage, &poses, conditions.has_people(), conditions.slip, seed);
        conditions.worn.iter().for_each(|&(robot, share)| world.wear(robot, share));
        let mut markers_rad = vec![0.0; if conditions.turned_markers.is_empty() { 0 } else { starts.len() }];
        for &(robot, turned_rad) in
            conditions.turned_markers.iter().filter(|(robot, _)| *robot < starts.len())
        {
            markers_rad[robot] = turned_rad;
        }
        Self {
            world,
            markers_rad,
            sensors: FixSensors::new(&conditions.fixes, &poses, seed),
            robots,
            cached: CACHED,
            alive: (0..=starts.len()).map(|disc| disc < starts.len()).collect(),
            steps: 0,
            errors: ErrorStatistics::default(),
            brakes: Brakes::new(starts.len(), ProximityReadings::sight_m(stage.limits.radius_m)),
            payload: Message::new(),
            log: MessageLog::default(),
        }
    }

    /// Number of robots.
    pub fn len(&self) -> usize {
        self.robots.len()
    }

    /// A robot's name.
    pub fn id(&self, robot: usize) -> RobotId {
        self.robots[robot].id
    }

    /// The colour of a robot's light.
    pub fn light(&self, robot: usize) -> Rgb {
        self.robots[robot].light
    }

    /// Brings a robot's link up, or breaks it. Does nothing if the robot has no power.
    pub fn link(&mut self, now: Instant, robot: usize, up: bool) {
        if self.alive[robot] {
            let simulated = &mut self.robots[robot];
            match &mut simulated.firmware {
                RobotFirmware::Ours(robot) => robot.link(simulated.clock.own(now), up),
                RobotFirmware::Original(robot) => robot.link(up),
            }
        }
    }

    /// Delivers a message to a robot. Does nothing if the robot has no power.
    pub fn receive(&mut self, now: Instant, robot: usize, topic: Topic, payload: &[u8]) {
        if self.alive[robot] {
            let simulated = &mut self.robots[robot];
            match &mut simulated.firmware {
                RobotFirmware::Ours(robot) => robot.receive(simulated.clock.own(now), topic, payload),
                RobotFirmware::Original(robot) => robot.receive(payload),
            }
        }
    }

    /// Prefetches the state of a robot that is about to receive a message, if there are more than `cached` robots.
    #[inline]
    pub fn prefetch_receiver(&self, robot: usize) {
        if self.robots.len() > self.cached {
            self.prefetch_state(robot);
        }
    }

    #[inline]
    fn prefetch_state(&self, robot: usize) {
        if let Some(SimulatedRobot { firmware: RobotFirmware::Ours(robot), .. }) = self.robots.get(robot) {
            prefetch(robot.hot());
        }
    }

    /// Prefetches two robots whose turns come: the first cache line of `later`, and the state of `soon`.
    #[inline]
    fn prefetch_next(&self, [later, soon]: [usize; 2]) {
        if let Some(simulated) = self.robots.get(later) {
            prefetch(&simulated.id);
        }
        self.prefetch_state(soon);
    }

    /// Passes the messages that a robot has to send to `receive`. Does nothing if the robot has no power.
    pub fn drain_messages(&mut self, robot: usize, receive: &mut impl FnMut(usize, Topic, &[u8])) {
        if self.alive[robot] {
            self.robots[robot].send_messages(robot, &mut self.payload, receive);
        }
    }

    /// Errors of estimated places, of tracking and between clocks.
    pub fn errors(&self) -> &ErrorStatistics {
        &self.errors
    }

    /// Numbers of braking episodes.
    pub fn brakes(&self) -> BrakeCounts {
        self.brakes.counts()
    }

    /// Samples the show clocks of all robots that have power and know the show clock.
    pub fn compare_clocks(&mut self, now: Instant) {
        let shown = self.robots.iter().zip(&self.alive).filter(|(_, alive)| **alive);
        self.errors.sample_clocks(shown.filter_map(|(simulated, _)| match &simulated.firmware {
            RobotFirmware::Ours(robot) => robot.show_time(simulated.clock.own(now)),
            RobotFirmware::Original(_) => None,
        }));
    }

    /// Makes a robot's power fail.
    pub fn kill(&mut self, robot: usize) {
        self.alive[robot] = false;
        self.robots[robot].light = Rgb::BLACK;
        self.world.command(robot, [0.0; 2]);
    }

    /// Blocks a robot's wheels.
    pub fn block_wheels(&mut self, robot: usize) {
        self.robots[robot].stuck = true;
        self.world.command(robot, [0.0; 2]);
    }

    /// Takes a robot's position fixes away, or gives them back.
    pub fn blind(&mut self, robot: usize, blind: bool) {
        self.robots[robot].blind = blind;
    }

    /// Makes one step of 16 ms that ends at `now`: all bodies move, then each robot's firmware takes its turn.
    ///
    /// With more than `cached` robots, turns are in ascending and descending order in alternate steps, if the sensors
    /// allow any order. The cache then still holds the last robots of the step before. `receive` gets the messages in
    /// ascending order of robots all the same.
    pub fn step(&mut self, now: Instant, receive: &mut impl FnMut(usize, Topic, &[u8])) {
        self.world.step();
        self.count_brakes();
        self.sensors.next_step(&self.alive);
        self.steps += 1;
        let count = self.robots.len();
        if count <= self.cached {
            (0..count).for_each(|index| self.turn(now, index, receive));
        } else if self.steps.is_multiple_of(2) && self.sensors.in_any_order() {
            let mut log = core::mem::take(&mut self.log);
            for index in (0..count).rev() {
                self.prefetch_next(AHEAD.map(|turns| index.wrapping_sub(turns)));
                self.turn(now, index, &mut |robot, topic, text| log.push(robot, topic, text));
            }
            log.drain(receive);
            self.log = log;
        } else {
            for index in 0..count {
                self.prefetch_next(AHEAD.map(|turns| index + turns));
                self.turn(now, index, receive);
            }
        }
    }

    /// Classifies the braking episodes that began in the step before.
    #[inline]
    fn count_brakes(&mut self) {
        let Self { world, robots, alive, brakes, .. } = self;
        let places = world.places();
        brakes.classify(places, |robot, off_m| !alive[robot] || robots[robot].is_amiss(places[robot], off_m));
    }

    /// One robot's turn within a step: its firmware gets sensor readings, commands wheels and light, and sends
    /// messages.
    #[inline]
    fn turn(&mut self, now: Instant, index: usize, receive: &mut impl FnMut(usize, Topic, &[u8])) {
        let Self { world, sensors, markers_rad, robots, alive, errors, brakes, payload, steps, .. } = self;
        if !alive[index] {
            return;
        }
        let (simulated, steps) = (&mut robots[index], *steps);
        let fix = sensors.fix(index, world.pose(index)).filter(|_| !simulated.blind);
        let fix = match markers_rad.get(index) {
            Some(turned_rad) => fix.map(|fix| Pose::new(fix.at, fix.heading + turned_rad)),
            None => fix,
        };
        let robot = match &mut simulated.firmware {
            RobotFirmware::Ours(robot) => robot,
            RobotFirmware::Original(robot) => {
                let OriginalOutputs { wheels_radps, light } = robot.step(fix);
                simulated.light = light;
                world.command(index, if simulated.stuck { [0.0; 2] } else { wheels_radps });
                simulated.send_messages(index, payload, receive);
                return;
            }
        };
        errors.sample_tracking(steps, index, robot, world);
        let drained = (steps / STEPS_PER_PERCENT).min(100) as u8;
        let inputs = Inputs {
            wheel_turns_rad: world.wheel_turns(index),
            fix: fix.map(|fix| Fix { at: fix.at, heading: Some(fix.heading) }),
            battery: Some(simulated.battery.saturating_sub(drained)),
            proximity_m: Some(world.proximity_m(index)),
            lag: Span::ZERO,
        };
        let outputs = robot.step(simulated.clock.own(now), &inputs);
        errors.sample_estimate(steps, index, robot, world);
        if let Some(towards) = robot.braking_towards() {
            brakes.note(steps, index, Vec2::unit(world.pose(index).heading + towards));
        }
        simulated.light = outputs.light;
        world.command(index, if simulated.stuck { [0.0; 2] } else { outputs.wheels_radps });
        simulated.send_messages(index, payload, receive);
    }
}

impl SimulatedRobot {
    fn new(
        stage: &Stage,
        conditions: &Conditions,
        original: bool,
        name: Option<RobotId>,
        says_simulated: bool,
        dice: &mut Dice,
    ) -> Self {
        let random = RobotId::from_random(u128::from(dice.bits()) << 64 | u128::from(dice.bits()));
        let id = name.unwrap_or(random);
        let ppm = dice.between(-conditions.clock_ppm, conditions.clock_ppm);
        let clock = LocalClock { begin_us: dice.below(CLOCK_BEGIN_US), drift_ppb: (ppm * 1000.0) as i64 };
        let delay_steps = (conditions.fixes.delay.0.max(0) + STEP.0 / 2) / STEP.0;
        let config = Config {
            limits: stage.limits,
            fix_delay: STEP * delay_steps,
            fix_pace: STEP * i64::from(conditions.fixes.every.max(1)),
            seed: dice.bits() as u32,
            // As the builder of a robot would configure them: the true noise, but never zero.
            fix_sigma_m: conditions.fixes.place_sigma_m.max(0.0005),
            heading_sigma_rad: conditions.fixes.heading_sigma_rad.max(0.002),
            simulated: says_simulated,
            ..Config::new(id)
        };
        let battery = 80 + dice.below(21) as u8;
        let firmware = if original {
            RobotFirmware::Original(Original::new(id))
        } else {
            RobotFirmware::Ours(Ours::with_storage(config, Box::default()))
        };
        Self { firmware, id, clock, battery, light: Rgb::BLACK, stuck: false, blind: false }
    }

    /// Whether this robot is faulty or farther than `off_m` from its route; `place`: its true place. A mute robot
    /// drives on its route, so it is not faulty here. An original robot has no route.
    fn is_amiss(&self, place: Vec2, off_m: f64) -> bool {
        let RobotFirmware::Ours(robot) = &self.firmware else { return self.stuck || self.blind };
        let is_off = robot.route_place().is_some_and(|due| due.distance(place) > off_m);
        let failed = matches!(robot.state(), RobotState::Faulty | RobotState::Cut | RobotState::Lost);
        self.stuck || self.blind || failed || is_off
    }

    #[inline]
    fn send_messages(
        &mut self,
        index: usize,
        payload: &mut Message,
        receive: &mut impl FnMut(usize, Topic, &[u8]),
    ) {
        while let Some(topic) = self.firmware.outgoing(payload) {
            receive(index, topic, payload.as_bytes());
        }
    }
}

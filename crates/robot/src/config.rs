//! Configuration of a robot at power-on, and inputs and outputs of a step.

use lightbots_base::{Limits, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Firmware};

/// Configuration of a robot, fixed at power-on.
#[derive(Clone, Debug)]
pub struct Config {
    /// The robot's name.
    pub id: RobotId,
    /// Name and version it reports.
    pub firmware: Firmware,
    /// Seed for the phase of the robot's periodic messages. Different seeds spread the messages of a fleet over time.
    pub seed: u32,
    /// Age of a position fix when the robot receives it; 0 to 0.45 s.
    pub fix_delay: Span,
    /// Noise of a position fix in each coordinate, 1 sigma, metres.
    pub fix_sigma_m: f64,
    /// Noise of a heading fix, 1 sigma, radians.
    pub heading_sigma_rad: f64,
    /// Expected wheel slip, 1 sigma: the share of the wheels' turning that does not move the robot. The filter
    /// estimates the actual slip.
    pub slip: f64,
    /// How long the robot drives on without a link. On a route, the robot brakes and is `cut` once it has received no
    /// message, or the link has been down, for longer. On a drive to a target, only a link that is down for longer has
    /// this effect. The robot stands at most 0.3 s later.
    pub silence: Span,
    /// Time between position fixes.
    pub fix_pace: Span,
    /// Abilities beyond the original protocol. Without any, the robot behaves and reports like an original robot.
    pub abilities: Abilities,
    /// Dimensions and limits of the robot: radius, wheels, speed, acceleration.
    pub limits: Limits,
    /// Whether the robot's reports say that it is simulated; `false` for a real robot.
    pub simulated: bool,
    /// Its proximity sensors.
    pub proximity: ProximitySensors,
    /// Assumptions of its estimator of neighbours.
    pub neighbours: NeighbourModel,
    /// Parameters of its safety layer.
    pub policy: SafetyPolicy,
}

/// Number of proximity sensors of a robot that has any.
pub const SENSORS: usize = 8;

/// Parameters of a robot's proximity sensors. Each sensor sits on the robot's rim. It reads the distance to the nearest
/// object in its cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProximitySensors {
    /// Directions in which the sensors look, radians counter-clockwise from the robot's front, in order around the
    /// robot.
    pub bearings_rad: [f32; SENSORS],
    /// Half the opening angle of each sensor's cone, radians.
    pub half_cone_rad: f32,
    /// Largest gap that counts as a reading, metres. At a larger gap, the sensor counts as seeing nothing.
    pub range_m: f32,
    /// Constant part of the noise of a reading, 1 sigma, metres.
    pub noise_m: f32,
    /// Part of a reading's noise that grows with the gap, 1 sigma, as a share of the gap. It is added to `noise_m`.
    pub noise_share: f32,
}

impl ProximitySensors {
    /// The sensors of an Elisa-3: eight, 45° apart. Their noise was measured in Webots R2023b on 2026-11-21: 0.5 mm at
    /// a gap of 5 mm, 0.8 mm at 10 mm.
    pub const ELISA_3: Self = Self {
        bearings_rad: {
            /// Angle between two adjacent sensors, radians.
            const STEP: f32 = core::f32::consts::FRAC_PI_4;
            [0.0, STEP, 2.0 * STEP, 3.0 * STEP, 4.0 * STEP, 5.0 * STEP, 6.0 * STEP, 7.0 * STEP]
        },
        half_cone_rad: 0.872_664_6,
        range_m: 0.03,
        noise_m: 0.0003,
        noise_share: 0.05,
    };
}

/// Parameters of the safety layer's decisions; docs/reflex.md says what breaks above and below each value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafetyPolicy {
    /// Part of the safety margin that grows with uncertainty: multiple of the standard deviation of the neighbour's
    /// place at the nearest approach. `spare_m` is added to it.
    pub sigmas: f32,
    /// Constant part of the safety margin on the gap between the rims at the nearest approach, metres. It is added to
    /// the part by `sigmas`.
    pub spare_m: f32,
    /// Upper bound of the safety margin for a moving neighbour with a known planned clearance, as a share of that
    /// clearance. One standard deviation of the neighbour's place is subtracted from the bound, but the bound is never
    /// negative. For a neighbour that stands by plan there is no such bound.
    pub planned_share: f32,
    /// How much nearer a neighbour may come before the robot brakes for it, metres. This applies to a neighbour that is
    /// already too near and has a known planned clearance.
    pub tolerance_m: f32,
    /// A robot counts as blocked after this number of steps in which it wanted to drive and less than half the wanted
    /// speed was allowed. A step without a speed limit lowers the count by one.
    pub steps_to_block: u8,
    /// Number of steps in a row in which the blocking obstacle must be missing before the robot is free again.
    pub steps_to_free: u8,
    /// Two bounds on a gap, metres. The blocking obstacle counts as missing once the gap to it has grown by more than
    /// this. The growth is counted from the gap at which the robot stopped or last backed away. A blocked robot backs
    /// away only while the gap itself is at most this.
    pub clear_m: f32,
    /// Speed at which a blocked robot backs away, m/s.
    pub retreat_mps: f32,
    /// Gap below which a neighbour behind the robot ends the backing away of a blocked robot, metres.
    pub followed_m: f32,
    /// Largest distance by which the robot backs away, or leaves its route to give way to one neighbour, metres.
    pub evade_most_m: f32,
    /// Distance by which the robot gives way to a neighbour that is too near, as a share of the missing clearance. At
    /// gaps of a few millimetres, the robot gives way farther.
    pub give_way_share: f32,
}

impl SafetyPolicy {
    /// Tuned in rehearsals of formations, of random pairs and of robots that stop dead, 2026-11-23 and 2026-11-24.
    pub const DEFAULT: Self = Self {
        sigmas: 2.0,
        spare_m: 0.001,
        planned_share: 0.5,
        tolerance_m: 0.0005,
        steps_to_block: 5,
        steps_to_free: 8,
        clear_m: 0.004,
        retreat_mps: 0.03,
        followed_m: 0.014,
        evade_most_m: 0.008,
        give_way_share: 0.7,
    };
}

/// Assumptions of the neighbour estimator about motion and about deviations from the plan. docs/reflex.md says what
/// breaks above and below each value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeighbourModel {
    /// Deviation of neighbours from their planned places, 1 sigma in each axis, metres. The estimator adds the errors
    /// of both robots' place estimates.
    pub planned_sigma_m: f32,
    /// Deviation of neighbours from their planned velocities, 1 sigma in each axis, m/s.
    pub planned_sigma_mps: f32,
    /// Rate at which a neighbour's deviation from its planned place decays, 1/s: the inverse of the correlation time.
    pub offset_share: f32,
    /// Acceleration of planned neighbours that deviates from the plan, 1 sigma in each axis, m/s².
    pub accel_sigma_mps2: f32,
    /// Unknown acceleration of neighbours that the plan does not know, 1 sigma in each axis, m/s².
    pub unplanned_accel_mps2: f32,
    /// Assumed velocity of an unplanned neighbour before it is measured (mean 0), 1 sigma in each axis, m/s.
    pub unknown_sigma_mps: f32,
    /// Error of the robot's own odometry, 1 sigma, as a share of the measured distance and of the measured rotation.
    pub odometry_share: f32,
    /// A planned neighbour counts as stopped above this natural logarithm of the likelihood ratio of "stopped" to
    /// "drives by plan".
    pub stop_log_ratio: f32,
    /// Bound on the offset of a neighbour's readings from its plan, smoothed over steps: a multiple of the standard
    /// deviation of planned places. Above it, the neighbour counts as having left its plan.
    pub stray_sigmas: f32,
    /// Error of the place of a neighbour that was found to have stopped, 1 sigma across the line of sight, metres.
    pub stop_sigma_m: f32,
    /// Error of the velocity of a neighbour that was found to have stopped, 1 sigma, m/s.
    pub stop_sigma_mps: f32,
    /// Process noise of the place of a standing object, 1 sigma per step, metres.
    pub standing_sigma_m: f32,
    /// Process noise of the direction of an edge, 1 sigma per step, radians.
    pub standing_sigma_rad: f32,
    /// Error of the velocity of a standing object, 1 sigma in each axis, m/s. The velocity itself is taken as 0.
    pub standing_sigma_mps: f32,
    /// Readings begin to count as those of a standing object above this natural logarithm of the likelihood ratio of
    /// "standing object" to "moving neighbours". They count so until the logarithm is 0 or less.
    pub standing_log_ratio: f32,
    /// Share of a standing object's log-likelihood that is kept from step to step; older readings thus count less.
    pub standing_remembered: f32,
    /// Probability that a sensor does not see a standing object in its cone.
    pub unseen_share: f32,
    /// Prior for each tried place and direction of an edge's end, when an object comes into sight. It is the natural
    /// logarithm of this end's likelihood over that of an endless edge.
    pub end_log_prior: f32,
    /// Prior for each tried place of a standing robot, when an object comes into sight. It is the natural logarithm of
    /// this place's likelihood over that of an endless edge.
    pub disc_log_prior: f32,
    /// Prior for an end of an edge that may lie where the sensors stop seeing the edge. It is the natural logarithm of
    /// this end's likelihood over that of an endless edge.
    pub new_end_log_prior: f32,
    /// Hypotheses of the same kind about a standing object are merged if their distances from the robot differ by less
    /// than this, metres. Their ends or centres must then differ by less than twice this, and their directions little.
    pub alike_m: f32,
}

impl NeighbourModel {
    /// `planned_sigma_m` and `offset_share` were measured in rehearsals with standard conditions on 2026-11-24.
    /// `accel_sigma_mps2` was chosen so that the covariances of planned neighbours match their errors
    /// (reflex/planned_scene_tests.rs). The parameters of standing objects were chosen in the same way for walls
    /// (reflex/wall_scene_tests.rs, 2026-11-24). The others were tuned on formations, random pairs and robots that stop
    /// dead, 2026-11-23 and 2026-11-24.
    pub const DEFAULT: Self = Self {
        planned_sigma_m: 0.0006,
        planned_sigma_mps: 0.015,
        offset_share: 3.5,
        accel_sigma_mps2: 0.6,
        unplanned_accel_mps2: 2.5,
        unknown_sigma_mps: 0.135,
        odometry_share: 0.04,
        stop_log_ratio: 10.5,
        stray_sigmas: 5.5,
        stop_sigma_m: 0.003,
        stop_sigma_mps: 0.04,
        standing_sigma_m: 0.00025,
        standing_sigma_rad: 0.002,
        standing_sigma_mps: 0.002,
        standing_log_ratio: 1.0,
        standing_remembered: 0.85,
        unseen_share: 0.2,
        end_log_prior: -0.9,
        disc_log_prior: -2.5,
        new_end_log_prior: -2.0,
        alike_m: 0.001,
    };
}

impl Config {
    /// The configuration of an Elisa-3 with all abilities. Fixes come at every step, without delay, with noise of 2 mm
    /// and 1°. The robot drives on without a link for at most 1.9 s.
    pub fn new(id: RobotId) -> Self {
        Self {
            id,
            simulated: false,
            proximity: ProximitySensors::ELISA_3,
            neighbours: NeighbourModel::DEFAULT,
            policy: SafetyPolicy::DEFAULT,
            limits: Limits::ELISA_3,
            firmware: Firmware::try_from(concat!("lightbots-", env!("CARGO_PKG_VERSION")))
                .unwrap_or_default(),
            fix_delay: Span::ZERO,
            fix_pace: Span::from_millis(16),
            silence: Span::from_millis(1900),
            seed: 0,
            fix_sigma_m: 0.002,
            heading_sigma_rad: 0.0175,
            slip: 0.08,
            abilities: Abilities::ALL,
        }
    }
}

/// Readings of the sensors at a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {
    /// Angles by which the left and the right wheel turned since the step before, radians; forwards is positive.
    pub wheel_turns_rad: [f64; 2],
    /// A position fix that was received since the step before; `None` if there was none.
    pub fix: Option<Fix>,
    /// Charge of the battery, percent; `None` without a reading.
    pub battery: Option<u8>,
    /// How far the time of the world in which the wheels turn lags behind the robot's own clock; negative if it runs
    /// ahead. It is zero on a real robot, and positive in a simulation that is slower than real time. Routes go by the
    /// time of that world, so that all robots of one simulation are at the same path time. The show clock, the link and
    /// the light go by the own clock.
    pub lag: Span,
    /// Gap that each proximity sensor reads between the robot's rim and the nearest object, metres, in the order of
    /// [`ProximitySensors::bearings_rad`]. Infinite if nothing is in sight; `None` if the robot has no sensors.
    pub proximity_m: Option<[f32; SENSORS]>,
}

/// Where a positioning system saw the robot. The robot receives the fix [`Config::fix_delay`] later.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fix {
    /// The place, stage metres; NaN if the system did not see the robot.
    pub at: Vec2,
    /// The heading, radians counter-clockwise from stage x. `None` or NaN if neither the system nor a compass measures
    /// it.
    pub heading: Option<f64>,
}

/// What the motors and the light are to do until the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {
    /// Rates of the left and the right wheel, rad/s, forwards positive.
    pub wheels_radps: [f64; 2],
    /// Colour of the light.
    pub light: Rgb,
}

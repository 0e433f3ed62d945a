//! Configuration at power-on, and inputs and outputs of a step.

use lightbots_base::{Limits, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Firmware};

/// Configuration of a robot, fixed at power-on.
#[derive(Clone, Debug)]
pub struct Config {
    /// The robot's name.
    pub id: RobotId,
    /// Name and version it reports.
    pub firmware: Firmware,
    /// Spreads the periodic messages of a fleet over time.
    pub seed: u32,
    /// How old a position fix is when it comes in; 0 to 0.45 s.
    pub fix_delay: Span,
    /// Noise of a position fix in each coordinate, 1 sigma, metres.
    pub fix_sigma_m: f64,
    /// Noise of a heading fix, 1 sigma, radians.
    pub heading_sigma_rad: f64,
    /// Share of their turning that the wheels lose, 1 sigma. The filter estimates the actual share.
    pub slip: f64,
    /// Patience with the link. The robot brakes and is cut off when the controller is silent for longer during a route.
    /// The same happens when the link is down for longer during any drive. It stands 0.3 s later at the latest.
    pub silence: Span,
    /// Time between position fixes.
    pub fix_pace: Span,
    /// Abilities beyond the original protocol. Without any, it behaves and reports like an original robot.
    pub abilities: Abilities,
    /// Measures of its body.
    pub limits: Limits,
    /// Whether its reports say that it is simulated. Firmware of real robots never sets this.
    pub simulated: bool,
    /// Its proximity sensors.
    pub proximity: ProximitySensors,
    /// Assumptions of its estimator of neighbours.
    pub neighbours: NeighbourModel,
    /// Parameters of its safety layer.
    pub policy: SafetyPolicy,
}

/// How many proximity sensors a robot can have.
pub const SENSORS: usize = 8;

/// What the proximity sensors of a robot are. Each sits on the rim and reads the distance to the nearest point of any
/// rim in its cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProximitySensors {
    /// Directions in which they look, radians counter-clockwise from the front; those next to each other look next to
    /// each other.
    pub bearings_rad: [f32; SENSORS],
    /// Half the angle of their cones, radians.
    pub half_cone_rad: f32,
    /// Farthest gap of interest, metres. What is farther away cannot be reached within the stopping distance.
    pub range_m: f32,
    /// Noise of a reading, 1 sigma: metres, and share of the gap.
    pub noise_m: f32,
    /// See `noise_m`.
    pub noise_share: f32,
}

impl ProximitySensors {
    /// Those of an Elisa-3: eight, 45° apart. Noise as measured in Webots R2023b on 2026-11-21: 0.5 mm at 5 mm, 0.8
    /// mm at 10 mm.
    pub const ELISA_3: Self = Self {
        bearings_rad: {
            const STEP: f32 = core::f32::consts::FRAC_PI_4;
            [0.0, STEP, 2.0 * STEP, 3.0 * STEP, 4.0 * STEP, 5.0 * STEP, 6.0 * STEP, 7.0 * STEP]
        },
        half_cone_rad: 0.872_664_6,
        range_m: 0.03,
        noise_m: 0.0003,
        noise_share: 0.05,
    };
}

/// How the safety layer decides; docs/reflex.md says what breaks above and below each value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafetyPolicy {
    /// Growth of the swept discs, in sigma of the neighbour's place when they are nearest.
    pub sigmas: f32,
    /// What is left between rims when the robot stands, metres.
    pub spare_m: f32,
    /// Share of the planned clearance that the growth takes at most.
    pub planned_share: f32,
    /// How much nearer than it is already a planned neighbour may come before the robot brakes for it, metres.
    pub tolerance_m: f32,
    /// Steps in a row in which a robot wants to drive and must not before it counts as blocked.
    pub steps_to_block: u8,
    /// It is free again when what blocked it was missing from its place for this many steps.
    pub steps_to_free: u8,
    /// What blocked it is missing when it is this much farther away, metres. A blocked robot backs away until there
    /// is this much room, …
    pub clear_m: f32,
    /// … this fast, m/s, …
    pub retreat_mps: f32,
    /// … unless a neighbour is this near behind it, metres.
    pub followed_m: f32,
    /// How far it leaves its route at most, backing away or giving way to a neighbour, metres.
    pub evade_most_m: f32,
    /// Share of missing clearance that it gives way by.
    pub give_way_share: f32,
}

impl SafetyPolicy {
    /// Tuned in rehearsals of formations, random pairs and deaths, 2026-11-23 and 2026-11-24.
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

/// What the estimator of neighbours assumes of their motion and of the plan's errors; docs/reflex.md says what breaks
/// above and below each value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeighbourModel {
    /// How far neighbours are off their plan beside what they and this robot mistake their places by, 1 sigma in each
    /// axis: metres.
    pub planned_sigma_m: f32,
    /// The same for velocity, m/s.
    pub planned_sigma_mps: f32,
    /// Share of its offset from the plan that a neighbour makes good in a second: the inverse of the correlation
    /// time, 1/s.
    pub offset_share: f32,
    /// Unforeseen acceleration of planned neighbours, 1 sigma in each axis, m/s².
    pub accel_sigma_mps2: f32,
    /// The same of neighbours that the plan does not know, m/s².
    pub unplanned_accel_mps2: f32,
    /// Velocity of a neighbour of which nothing is known, 1 sigma in each axis, m/s.
    pub unknown_sigma_mps: f32,
    /// Error of the distance that the own wheels drive, 1 sigma, as a share of it.
    pub odometry_share: f32,
    /// A planned neighbour has stopped when its readings are more likely by this factor than those of one that drives
    /// by plan, natural logarithm.
    pub stop_log_ratio: f32,
    /// It has left its plan when its readings are off it by this many sigma.
    pub stray_sigmas: f32,
    /// Error of the place at which a neighbour was found to stand, 1 sigma across the line of sight, metres.
    pub stop_sigma_m: f32,
    /// The same of its velocity, m/s.
    pub stop_sigma_mps: f32,
    /// How much the place of what stands changes in a step, 1 sigma: metres, …
    pub standing_sigma_m: f32,
    /// … and the direction of an edge, radians.
    pub standing_sigma_rad: f32,
    /// Velocity of what stands, 1 sigma in each axis, m/s.
    pub standing_sigma_mps: f32,
    /// Something stands when its readings are more likely by this factor than those of neighbours that move, natural
    /// logarithm.
    pub standing_log_ratio: f32,
    /// Share of the logarithm of a likelihood that remains after a step, of what stands.
    pub standing_remembered: f32,
    /// Probability that a sensor does not see what stands in its cone.
    pub unseen_share: f32,
    /// Likelihood of an end at one of the places tried, over that of an edge without end, when something comes into
    /// sight, natural logarithm.
    pub end_log_prior: f32,
    /// The same of a robot that stands.
    pub disc_log_prior: f32,
    /// Likelihood that an edge that was seen ends where it is not seen any more, natural logarithm.
    pub new_end_log_prior: f32,
    /// Hypotheses whose places differ by less than this are one, metres.
    pub alike_m: f32,
}

impl NeighbourModel {
    /// `planned_sigma_m` and `offset_share` were measured in rehearsals with standard conditions on 2026-11-24.
    /// `accel_sigma_mps2` makes the covariances of planned neighbours honest (reflex/planned_scene_tests.rs), those of
    /// what stands the covariances of walls (reflex/wall_scene_tests.rs, 2026-11-24). The others were tuned on
    /// formations, random pairs and deaths, 2026-11-23 and 2026-11-24.
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
    /// An Elisa-3 with all abilities, fixes at every step, without delay and with 2 mm and 1° of noise, and 2 s of
    /// patience with the link.
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
    /// Turns of the left and the right wheel since the step before, radians, forwards positive.
    pub wheel_turns_rad: [f64; 2],
    /// A position fix, where one came in since the step before.
    pub fix: Option<Fix>,
    /// Charge of the battery, percent.
    pub battery: Option<u8>,
    /// Lag of the wheels' world behind the own clock; negative: it runs ahead. Zero on a board. A simulation that is
    /// slower than real time lags. Routes go by the world's time, so that all robots of one simulation are at the same
    /// path time. The show clock, the link and the light go by the own clock.
    pub lag: Span,
    /// Gaps between its rim and what is nearest, metres, as eight proximity sensors 45° apart see them,
    /// counter-clockwise from the front; infinite where nothing is in sight. `None`: it has none.
    pub proximity_m: Option<[f32; SENSORS]>,
}

/// Where a positioning system saw the robot [`Config::fix_delay`] ago.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fix {
    /// The place, stage metres; NaN: the system did not see the robot.
    pub at: Vec2,
    /// The heading, radians in the stage, where the system or a compass measures it; NaN counts as `None`.
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

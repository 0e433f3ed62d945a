//! What a robot is given: once at power-on, and at every step.

use lightbots_base::{Limits, Rgb, RobotId, Span, Vec2};
use lightbots_wire::{Abilities, Firmware};

/// What a robot is and has, fixed at power-on.
#[derive(Clone, Debug)]
#[repr(C)] // See `Robot`.
pub struct Config {
    /// Its name.
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
    /// What share of their turning its wheels lose at most, usually: it learns the rest.
    pub slip: f64,
    /// With nothing heard for so long while it drives a route, or with the link down for so long while it drives at
    /// all, it stops and is cut off.
    pub silence: Span,
    /// How often position fixes come.
    pub fix_pace: Span,
    /// What it can do beyond the original protocol. With none of it, it behaves and reports like an original robot.
    pub abilities: Abilities,
    /// Its body.
    pub limits: Limits,
    /// Whether it says in its reports that it is simulated. Firmware of real robots never sets this.
    pub simulated: bool,
}

impl Config {
    /// An Elisa-3 with all abilities, fixes at every step, without delay and with 2 mm and 1° of noise, and 2 s of
    /// patience with the link.
    pub fn new(id: RobotId) -> Self {
        Self {
            id,
            simulated: false,
            limits: Limits::ELISA_3,
            firmware: Firmware::try_from(concat!("lightbots-", env!("CARGO_PKG_VERSION")))
                .unwrap_or_default(),
            fix_delay: Span::ZERO,
            fix_pace: Span::from_millis(16),
            silence: Span::from_millis(2000),
            seed: 0,
            fix_sigma_m: 0.002,
            heading_sigma_rad: 0.0175,
            slip: 0.08,
            abilities: Abilities { route: true, fade: true, blink: true, room: true },
        }
    }
}

/// What the sensors say at a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Inputs {
    /// How far the left and the right wheel have turned since the step before, radians, forwards positive.
    pub wheel_turns_rad: [f64; 2],
    /// A position fix, where one came in since the step before.
    pub fix: Option<Fix>,
    /// Charge of the battery, percent.
    pub battery: Option<u8>,
    /// How far the world that its wheels are in lags behind its own clock; negative: runs ahead. Zero on a board. A
    /// simulation that is slower than real time lags: routes go by the world's time then, so that the robots of one
    /// simulation are at the same path time; the show clock, the link and the light go by the own clock.
    pub lag: Span,
    /// Gaps between its rim and what is nearest, metres, as eight proximity sensors 45° apart see them,
    /// counter-clockwise from the front; infinite where nothing is in sight. `None`: it has none.
    pub proximity_m: Option<[f32; 8]>,
}

/// Where a positioning system saw the robot [`Config::fix_delay`] ago.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fix {
    /// Its place, stage metres; NaN: the system did not see it.
    pub at: Vec2,
    /// Its heading, radians in the stage, where the system or a compass tells; NaN counts as `None`.
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

//! Conditions of a rehearsal: faults of robots, sensors and networks.

use lightbots_base::Span;
use lightbots_lighting::Tolerance;

use crate::mishap::Mishap;

/// All conditions of a rehearsal. The default is the standard conditions.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Mean share of a wheel's turning that does not move the body; 0 to 0.5.
    pub slip: f64,
    /// Largest drift of the robots' clocks, parts per million.
    pub clock_ppm: f64,
    /// Position fixes.
    pub fixes: FixConditions,
    /// The network between the controller and each robot.
    pub link: LinkConditions,
    /// Number of original robots, which understand only `TARGET` and `COLOR`. They are the last in starting order.
    pub originals: usize,
    /// Robots whose power fails: they stand and send nothing.
    pub killed: Vec<Breakdown>,
    /// Robots whose messages are lost. They still receive and drive.
    pub muted: Vec<Breakdown>,
    /// Robots whose wheels stop turning. They still receive and send.
    pub stuck: Vec<Breakdown>,
    /// Robots with a bent or worn left wheel, and the share of its turning that moves the body.
    pub worn: Vec<(usize, f64)>,
    /// Robots whose markers are turned on them, and the error of the headings of their fixes, radians.
    pub turned_markers: Vec<(usize, f64)>,
    /// Robots whose link breaks, and for how long.
    pub cut: Vec<(Breakdown, Span)>,
    /// Robots that get no fixes, and for how long.
    pub blind: Vec<(Breakdown, Span)>,
    /// Times at which the broker passes nothing on. Connections stay, and messages wait.
    pub frozen: Vec<Outage>,
    /// Times at which the broker is gone and all connections are broken.
    pub gone: Vec<Outage>,
    /// Times without a controller: it is killed, and another one then continues its run.
    pub crashed: Vec<Outage>,
    /// Mishaps, by their times after the first departure.
    pub mishaps: Vec<(Span, Mishap)>,
    /// Frames, counted from 0, that the operator sends robots to. Each time robots have reached a frame, the operator
    /// chooses the next of these.
    pub visits: Vec<usize>,
    /// How long the operator lets a frame wait for GO.
    pub go_after: Span,
    /// Largest difference between robots' lights and the colours of layers.
    pub light_tolerance: Tolerance,
    /// How many rounds of a loop are played before the operator gives GO.
    pub loop_rounds: u32,
}

/// Properties of position fixes.
#[derive(Clone, Debug, PartialEq)]
pub struct FixConditions {
    /// Noise of each coordinate, metres (1 sigma).
    pub place_sigma_m: f64,
    /// Noise of the heading, radians (1 sigma).
    pub heading_sigma_rad: f64,
    /// Largest constant error of a robot's place, metres.
    pub bias_m: f64,
    /// Steps of 16 ms from one fix to the next; at least 1.
    pub every: u32,
    /// Age of a fix when the robot gets it; at most 1 s.
    pub delay: Span,
    /// Duration of a drop-out of fixes, about every 20 s for each robot; zero: no drop-outs.
    pub dropout: Span,
    /// Probability that a fix is an outlier, off by up to 1 m along each axis.
    pub outliers: f64,
}

/// Properties of a link, in each direction.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkConditions {
    /// Least delay of a message.
    pub delay_min: Span,
    /// Largest delay of a message without jitter.
    pub delay_max: Span,
    /// Largest additional delay, which one message in ten has. It holds up the messages behind that one.
    pub jitter: Span,
    /// Probability that a message is lost.
    pub loss: f64,
    /// Probability that a message is duplicated.
    pub double: f64,
    /// Probability that later messages may overtake a message. All others keep their order, as with TCP.
    pub reorder: f64,
}

/// A breakdown of one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Breakdown {
    /// Index of the robot in starting order; `None`: random.
    pub robot: Option<usize>,
    /// Time after the first departure; `None`: random, while the show plays.
    pub at: Option<Span>,
}

/// A time without a working broker, or without a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outage {
    /// When it begins, after the first departure.
    pub at: Span,
    /// How long it lasts.
    pub over: Span,
}

impl Conditions {
    /// Largest valid slip.
    pub const SLIP_MAX: f64 = 0.5;
    /// Largest valid delay of a message.
    pub const DELAY_MAX: Span = Span::from_millis(5_000);
    /// Largest valid age of a fix.
    pub const FIX_DELAY_MAX: Span = Span::from_millis(1_000);

    /// Whether a person comes onto the floor.
    pub(crate) fn has_people(&self) -> bool {
        self.mishaps.iter().any(|(_, mishap)| matches!(mishap, Mishap::Person(_)))
    }

    /// Ideal conditions: no noise, slip, delay or loss, and clocks without drift.
    pub fn ideal() -> Self {
        let fixes = FixConditions { place_sigma_m: 0.0, heading_sigma_rad: 0.0, ..FixConditions::default() };
        let link =
            LinkConditions { delay_min: Span::ZERO, delay_max: Span::ZERO, ..LinkConditions::default() };
        Self { slip: 0.0, clock_ppm: 0.0, fixes, link, ..Self::default() }
    }
}

impl Default for Conditions {
    fn default() -> Self {
        Self {
            slip: 0.03,
            clock_ppm: 20.0,
            fixes: FixConditions::default(),
            link: LinkConditions::default(),
            originals: 0,
            killed: Vec::new(),
            muted: Vec::new(),
            stuck: Vec::new(),
            worn: Vec::new(),
            turned_markers: Vec::new(),
            cut: Vec::new(),
            blind: Vec::new(),
            frozen: Vec::new(),
            gone: Vec::new(),
            crashed: Vec::new(),
            mishaps: Vec::new(),
            visits: Vec::new(),
            go_after: Span::ZERO,
            light_tolerance: Tolerance::SIDE_BY_SIDE,
            loop_rounds: 1,
        }
    }
}

impl Default for FixConditions {
    fn default() -> Self {
        Self {
            place_sigma_m: 0.002,
            heading_sigma_rad: core::f64::consts::PI / 180.0,
            bias_m: 0.0,
            every: 1,
            delay: Span::ZERO,
            dropout: Span::ZERO,
            outliers: 0.0,
        }
    }
}

impl Default for LinkConditions {
    fn default() -> Self {
        Self {
            delay_min: Span::from_millis(5),
            delay_max: Span::from_millis(20),
            jitter: Span::ZERO,
            loss: 0.0,
            double: 0.0,
            reorder: 0.0,
        }
    }
}

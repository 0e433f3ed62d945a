//! Conditions of a rehearsal: faults of robots, sensors and networks.

use lightbots_base::Span;
use lightbots_lighting::Tolerance;

use crate::mishap::Mishap;

/// All conditions of a rehearsal. The default is the standard conditions.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Mean share of a wheel's turning that does not move the body, 0 to 0.5.
    pub slip: f64,
    /// Largest drift of the robots' clocks, parts per million.
    pub clock_ppm: f64,
    /// Position fixes.
    pub fixes: FixConditions,
    /// The network between the controller and each robot.
    pub link: LinkConditions,
    /// Number of original robots, which understand only `TARGET`, `COLOR` and `UUID`. They are the last in starting
    /// order.
    pub originals: usize,
    /// Robots whose power fails: they stand and send nothing.
    pub killed: Vec<Breakdown>,
    /// Robots whose messages are lost. They still receive and drive.
    pub muted: Vec<Breakdown>,
    /// Robots whose wheels stop turning. They still receive and send.
    pub stuck: Vec<Breakdown>,
    /// Robots with a worn left wheel: index of the robot, and the share of that wheel's turning that moves the body.
    pub worn: Vec<(usize, f64)>,
    /// Robots whose tracking marker is mounted at a wrong angle: index of the robot, and the constant error of its
    /// heading fixes, radians.
    pub turned_markers: Vec<(usize, f64)>,
    /// Robots whose link breaks, each with the duration of the break.
    pub cut: Vec<(Breakdown, Span)>,
    /// Robots that get no position fixes for a while, each with the duration of that while.
    pub blind: Vec<(Breakdown, Span)>,
    /// Times during which the broker passes nothing on. Connections stay, and messages wait.
    pub frozen: Vec<Outage>,
    /// Times during which the broker is gone and all connections are broken.
    pub gone: Vec<Outage>,
    /// Times without a controller. The controller is killed at the start, and another one continues its run at the end.
    pub crashed: Vec<Outage>,
    /// Mishaps, each with its time after the first departure.
    pub mishaps: Vec<(Span, Mishap)>,
    /// Indices of the frames that the operator jumps to, in this order. Each time robots have reached a frame, the
    /// operator jumps to the next index in this list.
    pub visits: Vec<usize>,
    /// Time from the moment at which a frame is ready for GO until the operator gives GO.
    pub go_after: Span,
    /// Largest allowed difference between a robot's light and the colour that the show's layers give it.
    pub light_tolerance: Tolerance,
    /// Number of rounds of each loop. In the last of them the operator gives GO, so that the show then leaves the loop.
    pub loop_rounds: u32,
}

/// Properties of position fixes.
#[derive(Clone, Debug, PartialEq)]
pub struct FixConditions {
    /// Noise of each coordinate, metres (1 sigma).
    pub place_sigma_m: f64,
    /// Noise of the heading, radians (1 sigma).
    pub heading_sigma_rad: f64,
    /// Largest constant error of a robot's fixes along each axis, metres.
    pub bias_m: f64,
    /// Number of steps of 16 ms from one fix to the next; at least 1.
    pub every: u32,
    /// Age of a fix when the robot gets it; at most 1 s.
    pub delay: Span,
    /// Duration of a drop-out of fixes; zero: no drop-outs. For each robot, the next drop-out begins 20 s after the end
    /// of the last one on average.
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
    /// One message in ten gets an additional, random delay below this; zero: no message does. Later messages of the
    /// same link wait behind the delayed message.
    pub jitter: Span,
    /// Probability that a message is lost.
    pub loss: f64,
    /// Probability that a message is duplicated.
    pub double: f64,
    /// Probability that a message is held back so that later messages may overtake it. All other messages keep their
    /// order, as with TCP.
    pub reorder: f64,
}

/// A breakdown of one robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Breakdown {
    /// Index of the robot in starting order; `None`: random.
    pub robot: Option<usize>,
    /// Time after the first departure. `None`: random, from a tenth to eight tenths of the planned duration.
    pub at: Option<Span>,
}

/// A time without a working broker, or without a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Outage {
    /// Time from the first departure until the outage begins.
    pub at: Span,
    /// How long it lasts.
    pub over: Span,
}

impl Conditions {
    /// Largest valid slip, a share of a wheel's turning.
    pub const SLIP_MAX: f64 = 0.5;
    /// Largest valid delay of a message in [`LinkConditions`].
    pub const DELAY_MAX: Span = Span::from_millis(5_000);
    /// Largest valid age of a fix.
    pub const FIX_DELAY_MAX: Span = Span::from_millis(1_000);

    /// Whether a person comes onto the floor.
    pub(crate) fn has_people(&self) -> bool {
        self.mishaps.iter().any(|(_, mishap)| matches!(mishap, Mishap::Person(_)))
    }

    /// Ideal conditions: no noise of position fixes, no slip, delay or loss, and clocks without drift. Proximity
    /// sensors keep their noise.
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

//! What a rehearsal makes robots and networks suffer.

use lightbots_base::Span;

/// All conditions of a rehearsal. The default is the standard one of every rehearsal.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Share of a wheel's turning that does not move the body, in the mean; 0 to 0.5.
    pub slip: f64,
    /// How far robots' clocks run fast or slow at most, parts per million.
    pub clock_ppm: f64,
    /// Position fixes.
    pub fixes: FixConditions,
    /// The network between the controller and each robot.
    pub link: LinkConditions,
    /// So many of the robots, the last ones, are original ones: they speak only `TARGET` and `COLOR`.
    pub originals: usize,
    /// Robots whose power fails: they stand where they are and say no more.
    pub killed: Vec<Breakdown>,
    /// Robots of which nothing is heard any more; they still hear and drive.
    pub muted: Vec<Breakdown>,
    /// Robots whose wheels do not turn any more; they still hear and speak.
    pub stuck: Vec<Breakdown>,
    /// Robots whose link breaks, and for how long.
    pub cut: Vec<(Breakdown, Span)>,
    /// Robots whose fixes stay away, and for how long.
    pub blind: Vec<(Breakdown, Span)>,
}

/// What position fixes are like.
#[derive(Clone, Debug, PartialEq)]
pub struct FixConditions {
    /// Noise of each coordinate, metres (1 sigma).
    pub place_sigma_m: f64,
    /// Noise of the heading, radians (1 sigma).
    pub heading_sigma_rad: f64,
    /// A constant error of each robot's place, metres, at most.
    pub bias_m: f64,
    /// A fix comes every so many steps of 16 ms; at least 1.
    pub every: u32,
    /// How old a fix is when it comes; at most 1 s.
    pub delay: Span,
    /// How long fixes stay away when they drop out, about every 20 s for each robot; zero: never.
    pub dropout: Span,
    /// Probability that a fix is anywhere within a metre.
    pub outliers: f64,
}

/// What a network does to messages, each way.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkConditions {
    /// A message is at least this late.
    pub delay_min: Span,
    /// A message is at most this late, jitter aside.
    pub delay_max: Span,
    /// One message in ten is late by up to this on top, and holds up those behind it.
    pub jitter: Span,
    /// Probability that a message is lost.
    pub loss: f64,
    /// Probability that a message comes twice.
    pub double: f64,
    /// Probability that a message is overtaken by those behind it. Without it a link keeps their order, as TCP does.
    pub reorder: f64,
}

/// One robot that breaks down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Breakdown {
    /// Which, counted from 0 in starting order; `None`: chance decides.
    pub robot: Option<usize>,
    /// How long after the show began; `None`: chance decides, while the show plays.
    pub at: Option<Span>,
}

impl Conditions {
    /// The most wheels may slip.
    pub const SLIP_MAX: f64 = 0.5;
    /// The most a fix or a message may be late.
    pub const DELAY_MAX: Span = Span::from_millis(5_000);
    /// The oldest a fix may be.
    pub const FIX_DELAY_MAX: Span = Span::from_millis(1_000);

    /// No noise, no slip, no delay, nothing lost, clocks that agree in rate.
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
            cut: Vec::new(),
            blind: Vec::new(),
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

//! What every step of a robot reads and writes.

use lightbots_base::{Instant, Limits, Rgb, Span};
use lightbots_wire::{Abilities, RobotState};

use crate::clock::ShowClock;
use crate::config::Config;
use crate::drive::DriveBase;
use crate::estimate::{Estimate, PoseQuality};
use crate::light_piece::LightPiece;
use crate::outbox::Outbox;
use crate::routes::Routes;
use crate::seek::Seek;
use crate::stall::StallDetector;
use crate::supervise::Supervisor;

/// Time beyond that of three fixes after which fixes are overdue. Below one step, jitter of the fixes counts as an
/// outage. Above, a robot drives on without fixes for longer.
const OVERDUE: Span = Span::from_millis(16);

/// All state that a step reads or writes while no neighbour is in sight and the light is a straight line of colours. It
/// is one piece of memory, 1.8 KB.
///
/// A simulator of thousands of robots may load it into the cache by its address and size before the robot's turn.
/// Otherwise a step waits longer for memory than it computes.
#[derive(Debug)]
#[repr(align(64))]
pub struct Hot {
    /// The own clock at the latest step or message.
    pub(crate) now: Instant,
    /// When the latest step was, in the time of the world that the wheels are in.
    pub(crate) last_step: Option<Instant>,
    /// How far the world of the wheels lags behind the own clock, as of the latest step.
    pub(crate) lag: Span,
    pub(crate) clock: ShowClock,
    /// Measures of the own body, a copy from the configuration.
    pub(crate) limits: Limits,
    /// Without a fix for longer than this, fixes are overdue.
    pub(crate) blind_after: Span,
    /// Range of the proximity sensors, metres.
    pub(crate) range_m: f32,
    /// Whether the robot understands routes, and with them the show clock.
    pub(crate) takes_routes: bool,
    /// Whether its light shows faults.
    pub(crate) shows_trouble: bool,
    /// Whether the light may change by itself, or a command changed it since the latest step.
    pub(crate) light_changes: bool,
    pub(crate) shown: Rgb,
    /// The light of the next steps, as far as it is known.
    pub(crate) light_piece: LightPiece,
    /// Moment of the show clock whose colour of the piece was shown last.
    pub(crate) piece_shown_at: Instant,
    pub(crate) state: RobotState,
    /// When the robot stops after a `STOP at`, by its own clock. Its route comes to rest by then.
    pub(crate) stops_at: Option<Instant>,
    /// Whether the robot stands until fixes come again.
    pub(crate) pauses: bool,
    /// Whether the safety layer slowed the robot on its route, and it has not caught up since.
    pub(crate) is_held_up: bool,
    /// Whether the safety layer follows a neighbour or acts on one. Otherwise a step does not run the safety layer.
    pub(crate) is_wary: bool,
    /// How well the robot knew its pose in the latest step.
    pub(crate) quality: PoseQuality,
    pub(crate) drive: DriveBase,
    pub(crate) stall: StallDetector,
    pub(crate) supervisor: Supervisor,
    pub(crate) seek: Option<Seek>,
    pub(crate) outbox: Outbox,
    pub(crate) estimate: Estimate,
    pub(crate) routes: Routes,
}

impl Hot {
    pub(crate) fn new(config: &Config) -> Self {
        let phase = Span::from_millis(i64::from(config.seed % 1999));
        Self {
            now: Instant::ZERO,
            last_step: None,
            lag: Span::ZERO,
            clock: ShowClock::new(Instant::ZERO + phase / 10),
            limits: config.limits,
            blind_after: config.fix_pace * 3 + OVERDUE,
            range_m: config.proximity.range_m,
            takes_routes: config.abilities.route,
            shows_trouble: config.abilities != Abilities::default(),
            light_changes: false,
            shown: Rgb::BLACK,
            light_piece: LightPiece::NONE,
            piece_shown_at: Instant::ZERO,
            state: RobotState::Lost,
            stops_at: None,
            pauses: false,
            is_held_up: false,
            is_wary: false,
            quality: PoseQuality { lost: true, lost_for_good: true, blind: true },
            drive: DriveBase::default(),
            stall: StallDetector::default(),
            supervisor: Supervisor::new(config.silence),
            seek: None,
            outbox: Outbox::new(phase),
            estimate: Estimate::new(config),
            routes: Routes::new(),
        }
    }
}

//! The state of an ordinary step of a robot.

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

/// Fixes are overdue after the time of three fixes plus this. With less than one step (16 ms), jitter of the fixes
/// counts as an outage. With a larger value, a robot drives on without fixes for longer.
const OVERDUE: Span = Span::from_millis(16);

/// The state that an ordinary step reads or writes, without the stored routes. In such a step no neighbour is in sight,
/// and the light follows a straight line of colours. `Hot` is one piece of memory, 1.8 KB.
///
/// A simulator of thousands of robots may prefetch it into the cache before the robot's step. Otherwise the step waits
/// longer for memory than it computes.
#[derive(Debug)]
#[repr(align(64))]
pub struct Hot {
    /// The robot's own clock at the latest step, message or change of the link.
    pub(crate) now: Instant,
    /// Moment of the latest step, in the time of the world in which the wheels turn; see
    /// [`Inputs::lag`](crate::Inputs::lag).
    pub(crate) last_step: Option<Instant>,
    /// [`Inputs::lag`](crate::Inputs::lag) of the latest step.
    pub(crate) lag: Span,
    pub(crate) clock: ShowClock,
    /// Copy of [`Config::limits`].
    pub(crate) limits: Limits,
    /// Time without a fix after which fixes are overdue.
    pub(crate) blind_after: Span,
    /// Range of the proximity sensors, metres.
    pub(crate) range_m: f32,
    /// Whether the robot understands routes, and with them the show clock.
    pub(crate) takes_routes: bool,
    /// Whether the light flashes red if the robot is faulty, cut off or lost. An original robot's light does not.
    pub(crate) shows_trouble: bool,
    /// Whether the light may change without a further command, or a command changed it since the latest step.
    pub(crate) light_changes: bool,
    pub(crate) shown: Rgb,
    /// The line of colours of the next steps; [`LightPiece::NONE`] if it is not known in advance.
    pub(crate) light_piece: LightPiece,
    /// Moment for which `light_piece` last gave the colour, show clock.
    pub(crate) piece_shown_at: Instant,
    pub(crate) state: RobotState,
    /// When the robot stops because of a `STOP at` command, own clock; `None` if there is none. The route comes to rest
    /// by then.
    pub(crate) stops_at: Option<Instant>,
    /// Whether the robot stands still until position fixes come again.
    pub(crate) pauses: bool,
    /// Whether the safety layer slowed the robot on its route, and the robot has not caught up since.
    pub(crate) is_held_up: bool,
    /// Whether the safety layer tracks a neighbour, or slows the robot for one. If not, a step runs the safety layer
    /// only if a sensor reads a gap within the range.
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

//! What a run counts: frames, dropouts, arrivals, and what recovery has cost.

use crate::run::clock_wait::ClockWait;
use crate::run::recovery_bound::RecoveryBound;
use lightbots_base::Instant;

/// What a run counts from its beginning on. A new controller that takes it up knows only the numbers of frames and
/// dropouts, and how often it was taken up.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tally {
    /// Number of frames that robots have reached.
    pub frames_played: usize,
    /// Number of dropouts; a robot that dropped out twice counts twice.
    pub dropouts: usize,
    /// How often a new controller took up the run after the controller before had ended.
    pub taken_up: u32,
    /// Replans and time that recovery from dropouts has cost, and their bounds.
    pub recovery: RecoveryBound,
    /// How long the run has waited for precise clocks.
    pub clock_wait: ClockWait,
    /// When the first and the last robot arrived at its place in the next frame, over all legs (drives) that lead to
    /// that frame. `None` if none has arrived.
    pub arrivals: Option<(Instant, Instant)>,
}

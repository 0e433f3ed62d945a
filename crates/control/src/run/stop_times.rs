//! When robots stopped on a drive.

use lightbots_base::Instant;
use serde::{Deserialize, Serialize};

/// When all robots stopped during a drive, show clock.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct StopTimes {
    /// When robots began to slow down.
    pub began: Instant,
    /// When robots stood still.
    pub stood: Instant,
}

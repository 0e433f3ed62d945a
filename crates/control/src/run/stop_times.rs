//! When robots stopped on a drive.

use lightbots_base::Instant;
use serde::{Deserialize, Serialize};

/// When robots stopped on a drive, show clock.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct StopTimes {
    /// When robots began to stop.
    pub began: Instant,
    /// When robots stood.
    pub stood: Instant,
}

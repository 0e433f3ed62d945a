//! When robots that drove stopped.

use lightbots_base::Instant;
use serde::{Deserialize, Serialize};

/// A drive that was stopped.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct StopTimes {
    /// Robots began to stop then …
    pub began: Instant,
    /// … and stood then.
    pub stood: Instant,
}

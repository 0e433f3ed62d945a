//! The input log: every input of a controller, in order. A replay of the log has the same outputs to the bit.
//!
//! A log is the bytes [`MAGIC`], the number [`VERSION`] (2 bytes, little-endian) and blocks ([`crate::block`]). The
//! first block is the [`LogHeader`], which holds the controller at rest with its show. Each further block holds the
//! records of inputs of about a second, or of less. If outputs were taken after an input, a record before the next
//! input holds two bytes of the digest of all outputs until then. A replay compares these bytes, and thus finds the
//! first input after which an output differs. Plans are not in the log: the replay makes them again. If the planner was
//! cancelled, the replay cancels it at the same check.
//!
//! [`RecordedController`] writes a log, [`replay`] replays it.

mod digest;
mod growing;
mod record;
mod recorded;
mod recording;
mod replaying;
mod senders;
#[cfg(test)]
mod tests;

pub use growing::{GrowingReplay, replay, replay_observed};
pub use recorded::RecordedController;
pub use replaying::{
    Difference, HEAD_BYTES, LogEnd, LogError, ReplayObserver, ReplayReport, ReplayStep, check_head,
};

use serde::{Deserialize, Serialize};

/// The first bytes of every input log.
const MAGIC: &[u8; 8] = b"LBotsLog";
/// Version of the log format. Raise it with every change of a type that is written: `Controller`, `Show`, `Record`.
/// Raise it with the version of journals, too, because a log can hold an `UnfinishedRun`.
const VERSION: u16 = 28;

/// The first block of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LogHeader {
    /// Version of the program that wrote the log.
    pub program: String,
    /// Notes for people, as names and values: for example the command, the seed and the faults.
    pub notes: Vec<(String, String)>,
    /// Moment at which the log begins, microseconds of the show clock. The first record counts its time from this
    /// moment.
    pub began_us: u64,
    /// The controller at that moment, as the bytes of `Controller::checkpoint`.
    pub checkpoint: Vec<u8>,
}

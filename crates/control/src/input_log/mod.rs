//! The input log: every input of a controller, in order, so that a replay of a run has the same outputs to the bit.
//!
//! A log is the bytes [`MAGIC`], the number [`VERSION`] (2 bytes, little-endian) and blocks ([`crate::block`]). The
//! first block is the [`LogHeader`] with the controller at rest, the show included. The other blocks hold records of
//! inputs, each for about a second. After outputs were taken, a record holds two bytes of the digest of all outputs up
//! to then. A replay compares these bytes, and thus finds the first input after which an output differs. Plans are not
//! in the log: the replay makes them again. It cancels those that were cancelled, at the same check of the planner.
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
/// The format of logs. Raise it with every change of a type that is written: `Controller`, `Show`, `Record`,
/// and with the version of journals.
const VERSION: u16 = 26;

/// The first block of a log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct LogHeader {
    /// Version of the program that wrote it.
    pub program: String,
    /// Notes for people, such as the command, the seed and the faults: names and values.
    pub notes: Vec<(String, String)>,
    /// Moment from which the first record counts its time, microseconds of the show clock.
    pub began_us: u64,
    /// The controller at that moment, as bytes of a checkpoint.
    pub checkpoint: Vec<u8>,
}

//! The journal of a run: what it takes to go on with it after the controller was killed.
//!
//! A journal is the bytes [`MAGIC`], the number [`VERSION`] (2 bytes, little-endian) and blocks ([`crate::block`]).
//! Each block is an [`Entry`]: all that one step of the controller changed of the [`JournalState`]. The first entry
//! holds the whole state, the show included. A journal that was cut anywhere ends with its last whole entry. A journal
//! that has become long is begun again with the state at that moment.
//!
//! [`Journal`] writes the entries of a run, [`UnfinishedRun`] is the run read from them, and
//! [`Controller::take_up`](crate::Controller::take_up) goes on with that run.

mod leg_entry;
mod reading;
mod soundness;
mod state;
mod taking_up;
#[cfg(test)]
mod tests;
mod writing;

pub use reading::{JournalError, UnfinishedRun};
pub use taking_up::OnReturn;
pub use writing::JournalPiece;

pub(crate) use leg_entry::LegEntry;
pub(crate) use state::{Change, Entry, JournalState, ParticipantEntry, Position, RunBegun, RunProgress};
pub(crate) use writing::Journal;

/// The first bytes of every journal.
const MAGIC: &[u8; 8] = b"LBotsJrn";
/// The format of journals. Raise it with every change of a type that is written: `Entry`, `JournalState`, `Show`.
pub(crate) const VERSION: u16 = 11;

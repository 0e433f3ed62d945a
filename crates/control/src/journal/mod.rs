//! The journal of a run: all that a new controller needs to go on with the run after the controller was killed.
//!
//! A journal is the bytes [`MAGIC`], the number [`VERSION`] (2 bytes, little-endian), the byte [`OUTDATED`] and blocks
//! ([`crate::block`]). Each block is an [`Entry`] with changes of the [`JournalState`]. The first entry holds the whole
//! state, the show included. A journal that was cut anywhere ends with its last whole entry. A journal that has become
//! long is replaced by a new one that begins with the present state.
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
/// Version of the journal format. Raise it with every change of a type that is written: `Entry`, `JournalState`,
/// `Show`.
pub(crate) const VERSION: u16 = 13;

/// Place (offset in bytes) and value of the byte that says that entries after the last one are missing. The program
/// that keeps the file writes it when it could not write a piece: on most file systems a byte can be replaced although
/// the disk is full. The byte is 0 before.
pub const OUTDATED: (usize, u8) = (MAGIC.len() + size_of::<u16>(), 1);

//! Reads the run of a journal.

use super::{Change, Entry, JournalState, MAGIC, OUTDATED, VERSION};
use crate::block::Blocks;
use crate::computer_time::ComputerTime;
use core::fmt;
use lightbots_base::Instant;
use lightbots_show::Show;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Why bytes cannot be read as a journal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JournalError {
    /// The bytes are no journal.
    NoJournal,
    /// The bytes are a journal in another version of the format, which is named here.
    OtherVersion(u16),
    /// Not even the first entry is whole.
    NoEntry,
    /// An entry is not valid, or the state after all entries is not plausible, although the checksums are right.
    BadEntry,
}

/// A run that was still under way when its controller ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnfinishedRun {
    /// When the last of the changes that were read was made, show clock.
    pub(crate) at: Instant,
    /// The computer's clocks when the last entry was written.
    clocks: ComputerTime,
    pub(crate) state: JournalState,
    /// Whether later entries were lost. The operator may have paused the run since.
    pub(crate) is_outdated: bool,
}

impl UnfinishedRun {
    /// Reads the run of a journal up to its last whole entry; `Ok(None)` if that run had ended. `bytes` may be
    /// anything: this is checked.
    pub fn read(bytes: &[u8]) -> Result<Option<Self>, JournalError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(JournalError::NoJournal)?;
        let (version, rest) = rest.split_first_chunk::<2>().ok_or(JournalError::NoEntry)?;
        let version = u16::from_le_bytes(*version);
        if version != VERSION {
            return Err(JournalError::OtherVersion(version));
        }
        let mark = rest.first().ok_or(JournalError::NoEntry)?;
        let mut run: Option<Self> = None;
        for block in Blocks::new(bytes, OUTDATED.0 + 1) {
            let entry: Entry = postcard::from_bytes(block).map_err(|_| JournalError::BadEntry)?;
            run = Some(Self::after(run, entry).ok_or(JournalError::BadEntry)?);
        }
        let run = Self { is_outdated: *mark != 0, ..run.ok_or(JournalError::NoEntry)? };
        if !run.is_sound() {
            return Err(JournalError::BadEntry);
        }
        Ok(Some(run).filter(|run| run.state.ended.is_none()))
    }

    /// Applies an entry to the run before it; `None` if the entry does not fit that run.
    fn after(before: Option<Self>, entry: Entry) -> Option<Self> {
        let Entry { at, clocks, changes } = entry;
        let mut changes = changes.into_iter();
        let mut state = match before {
            Some(run) => run.state,
            None => match changes.next()? {
                Change::State(state) => *state,
                _ => return None,
            },
        };
        for change in changes {
            state.apply(change)?;
        }
        Some(Self { at, clocks, state, is_outdated: false })
    }

    /// Whether the values of the state are plausible and fit together, so that a controller can go on with the run.
    pub(crate) fn is_sound(&self) -> bool {
        self.state.is_sound(self.at)
    }

    /// Returns the show that is played.
    pub fn show(&self) -> &Arc<Show> {
        &self.state.begun.show
    }

    /// Returns the frame that robots were to reach next, counted from 0; the last frame if all frames were reached.
    pub fn frame(&self) -> usize {
        self.state.progress.next.frame.min(self.show().frames.len().saturating_sub(1))
    }

    /// Returns the number of frames that robots reached.
    pub fn frames_played(&self) -> usize {
        self.state.progress.frames_played as usize
    }

    /// Returns when the last change was made, show clock.
    pub fn last_change(&self) -> Instant {
        self.at
    }

    /// Returns the show clock of the run at the time when the computer's clocks read `now`. Robots may still drive by
    /// this show clock, so a new controller must continue it. If only the time of day is known and was set back, no
    /// time counts as passed.
    pub fn show_clock_at(&self, now: &ComputerTime) -> Instant {
        Instant(self.at.0.saturating_add(now.us_since(&self.clocks)))
    }
}

impl fmt::Display for JournalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoJournal => f.write_str("it is no journal of a run"),
            Self::OtherVersion(version) => {
                write!(f, "it is of another version of this program (format {version})")
            }
            Self::NoEntry => f.write_str("it was cut off at its begin"),
            Self::BadEntry => f.write_str("it makes no sense"),
        }
    }
}

impl std::error::Error for JournalError {}

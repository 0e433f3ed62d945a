//! Recorded runs over HTTP.
//!
//! | request | body | answer |
//! |---|---|---|
//! | `GET /api/runs` | | list of [`RunEntry`], the newest first |
//! | `GET /api/runs/{number}/report` | | the report of a run, an HTML page that needs no other file; 409 while the run is
//! on, 422 for a run that cannot be read, 503 if the report takes longer than a minute: ask again |

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A recorded run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct RunEntry {
    /// Number for `/api/runs/{number}/report`.
    pub number: u64,
    /// What robots did.
    pub kind: RunEntryKind,
    /// Name that the author gave the show; may be empty.
    pub show: String,
    /// When it began, milliseconds since 1970.
    pub began_ms: u64,
    /// When the run ended, milliseconds since 1970; null: the run is still on, or the program ended before the run did.
    pub ended_ms: Option<u64>,
    /// Whether the run reached its end, all its frames were shown, and no robot was missing at the end. `false` while
    /// the run is on.
    pub ok: bool,
    /// How the run ended, in one sentence; null: the run is still on, or the program ended before the run did.
    pub outcome: Option<String>,
    /// Whether the report of the run can be made.
    pub has_report: bool,
}

/// What robots did in a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum RunEntryKind {
    /// They played a show.
    #[default]
    Show,
    /// They drove to one frame.
    Frame,
    /// They drove to their starting places.
    Home,
}

//! The playlist over HTTP.
//!
//! | request | body | answer |
//! |---|---|---|
//! | `GET /api/playlist` | | [`PlaylistState`] |
//! | `PUT /api/playlist` | [`PlaylistChange`] | [`PlaylistState`]; 412 if another client changed the playlist first,
//! 409 while its file cannot be read, 422 for an entry that is impossible |
//!
//! docs/operations.md says when an entry is played, skipped, or waits.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A new playlist from a client.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct PlaylistChange {
    /// `PlaylistState.revision` of the playlist that this new playlist replaces.
    pub revision: u64,
    /// Whether shows start by themselves. The server keeps the setting over restarts of the program.
    pub on: bool,
    /// The entries in order.
    pub entries: Vec<PlaylistEntry>,
}

/// A show of a playlist. Either it starts at a time of day (`at`), or `pause_min` after the previous entry has ended.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct PlaylistEntry {
    /// Number of the entry, given by the server; 0 or left out: a new entry.
    #[serde(default)]
    #[ts(as = "Option<u32>", optional)]
    pub id: u32,
    /// Name of the show in the library.
    pub show: String,
    /// Time of day at which the entry starts, `HH:MM`, local time of the server; null: it follows the previous entry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional = nullable)]
    pub at: Option<String>,
    /// Days on which an entry with `at` is played; empty: every day.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[ts(as = "Option<Vec<PlaylistDay>>", optional)]
    pub weekdays: Vec<PlaylistDay>,
    /// Minutes from the end of the previous entry to the start of this entry; null: this entry has a time of day.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[ts(optional = nullable)]
    pub pause_min: Option<u32>,
    /// Whether robots drive to their starting places at the beginning of the pause. Only for an entry with `pause_min`.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[ts(as = "Option<bool>", optional)]
    pub home: bool,
    /// Speed of drives, percent of the usual speed.
    pub speed_percent: u32,
}

/// A day of the week.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum PlaylistDay {
    /// Monday.
    Mon,
    /// Tuesday.
    Tue,
    /// Wednesday.
    Wed,
    /// Thursday.
    Thu,
    /// Friday.
    Fri,
    /// Saturday.
    Sat,
    /// Sunday.
    Sun,
}

/// The current playlist.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct PlaylistState {
    /// Number of the playlist's version, increased with each change of `on` or `entries`.
    pub revision: u64,
    /// Whether shows start by themselves.
    pub on: bool,
    /// The entries in order.
    pub entries: Vec<PlaylistEntry>,
    /// What became of each entry today, in the order of `entries`.
    pub today: Vec<PlaylistToday>,
    /// The entry that starts next; null: none within a week, or none until the present entry is over. If the playlist
    /// is off: the entry that would start next if it were switched on.
    pub next: Option<PlaylistNext>,
    /// Why the playlist is held and starts no show, one sentence: a person stopped robots. null: the playlist is not
    /// held. The operation `go_on` lets it continue.
    pub held: Option<String>,
    /// Why the playlist's file cannot be read, with file, place and remedy: nothing is played meanwhile. null: the file can
    /// be read.
    pub fault: Option<String>,
    /// Local time of day of the server, `HH:MM`.
    pub now: String,
}

/// What became of an entry today.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct PlaylistToday {
    /// What became of the entry.
    pub result: PlaylistResult,
    /// Local time of day of the server, `HH:MM`, at which the entry starts, began or ended. null: not known yet, or
    /// `result` is `not_today` or `past`.
    pub time: Option<String>,
    /// Why the entry failed or was skipped, with a remedy: one line; null: neither happened.
    pub line: Option<String>,
}

/// What may become of an entry on a day.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum PlaylistResult {
    /// The entry is not played on this day of the week.
    NotToday,
    /// The entry's time has not come, or the previous entry is not over, or robots drive to their starting places
    /// before the entry.
    Waiting,
    /// The time for the entry had passed by more than five minutes before the playlist was switched on. That time is
    /// the entry's time of day, or that of the entry that it follows.
    Past,
    /// The entry plays.
    Playing,
    /// The entry was played to its end.
    Played,
    /// The entry did not begin, or did not end as it should.
    Failed,
    /// The entry could not begin in time.
    Skipped,
}

/// The entry that starts next.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct PlaylistNext {
    /// Number of the entry.
    pub id: u32,
    /// Name of its show.
    pub show: String,
    /// Local time of the server, such as `19:00` or `Fri 19:00`.
    pub time: String,
    /// Time until the entry starts, seconds; 0: it is due.
    pub in_s: u32,
}

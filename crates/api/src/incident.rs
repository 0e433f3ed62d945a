//! What went wrong with robots, link or program: one card for each cause.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// All incidents that are kept, oldest first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct Incidents {
    /// The incidents.
    pub list: Vec<Incident>,
}

/// Something that went wrong, what the program did about it, and what people can do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Incident {
    /// Number of the incident; it stays while the incident grows.
    pub id: u32,
    /// Time of its first event, milliseconds since 1970.
    pub time_ms: u64,
    /// How much it matters.
    pub tone: IncidentTone,
    /// What happened: robot, frame, cause. One sentence.
    pub title: String,
    /// What the program did about it; may be empty.
    pub done: String,
    /// What people can do.
    pub advice: String,
    /// Names of the first robots that it is about.
    pub robots: Vec<String>,
    /// Number of all these robots.
    pub count: usize,
    /// Its robots want to join: `list` admits them.
    pub wants_to_join: bool,
    /// It holds no longer.
    pub over: bool,
    /// The operator has read it.
    pub read: bool,
}

/// How much an incident matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum IncidentTone {
    /// Good to know.
    Information,
    /// Look at it.
    Look,
    /// The show cannot go on.
    Failed,
}

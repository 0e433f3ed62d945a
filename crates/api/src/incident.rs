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
    /// Number of the incident. It does not change when further events are added to the incident.
    pub id: u32,
    /// Time of the incident's first event, milliseconds since 1970.
    pub time_ms: u64,
    /// How much it matters.
    pub tone: IncidentTone,
    /// What happened: robot, frame, cause. One sentence.
    pub title: String,
    /// What the program did about the incident; may be empty.
    pub done: String,
    /// What people can do.
    pub advice: String,
    /// Names of the first robots concerned.
    pub robots: Vec<String>,
    /// Number of all robots concerned.
    pub count: usize,
    /// Whether the robots concerned are not admitted to runs yet; the operation `list` admits them.
    pub wants_to_join: bool,
    /// Whether the incident is over.
    pub over: bool,
    /// Whether the operator has read the incident.
    pub read: bool,
}

/// How much an incident matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum IncidentTone {
    /// Good to know.
    Information,
    /// The operator should look at it.
    Look,
    /// The show cannot go on.
    Failed,
}

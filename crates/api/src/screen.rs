//! Messages from the server to a screen on the WebSocket.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{Answer, Fleet, Incidents, Plan, State};

/// A message to a screen. `hello` is followed by `show`, `plan`, `incidents`, `fleet` and the last lines of the log.
/// Each of these is sent again after a change, `fleet` also without a change. `state` comes 20 times a second, each
/// after the binary message `Robots`. A screen acknowledges each `state` with `took`. While a screen has not
/// acknowledged several, it gets no more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "type", rename_all = "snake_case")]
// A message is made, sent and dropped at once, so that its size does not matter.
#[allow(clippy::large_enum_variant)]
pub enum ToScreen {
    /// The first message.
    Hello(Hello),
    /// The open show after a change, or another show that was opened.
    Show(OpenShow),
    /// The plan of the open show without paths. `GET /api/plan` has the paths.
    Plan(Plan),
    /// The fleet table.
    Fleet(Fleet),
    /// A snapshot of connection and run.
    State(State),
    /// A line of the log.
    Log(LogLine),
    /// What went wrong.
    Incidents(Incidents),
    /// The answer to a request of this screen.
    Answer(Answer),
}

/// What a screen must know about the server.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Hello {
    /// Version of the program.
    pub version: String,
    /// Number of this screen: screens are counted in the order of their connections.
    pub screen: u32,
    /// Number of simulated robots that this server runs.
    pub simulated: usize,
    /// Whether the network can reach the server without TLS (`--plain-http`), so that others on the network can read
    /// passwords.
    pub plain_http: bool,
}

/// The show that is open on every screen.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, TS)]
pub struct OpenShow {
    /// Number of the document's state, increased with every change.
    pub revision: u32,
    /// Name of the show in the library; null: no show is open.
    pub name: Option<String>,
    /// Version of the show in the library, for `If-Match`; null: no show is open.
    pub etag: Option<String>,
    /// Why the show cannot be saved under its name, for people: its file holds fields that the document lacks. null: the
    /// show can be saved.
    pub read_only: Option<String>,
    /// The document in the format `lightbots`; null: no show is open.
    #[ts(type = "unknown")]
    pub document: serde_json::Value,
}

/// A line of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct LogLine {
    /// Number of the line. A line with the number of an earlier line replaces that line.
    pub id: u32,
    /// Time of the event, milliseconds since 1970; of the first event if the line sums up several.
    pub time_ms: u64,
    /// Severity.
    pub level: Level,
    /// Text for people, one line.
    pub text: String,
    /// Number of robots if the line sums up events of at least two robots, else 0.
    pub count: usize,
    /// Names of the first of these robots.
    pub robots: Vec<String>,
}

/// Severity of a line of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// A detail for troubleshooting.
    Debug,
    /// A normal event.
    Info,
    /// A fault that the run survives.
    Warn,
    /// A failure.
    Error,
}

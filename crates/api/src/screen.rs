//! Everything a server says on the WebSocket.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::{Answer, Fleet, Plan, State};

/// A message to a screen. After `hello` come `show`, `plan`, `fleet` and the last lines of the log, then each of them
/// again when it changes, and `state` twenty times a second, if the screen keeps up: it says `took` after each, and one
/// that has several before it gets no more. Before each `state` comes a binary message, the robots.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
#[serde(tag = "type", rename_all = "snake_case")]
// They are made, written and dropped, one at a time.
#[allow(clippy::large_enum_variant)]
pub enum ToScreen {
    /// The first message.
    Hello(Hello),
    /// The show that is open has changed, or another one was opened.
    Show(OpenShow),
    /// The plan of the open show, without paths: those are at `GET /api/plan`.
    Plan(Plan),
    /// The fleet table.
    Fleet(Fleet),
    /// How everything is now.
    State(State),
    /// Something happened.
    Log(LogLine),
    /// The answer to a request of this screen.
    Answer(Answer),
}

/// Who the server is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Hello {
    /// Version of the program.
    pub version: String,
    /// Number of this screen among all that ever connected.
    pub screen: u32,
    /// How many simulated robots this server runs.
    pub simulated: usize,
    /// Whether anyone on the network can reach this server, and drive the robots: there is no sign-in.
    pub open_to_network: bool,
}

/// The show that is open on every screen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct OpenShow {
    /// Counts up with every change.
    pub revision: u32,
    /// Its name in the library; null: nothing is open.
    pub name: Option<String>,
    /// Its version in the library, for `If-Match`.
    pub etag: Option<String>,
    /// The document as a `.lightbots.json` file holds it; null: nothing is open.
    #[ts(type = "unknown")]
    pub document: serde_json::Value,
}

/// A line of the log.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct LogLine {
    /// Its number. A line with a number that was there before takes that line's place: it has grown.
    pub id: u32,
    /// When, milliseconds since 1970; of the first where it sums up many events.
    pub time_ms: u64,
    /// How grave.
    pub level: Level,
    /// One line for people.
    pub text: String,
    /// How many robots it is about, where it sums up what happened to several; else 0.
    pub count: usize,
    /// Names of the first of them.
    pub robots: Vec<String>,
}

/// How grave a line of the log is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// For those who look closely.
    Debug,
    /// What happens.
    Info,
    /// Something is not as it should be.
    Warn,
    /// Something failed.
    Error,
}

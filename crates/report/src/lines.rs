//! A recorded run as lines for other programs: what came, what was sent, and what happened.

use std::collections::BTreeMap;

use lightbots_base::Instant;
use lightbots_control::{LogEnd, LogError, ReplayReport, ReplayStep, replay_observed};
use schemars::JsonSchema;
use serde::Serialize;

/// A line of a run. In a payload, � stands for bytes that are not UTF-8 text.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "of", rename_all = "snake_case")]
pub enum RunLine {
    /// The controller received a message, mostly from a robot.
    Message(LogMessage),
    /// The controller sent a message to a robot or to all.
    Sent(LogMessage),
    /// Another input of the controller: an operation, a change of the connection to the broker, or a finished plan.
    Input(LogNote),
    /// An event that the controller reported.
    Event(LogNote),
    /// The last line.
    End {
        /// Version of the program that recorded the run.
        program: String,
        /// Notes of the recording, such as the command and the seed.
        notes: BTreeMap<String, String>,
        /// Whether the recording has its end, and replaying it gave exactly the recorded outputs.
        is_same: bool,
        /// Digest of all outputs of the controller, 16 hexadecimal digits.
        digest: String,
    },
}

/// An MQTT message.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LogMessage {
    /// When the controller received or sent the message, seconds of the show clock.
    pub at_s: f64,
    /// Topic of the message.
    pub topic: String,
    /// Payload of the message, as docs/protocol.md defines it.
    pub payload: String,
}

/// An input or an event in words.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LogNote {
    /// When it happened, seconds of the show clock.
    pub at_s: f64,
    /// What happened, in words.
    pub what: String,
}

/// Replays a recording and calls `write` with each of its lines. `progress` is called repeatedly with the share that is
/// done, 0 to 1.
pub fn run_lines(
    log: &[u8],
    progress: &mut dyn FnMut(f64),
    write: &mut dyn FnMut(&RunLine),
) -> Result<ReplayReport, LogError> {
    let message = |at: Instant, topic: &str, payload: &[u8]| LogMessage {
        at_s: seconds(at),
        topic: topic.to_owned(),
        payload: String::from_utf8_lossy(payload).into_owned(),
    };
    let note = |at: Instant, what: String| LogNote { at_s: seconds(at), what };
    let report = replay_observed(log, progress, &mut |now, _, step| {
        let line = match step {
            ReplayStep::Message { topic, payload } => RunLine::Message(message(now, topic, payload)),
            ReplayStep::Sent(send) => RunLine::Sent(message(now, &send.topic.write(), &send.payload)),
            ReplayStep::Input(what) => RunLine::Input(note(now, what.to_owned())),
            ReplayStep::Event(event) => RunLine::Event(note(event.at, event.kind.to_string())),
            ReplayStep::Woken => return,
        };
        write(&line);
    })?;
    write(&RunLine::End {
        program: report.program.clone(),
        notes: report.notes.iter().cloned().collect(),
        is_same: report.end == LogEnd::Complete && report.difference.is_none(),
        digest: format!("{:016x}", report.digest),
    });
    Ok(report)
}

/// A moment as seconds of the show clock, rounded to microseconds.
fn seconds(at: Instant) -> f64 {
    (at.as_secs() * 1e6).round() / 1e6
}

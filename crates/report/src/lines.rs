//! A recorded run as lines for other programs: what came, what was sent, and what happened.

use std::collections::BTreeMap;

use lightbots_base::Instant;
use lightbots_control::{LogEnd, LogError, ReplayReport, ReplayStep, replay_observed};
use schemars::JsonSchema;
use serde::Serialize;

/// A line of a run. Payloads that are no text have � in place of their other bytes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "of", rename_all = "snake_case")]
pub enum RunLine {
    /// A message came, mostly from a robot.
    Message(LogMessage),
    /// The controller sent a message to a robot or to all.
    Sent(LogMessage),
    /// The operator asked for something, the broker came or went, or a plan was made.
    Input(LogNote),
    /// The controller said that something happened.
    Event(LogNote),
    /// The last line.
    End {
        /// Version of the program that recorded the run.
        program: String,
        /// What it noted, such as the command and the seed.
        notes: BTreeMap<String, String>,
        /// Whether the recording has its end, and this program did the same as the recorded one to the bit.
        is_same: bool,
        /// Digest of all that the controller said, 16 hexadecimal digits.
        digest: String,
    },
}

/// A message of MQTT.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LogMessage {
    /// When, seconds of the show clock.
    pub at_s: f64,
    /// Its topic.
    pub topic: String,
    /// Its payload, as docs/protocol.md has it.
    pub payload: String,
}

/// Something in words.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LogNote {
    /// When, seconds of the show clock.
    pub at_s: f64,
    /// What.
    pub what: String,
}

/// Replays a log and passes its lines to `write`. `progress` is called repeatedly with the share that is done.
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

/// A moment as seconds, to the microsecond.
fn seconds(at: Instant) -> f64 {
    (at.as_secs() * 1e6).round() / 1e6
}

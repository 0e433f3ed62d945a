//! Messages that the exam receives from robots.

use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_wire::{Report, TimeQuestion, Topic};

/// Largest number of stored messages; further messages are dropped, so that a flooding robot cannot fill the memory. At
/// the 2 reports a second of R41 this is more than two hours.
const MESSAGES_MAX: usize = 20_000;

/// One message of a robot.
#[derive(Clone, Debug)]
pub(crate) struct Received {
    /// Time of arrival, on the exam's clock.
    pub at: Instant,
    /// Topic of the message: `Uuid`, `Arrival`, `Status` or `Time`.
    pub topic: Topic,
    /// The first 1,024 bytes of the payload as text; invalid UTF-8 is replaced.
    pub text: String,
    /// Whether the payload is UTF-8 of at most 1,024 bytes (R4).
    pub is_proper: bool,
    /// The report in the message; `None` if there is no valid one.
    pub report: Option<Report>,
    /// The time question in the message; `None` if there is no valid one.
    pub question: Option<TimeQuestion>,
}

impl Received {
    /// Reads a message; `None` if robots do not publish on this topic.
    pub fn new(at: Instant, topic: &str, payload: &[u8]) -> Option<Self> {
        let topic = Topic::parse(topic)?;
        if matches!(topic, Topic::Broadcast | Topic::Robot(_)) {
            return None;
        }
        let is_proper = payload.len() <= 1024 && core::str::from_utf8(payload).is_ok();
        let kept = &payload[..payload.len().min(1024)];
        let report = if topic == Topic::Time { None } else { Report::decode(payload) };
        let question = if topic == Topic::Time { TimeQuestion::decode(payload) } else { None };
        Some(Self {
            at,
            topic,
            text: String::from_utf8_lossy(kept).into_owned(),
            is_proper,
            report,
            question,
        })
    }

    /// The first word of the message. It is the name of the sender, and may be invalid.
    pub fn name(&self) -> &str {
        self.text.split_ascii_whitespace().next().unwrap_or("")
    }

    /// The name of the sender; `None` if it is invalid.
    pub fn id(&self) -> Option<RobotId> {
        RobotId::new(self.name())
    }

    /// Value of the report's field `key=value`, which comes after name, x and y; `None` if there is no such field.
    pub fn field(&self, key: &str) -> Option<&str> {
        self.text
            .split_ascii_whitespace()
            .skip(3)
            .find_map(|field| field.split_once('=').filter(|(name, _)| *name == key).map(|(_, value)| value))
    }

    /// Value of the report's field `key=value` as a whole number; `None` if it is missing or no such number.
    pub fn whole(&self, key: &str) -> Option<u64> {
        self.field(key)?.parse().ok()
    }

    /// Reported position, stage metres; `None` if the message reports none.
    pub fn place(&self) -> Option<Vec2> {
        self.report.as_ref()?.at
    }
}

/// The stored messages of the robot under test, in order of arrival.
#[derive(Debug, Default)]
pub(crate) struct ReceivedLog(Vec<Received>);

impl ReceivedLog {
    /// Stores a message, or drops it if `MESSAGES_MAX` are stored already.
    pub fn push(&mut self, received: Received) {
        if self.0.len() < MESSAGES_MAX {
            self.0.push(received);
        }
    }

    /// Number of stored messages.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The stored messages with index `mark` and higher.
    pub fn since(&self, mark: usize) -> &[Received] {
        self.0.get(mark..).unwrap_or(&[])
    }
}

//! Everything the robot said, in order.

use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_wire::{Report, TimeQuestion, Topic};

/// More than this is not kept: a robot that floods cannot fill the memory.
const MOST: usize = 20_000;

/// One message of a robot.
#[derive(Clone, Debug)]
pub(crate) struct Heard {
    /// When it came in, the exam's clock.
    pub at: Instant,
    /// `Uuid`, `Arrival`, `Status` or `Time`.
    pub topic: Topic,
    /// Its payload; bytes that are no UTF-8 are replaced.
    pub text: String,
    /// Whether it was UTF-8 of at most 1,024 bytes.
    pub is_proper: bool,
    /// The report it holds.
    pub report: Option<Report>,
    /// The question it holds.
    pub question: Option<TimeQuestion>,
}

impl Heard {
    /// A message as it came; `None` where it is on no robot's topic.
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

    /// The first word: the name of who says it, whatever follows.
    pub fn name(&self) -> &str {
        self.text.split_ascii_whitespace().next().unwrap_or("")
    }

    /// The name, where it is one.
    pub fn id(&self) -> Option<RobotId> {
        RobotId::new(self.name())
    }

    /// The value of a further field `key=value`.
    pub fn field(&self, key: &str) -> Option<&str> {
        self.text
            .split_ascii_whitespace()
            .skip(3)
            .find_map(|field| field.split_once('=').filter(|(name, _)| *name == key).map(|(_, value)| value))
    }

    /// The value of a further field as a whole number.
    pub fn whole(&self, key: &str) -> Option<u64> {
        self.field(key)?.parse().ok()
    }

    /// Where it says it is.
    pub fn place(&self) -> Option<Vec2> {
        self.report.as_ref()?.at
    }
}

/// What the robot under test said.
#[derive(Debug, Default)]
pub(crate) struct Log(Vec<Heard>);

impl Log {
    /// Keeps a message.
    pub fn push(&mut self, heard: Heard) {
        if self.0.len() < MOST {
            self.0.push(heard);
        }
    }

    /// How many there are: what comes later stands behind this.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Messages from `mark` on.
    pub fn since(&self, mark: usize) -> &[Heard] {
        self.0.get(mark..).unwrap_or(&[])
    }
}

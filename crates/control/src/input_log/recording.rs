//! Writes the bytes of a log.

use super::digest::OutputDigest;
use super::record::{Record, RobotTopic};
use super::senders::{Likeness, Senders};
use super::{LogHeader, MAGIC, VERSION};
use crate::block::append_block;
use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

/// A block of records is closed at the first input that comes this long after the block began, show clock. With longer
/// blocks more inputs are lost when the program is killed.
const BLOCK_LASTS: Span = Span::from_millis(1_000);
/// A block of records is closed at the next input once its content has this number of bytes.
const BLOCK_BYTES: usize = 32 * 1024;

/// A log that is being written.
#[derive(Debug)]
pub(crate) struct Recording {
    /// Bytes of the log that were not taken yet: head and whole blocks.
    ready: Vec<u8>,
    /// Content of the block that is not closed yet.
    open: Vec<u8>,
    /// When the open block began, show clock.
    open_since: Instant,
    /// When the last input came, show clock.
    last: Instant,
    senders: Senders,
    pub digest: OutputDigest,
    /// Kinds of outputs that were taken since the last input, as bits of `OutputKinds`.
    pub taken: u8,
}

impl Recording {
    /// Begins a log at `now`. `notes`: names and values for people; `checkpoint`: bytes of the controller at rest.
    pub fn begin(now: Instant, notes: Vec<(String, String)>, checkpoint: Vec<u8>) -> Self {
        let mut ready = MAGIC.to_vec();
        ready.extend_from_slice(&VERSION.to_le_bytes());
        let program = env!("CARGO_PKG_VERSION").to_owned();
        let header = LogHeader { program, notes, began_us: now.0, checkpoint };
        append_block(&mut ready, &bytes_of(&header));
        Self {
            ready,
            open: Vec::new(),
            open_since: now,
            last: now,
            senders: Senders::default(),
            digest: OutputDigest::default(),
            taken: 0,
        }
    }

    /// Appends an input. `record` returns the input's record for the time since the last input.
    pub fn input<'r>(&mut self, now: Instant, record: impl FnOnce(Span) -> Record<'r>) {
        let after = self.advance(now);
        self.append(&record(after));
    }

    /// Appends a message. Of a robot's payload only the part is stored that differs from the robot's last payload on
    /// this topic, if that is remembered.
    pub fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        let after = self.advance(now);
        let topic_of_robots = match Topic::parse(topic) {
            Some(Topic::Uuid) => RobotTopic::Uuid,
            Some(Topic::Arrival) => RobotTopic::Arrival,
            Some(Topic::Status) => RobotTopic::Status,
            Some(Topic::Time) => RobotTopic::Time,
            _ => return self.append(&Record::OtherMessage { after, topic, payload }),
        };
        let Likeness { like, front, back } = self.senders.compare(topic_of_robots, payload);
        let middle = &payload[front.into()..payload.len() - usize::from(back)];
        self.append(&Record::Message { after, topic: topic_of_robots, like, front, back, middle });
    }

    /// Ends the log: appends the digest of all outputs and closes the block.
    pub fn end(&mut self) {
        self.outputs();
        self.append(&Record::End { digest: self.digest.value() });
        self.close_block();
    }

    /// Takes the bytes that are ready since the last call: whole blocks, and the head at first.
    pub fn take(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.ready)
    }

    /// Prepares for an input. Records which outputs were taken since the last input, and closes the open block if it is
    /// long enough. Returns the time since the last input.
    fn advance(&mut self, now: Instant) -> Span {
        self.outputs();
        if self.open.len() >= BLOCK_BYTES || now - self.open_since >= BLOCK_LASTS {
            self.close_block();
            self.open_since = now;
        }
        let after = now - self.last;
        self.last = now;
        after
    }

    fn outputs(&mut self) {
        let taken = std::mem::take(&mut self.taken);
        if taken != 0 {
            let [a, b, ..] = self.digest.value().to_le_bytes();
            self.append(&Record::Outputs { taken, digest: [a, b] });
        }
    }

    fn append(&mut self, record: &Record<'_>) {
        let open = std::mem::take(&mut self.open);
        // Cannot fail: a vector takes any bytes, and every record can be written.
        self.open = postcard::to_extend(record, open).unwrap_or_default();
    }

    fn close_block(&mut self) {
        if !self.open.is_empty() {
            append_block(&mut self.ready, &self.open);
            self.open.clear();
        }
    }
}

fn bytes_of(header: &LogHeader) -> Vec<u8> {
    postcard::to_allocvec(header).unwrap_or_default()
}

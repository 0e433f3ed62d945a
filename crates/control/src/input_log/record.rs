//! Records of a log.

use crate::journal::{OnReturn, UnfinishedRun};
use crate::operation::Operation;
use lightbots_base::Span;
use serde::{Deserialize, Serialize};

/// One input, or what was taken after one. Times count from the record before.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Record<'a> {
    /// Time passed.
    Wake(Span),
    /// A robot's message. Its payload is like that of an earlier message but for its middle.
    Message {
        after: Span,
        topic: RobotTopic,
        /// Number of the earlier message's sender, counted from 1; 0: like none.
        like: u32,
        /// Bytes that both payloads begin with.
        front: u16,
        /// Bytes that both payloads end with.
        back: u16,
        middle: &'a [u8],
    },
    /// Another message.
    OtherMessage { after: Span, topic: &'a str, payload: &'a [u8] },
    /// The broker is connected.
    Connected(Span),
    /// The broker is lost.
    Disconnected(Span),
    /// The operator asked for something.
    Operation { after: Span, operation: Operation },
    /// The plan of a request was made.
    Planned {
        after: Span,
        number: u64,
        /// At which question the planner was cancelled, counted from 1; 0: it was not.
        cancelled_at: u64,
    },
    /// Outputs were taken: of which kinds ([`OutputKinds`]), and the last bytes of the digest of all outputs so far.
    Outputs { taken: u8, digest: [u8; 2] },
    /// A run that was cut off was taken up.
    TakeUp { after: Span, run: Box<UnfinishedRun>, on_return: OnReturn },
    /// The log ends here, with this digest of all outputs.
    End { digest: u64 },
}

/// Topics of messages from robots.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub(crate) enum RobotTopic {
    Uuid,
    Arrival,
    Status,
    Time,
}

/// Kinds of outputs, as bits.
pub(crate) struct OutputKinds;

impl OutputKinds {
    pub const SENDS: u8 = 1;
    pub const EVENTS: u8 = 2;
    pub const REQUESTS: u8 = 4;
    pub const ANSWER: u8 = 8;
}

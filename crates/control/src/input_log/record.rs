//! Records of a log.

use crate::journal::{OnReturn, UnfinishedRun};
use crate::operation::Operation;
use lightbots_base::Span;
use serde::{Deserialize, Serialize};

/// One input, or the outputs that were taken after one. Each `after` is the time since the input before.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Record<'a> {
    /// A call of `wake`: time passed.
    Wake(Span),
    /// A robot's message. Its payload has the front and the back of an earlier payload.
    Message {
        after: Span,
        topic: RobotTopic,
        /// Number of the earlier payload in the list of `senders`, counted from 1; 0 if there is none.
        like: u32,
        /// Number of bytes with which both payloads begin.
        front: u16,
        /// Number of bytes with which both payloads end.
        back: u16,
        middle: &'a [u8],
    },
    /// A message on another topic.
    OtherMessage { after: Span, topic: &'a str, payload: &'a [u8] },
    /// The broker is connected.
    Connected(Span),
    /// The broker is lost.
    Disconnected(Span),
    /// The operator requested an operation.
    Operation { after: Span, operation: Operation },
    /// The plan of a request was made.
    Planned {
        after: Span,
        number: u64,
        /// Number of the planner's check at which it was cancelled, counted from 1; 0 if it was not.
        cancelled_at: u64,
    },
    /// Outputs of these kinds ([`OutputKinds`]) were taken. `digest`: the two lowest bytes of the digest of all outputs
    /// up to then.
    Outputs { taken: u8, digest: [u8; 2] },
    /// A run that was cut off was taken up.
    TakeUp { after: Span, run: Box<UnfinishedRun>, on_return: OnReturn },
    /// The log ends here; `digest` is that of all outputs.
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

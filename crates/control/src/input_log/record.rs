//! Records of a log.

use crate::journal::{OnReturn, UnfinishedRun};
use crate::operation::Operation;
use lightbots_base::Span;
use serde::{Deserialize, Serialize};

/// One input, the outputs that were taken after an input, or the end of the log. `after`, and the only value of `Wake`,
/// `Connected` and `Disconnected`, is the time since the input before.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) enum Record<'a> {
    /// A call of `wake`: time passed.
    Wake(Span),
    /// A message on one of the topics of robots. Its payload consists of the first `front` bytes of an earlier payload,
    /// `middle`, and the last `back` bytes of the earlier payload.
    Message {
        after: Span,
        topic: RobotTopic,
        /// Number of the earlier payload in the list of `Senders`, counted from 1; 0 if the payload is compared with
        /// none, and `middle` is the whole payload.
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
        /// Number of the planner's check at which planning was cancelled, counted from 1; 0 if it was not cancelled.
        cancelled_at: u64,
    },
    /// Outputs were taken. `taken`: bits of their kinds ([`OutputKinds`]). `digest`: the two lowest bytes of the digest
    /// of all outputs until then.
    Outputs { taken: u8, digest: [u8; 2] },
    /// The controller took up a run that was cut off when its former controller ended.
    TakeUp { after: Span, run: Box<UnfinishedRun>, on_return: OnReturn },
    /// The log ends here. `digest`: the digest of all outputs.
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
    /// Messages to robots were taken.
    pub const SENDS: u8 = 1;
    /// Events were taken.
    pub const EVENTS: u8 = 2;
    /// Plan requests were taken.
    pub const REQUESTS: u8 = 4;
    /// An operation, or the taking up of a run, was answered.
    pub const ANSWER: u8 = 8;
}

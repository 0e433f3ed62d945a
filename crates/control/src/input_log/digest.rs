//! A digest of all outputs of a controller.

use crate::event::Event;
use crate::operation::Refusal;
use crate::outbox::Send;
use crate::plan_request::PlanRequest;
use lightbots_base::StateHash;
use std::fmt::Write;

/// One hash for each kind of output. The hashes are separate, because a program may take the kinds of outputs in any
/// order.
#[derive(Clone, Debug, Default)]
pub(crate) struct OutputDigest {
    sends: StateHash,
    events: StateHash,
    requests: StateHash,
    answers: StateHash,
    text: String,
}

impl OutputDigest {
    /// Adds a message that was taken.
    pub fn send(&mut self, send: &Send) {
        self.sends.bytes(send.topic.write().as_bytes());
        self.sends.bytes(&send.payload);
    }

    /// Adds an event that was taken.
    pub fn event(&mut self, event: &Event) {
        self.text.clear();
        // Cannot fail: a string takes any text.
        let _ = write!(self.text, "{event:?}");
        self.events.bytes(self.text.as_bytes());
    }

    /// Adds a plan request that was taken.
    pub fn request(&mut self, request: &PlanRequest) {
        request.imprint(&mut self.requests);
    }

    /// Adds the answer to an operation.
    pub fn answer(&mut self, answer: &Result<(), Refusal>) {
        self.text.clear();
        let _ = write!(self.text, "{answer:?}");
        self.answers.bytes(self.text.as_bytes());
    }

    /// Returns the digest of all outputs that were added.
    pub fn value(&self) -> u64 {
        let mut all = StateHash::new();
        for part in [self.sends, self.events, self.requests, self.answers] {
            all.word(part.finish());
        }
        all.finish()
    }
}

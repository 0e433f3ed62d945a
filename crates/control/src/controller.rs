//! The controller's ways in and out; each concern has a file of its own.

use crate::config::Config;
use crate::drafting::{Done, Job};
use crate::event::Event;
use crate::operation::{Operation, Refusal};
use crate::outbox::Send;
use crate::snapshot::Snapshot;
use lightbots_base::Instant;

/// A controller of one fleet. Ways in: [`message`](Self::message), [`operate`](Self::operate),
/// [`connected`](Self::connected), [`disconnected`](Self::disconnected), [`wake`](Self::wake),
/// [`planned`](Self::planned), each with `now`, which *is* the show clock and never goes back. After each of them
/// drain [`next_send`](Self::next_send), [`next_event`](Self::next_event) and [`next_job`](Self::next_job), and
/// wake at [`wake_at`](Self::wake_at).
#[derive(Debug)]
pub struct Controller {
    config: Config,
}

impl Controller {
    /// A controller that knows nobody yet.
    pub fn new(config: Config) -> Self {
        Self { config }
    }

    /// The broker is there and the topics are subscribed (`T/LightBot/UUID`, `Arrival`, `Status`, `Time`).
    pub fn connected(&mut self, _now: Instant) {}

    /// The broker is lost.
    pub fn disconnected(&mut self, _now: Instant) {}

    /// A message came. Junk is counted and dropped.
    pub fn message(&mut self, _now: Instant, _topic: &str, _payload: &[u8]) {}

    /// The operator wants something.
    pub fn operate(&mut self, _now: Instant, _operation: Operation) -> Result<(), Refusal> {
        Err(Refusal::NotConnected)
    }

    /// Time passed.
    pub fn wake(&mut self, _now: Instant) {}

    /// A job is done. Answers to jobs that are not wanted any more are dropped.
    pub fn planned(&mut self, _now: Instant, _done: Done) {}

    /// The next message to publish (QoS 0, not retained).
    pub fn next_send(&mut self) -> Option<Send> {
        None
    }

    /// The next thing that happened.
    pub fn next_event(&mut self) -> Option<Event> {
        None
    }

    /// The next plan to be made. At most one is wanted at a time; a newer one makes an older one needless.
    pub fn next_job(&mut self) -> Option<Job> {
        None
    }

    /// When to call [`wake`](Self::wake) next.
    pub fn wake_at(&self) -> Option<Instant> {
        None
    }

    /// How everything is.
    pub fn snapshot(&self, now: Instant) -> Snapshot {
        Snapshot { at: now, ..Snapshot::default() }
    }

    /// What the controller was told at its start.
    pub fn config(&self) -> &Config {
        &self.config
    }
}

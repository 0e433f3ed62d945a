//! Replays the blocks of a log.

use super::digest::OutputDigest;
use super::record::{OutputKinds, Record, RobotTopic};
use super::senders::{Likeness, Senders};
use super::{LogHeader, MAGIC, VERSION};
use crate::controller::Controller;
use crate::event::Event;
use crate::mutant::Mutant;
use crate::outbox::Send;
use crate::plan_request::{PlanRequest, PlanResult};
use core::fmt;
use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;
use std::collections::BTreeMap;

/// Largest number of plan requests that wait for their plans; above it the oldest are dropped. A program around the
/// controller makes one plan at a time, so a sound log needs few.
const REQUESTS_MAX: usize = 64;

/// Length of the head of a log, bytes: 8 magic bytes and 2 bytes of version.
pub const HEAD_BYTES: usize = MAGIC.len() + 2;

/// Why bytes cannot be replayed as a log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LogError {
    /// The bytes are no log.
    NoLog,
    /// The bytes are a log in another version of the format, which is named here.
    OtherVersion(u16),
    /// The first block, which holds the header, is not whole or not valid.
    NoHeader,
    /// A record is not valid, although the checksum of its block is right.
    BadRecord {
        /// Number of inputs that were replayed before this record or its block.
        inputs: u64,
    },
}

/// Where a log ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogEnd {
    /// At the record `End`, which the writer appends to a whole log.
    Complete,
    /// Without the record `End`: the writer was killed, or bytes were cut off or changed. Holds the number of bytes up
    /// to the end of the last whole block that was read.
    Cut(u64),
    /// Unknown, because the replay stopped at a difference and read no further.
    NotReached,
}

/// The first place where a replay had other outputs than the recorded controller.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Number of the input after which the outputs differ, counted from 1; 0 if they differ before the first input.
    pub input: u64,
    /// Moment of this input, show clock.
    pub at: Instant,
    /// Description of this input, for people.
    pub what: String,
    /// At most five outputs of the replay after this input, for people; may be empty.
    pub outputs: Vec<String>,
}

/// The result of a replay.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReplayReport {
    /// Version of the program that wrote the log.
    pub program: String,
    /// Notes of the writer: names and values.
    pub notes: Vec<(String, String)>,
    /// Number of inputs that were replayed.
    pub inputs: u64,
    /// Number of replayed messages.
    pub messages: u64,
    /// Number of plan results that were replayed. Their plans were made again, except those that were no longer wanted.
    pub plans: u64,
    /// Number of messages, events and plan requests of the replay that were compared with the log.
    pub outputs: u64,
    /// Number of robots that the replayed controller knew at the end.
    pub robots: usize,
    /// Time from the beginning of the log to the last replayed input, show clock.
    pub lasted: Span,
    /// Digest of all outputs of the replay.
    pub digest: u64,
    /// Where the log ends.
    pub end: LogEnd,
    /// The first difference; `None`: all outputs are the same to the bit.
    pub difference: Option<Difference>,
}

/// One step of a replay, for an observer.
#[derive(Clone, Copy, Debug)]
pub enum ReplayStep<'a> {
    /// A message is about to be received.
    Message {
        /// Its topic.
        topic: &'a str,
        /// Its payload.
        payload: &'a [u8],
    },
    /// An input that is neither a message nor the passing of time is about to be handled. Holds its description for
    /// people.
    Input(&'a str),
    /// The controller sent this message.
    Sent(&'a Send),
    /// The controller recorded this event.
    Event(&'a Event),
    /// The controller has handled a call of `wake`.
    Woken,
}

/// A function that is called for each step of a replay, with the show clock and the controller at that moment.
pub type ReplayObserver<'o> = dyn FnMut(Instant, &Controller, ReplayStep<'_>) + 'o;

/// Checks that this program can replay a log that begins with `head`: at least the first [`HEAD_BYTES`] bytes of the
/// log.
pub fn check_head(head: &[u8]) -> Result<(), LogError> {
    let rest = head.strip_prefix(MAGIC).ok_or(LogError::NoLog)?;
    let (version, _) = rest.split_first_chunk().ok_or(LogError::NoLog)?;
    match u16::from_le_bytes(*version) {
        VERSION => Ok(()),
        version => Err(LogError::OtherVersion(version)),
    }
}

/// A log that is being replayed.
#[derive(Debug)]
pub(super) struct Replay {
    header: LogHeader,
    controller: Controller,
    now: Instant,
    senders: Senders,
    requests: BTreeMap<u64, PlanRequest>,
    digest: OutputDigest,
    inputs: u64,
    messages: u64,
    plans: u64,
    outputs: u64,
    /// Description of the last input, for people.
    last: String,
    is_complete: bool,
    difference: Option<Difference>,
}

impl Replay {
    /// Begins a replay with the content of the first block of a log; `None` if it is no valid header.
    pub fn new(block: &[u8]) -> Option<Self> {
        let header: LogHeader = postcard::from_bytes(block).ok()?;
        Some(Self {
            controller: Controller::from_checkpoint(&header.checkpoint)?,
            now: Instant(header.began_us),
            header,
            senders: Senders::default(),
            requests: BTreeMap::new(),
            digest: OutputDigest::default(),
            inputs: 0,
            messages: 0,
            plans: 0,
            outputs: 0,
            last: String::new(),
            is_complete: false,
            difference: None,
        })
    }

    /// Whether the replay is over: the log has ended, or an output differed. Further blocks are then ignored.
    pub fn is_over(&self) -> bool {
        self.is_complete || self.difference.is_some()
    }

    /// Replays the records of a block.
    pub fn block(&mut self, mut block: &[u8], observe: &mut ReplayObserver<'_>) -> Result<(), LogError> {
        while !block.is_empty() && !self.is_over() {
            let bad = LogError::BadRecord { inputs: self.inputs };
            let Ok((record, rest)) = postcard::take_from_bytes(block) else { return Err(bad) };
            self.record(record, observe).ok_or(bad)?;
            block = rest;
        }
        Ok(())
    }

    /// Replays one record; `None` if the record is not valid, so that no writer can have written it.
    fn record(&mut self, record: Record<'_>, observe: &mut ReplayObserver<'_>) -> Option<()> {
        match record {
            Record::Wake(after) => {
                self.input(after, || "time passed".into());
                self.now += Span(i64::from(Mutant::ReplayOffByOne.is_planted()));
                self.controller.wake(self.now);
                observe(self.now, &self.controller, ReplayStep::Woken);
            }
            Record::Message { after, topic, like, front, back, middle } => {
                let payload = self.senders.restore(topic, Likeness { like, front, back }, middle)?;
                let topic = match topic {
                    RobotTopic::Uuid => Topic::Uuid,
                    RobotTopic::Arrival => Topic::Arrival,
                    RobotTopic::Status => Topic::Status,
                    RobotTopic::Time => Topic::Time,
                };
                self.message((after, &topic.write(), &payload), observe);
            }
            Record::OtherMessage { after, topic, payload } => self.message((after, topic, payload), observe),
            Record::Connected(after) => {
                self.other_input(after, || "the broker was connected".into(), observe);
                self.controller.connected(self.now);
            }
            Record::Disconnected(after) => {
                self.other_input(after, || "the broker was lost".into(), observe);
                self.controller.disconnected(self.now);
            }
            Record::Operation { after, operation } => {
                self.other_input(after, || operation.name().into(), observe);
                let answer = self.controller.operate(self.now, operation);
                self.digest.answer(&answer);
            }
            Record::TakeUp { after, run, on_return } => {
                let run = Some(run).filter(|run| run.is_sound())?;
                self.other_input(after, || "a run was taken up".into(), observe);
                let answer = self.controller.take_up(self.now, &run, on_return);
                self.digest.answer(&answer);
            }
            Record::Planned { after, number, cancelled_at } => {
                self.other_input(after, || format!("plan {number} was made"), observe);
                self.planned(number, cancelled_at);
            }
            Record::Outputs { taken, digest } => self.compare(taken, digest, observe),
            Record::End { digest } => {
                self.is_complete = true;
                if digest != self.digest.value() {
                    self.differs(Vec::new());
                }
            }
        }
        Some(())
    }

    fn input(&mut self, after: Span, what: impl FnOnce() -> String) {
        self.now += after;
        self.inputs += 1;
        self.last = what();
    }

    /// Notes an input that is neither a message nor the passing of time, and calls the observer.
    fn other_input(&mut self, after: Span, what: impl FnOnce() -> String, observe: &mut ReplayObserver<'_>) {
        self.input(after, what);
        observe(self.now, &self.controller, ReplayStep::Input(&self.last));
    }

    fn message(&mut self, (after, topic, payload): (Span, &str, &[u8]), observe: &mut ReplayObserver<'_>) {
        self.messages += 1;
        self.input(after, String::new);
        self.last.clear();
        self.last.push_str(topic);
        self.last.push(' ');
        self.last.push_str(&String::from_utf8_lossy(&payload[..payload.len().min(200)]));
        observe(self.now, &self.controller, ReplayStep::Message { topic, payload });
        self.controller.message(self.now, topic, payload);
    }

    fn planned(&mut self, number: u64, cancelled_at: u64) {
        let request = self.requests.remove(&number);
        self.requests = self.requests.split_off(&number);
        // A plan that was requested before the log began is not made: the controller does not wait for it.
        let result =
            request.map_or_else(|| PlanResult::unwanted(number), |request| again(request, cancelled_at));
        self.plans += 1;
        self.controller.planned(self.now, result);
    }

    /// Takes outputs of the recorded kinds (`taken`), as the program around the recorded controller did. Then compares
    /// the digest of all outputs until now with the recorded `digest`.
    fn compare(&mut self, taken: u8, digest: [u8; 2], observe: &mut ReplayObserver<'_>) {
        let mut lines = Vec::new();
        let mut line = |text: &dyn Fn() -> String| {
            if lines.len() < 5 {
                lines.push(text());
            }
        };
        if taken & OutputKinds::SENDS != 0 {
            while let Some(send) = self.controller.next_send() {
                observe(self.now, &self.controller, ReplayStep::Sent(&send));
                self.digest.send(&send);
                self.outputs += 1;
                line(&|| format!("{} {}", send.topic.write(), String::from_utf8_lossy(&send.payload)));
            }
        }
        if taken & OutputKinds::EVENTS != 0 {
            while let Some(event) = self.controller.next_event() {
                observe(self.now, &self.controller, ReplayStep::Event(&event));
                self.digest.event(&event);
                self.outputs += 1;
                line(&|| event.kind.to_string());
            }
        }
        if taken & OutputKinds::REQUESTS != 0 {
            while let Some(request) = self.controller.next_plan_request() {
                self.digest.request(&request);
                self.outputs += 1;
                line(&|| format!("plan {} is wanted", request.number));
                self.requests.insert(request.number, request);
            }
            while self.requests.len() > REQUESTS_MAX {
                self.requests.pop_first();
            }
        }
        let value = self.digest.value().to_le_bytes();
        if value[..2] != digest {
            self.differs(lines);
        }
    }

    fn differs(&mut self, outputs: Vec<String>) {
        let what = std::mem::take(&mut self.last);
        self.difference = Some(Difference { input: self.inputs, at: self.now, what, outputs });
    }

    /// Ends the replay and returns its report; `at`: number of bytes of the log that were read.
    pub fn report(self, at: usize) -> ReplayReport {
        ReplayReport {
            program: self.header.program,
            notes: self.header.notes,
            inputs: self.inputs,
            messages: self.messages,
            plans: self.plans,
            outputs: self.outputs,
            robots: self.controller.robots(),
            lasted: self.now - Instant(self.header.began_us),
            digest: self.digest.value(),
            end: match (self.is_complete, &self.difference) {
                (true, _) => LogEnd::Complete,
                (false, None) => LogEnd::Cut(at as u64),
                (false, Some(_)) => LogEnd::NotReached,
            },
            difference: self.difference,
        }
    }
}

/// Makes the plan of a request again. `cancelled_at`: number of the planner's check, counted from 1, at which it is
/// cancelled; 0: it is not cancelled.
fn again(request: PlanRequest, cancelled_at: u64) -> PlanResult {
    let asked = core::cell::Cell::new(0);
    request.run_unless(&|| {
        asked.set(asked.get() + 1);
        cancelled_at > 0 && asked.get() >= cancelled_at
    })
}

impl fmt::Display for LogError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoLog => write!(f, "it is no recorded run"),
            Self::OtherVersion(version) => {
                write!(f, "it was recorded in format {version}, and this program replays format {VERSION}")
            }
            Self::NoHeader => write!(f, "its beginning is missing or damaged"),
            Self::BadRecord { inputs } => write!(f, "what follows input {inputs} makes no sense"),
        }
    }
}

impl std::error::Error for LogError {}

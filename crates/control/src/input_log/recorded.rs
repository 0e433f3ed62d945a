//! A controller whose inputs are recorded.

use super::record::{OutputKinds, Record};
use super::recording::Recording;
use crate::computer_time::ComputerTime;
use crate::controller::Controller;
use crate::event::Event;
use crate::journal::{JournalPiece, OnReturn, UnfinishedRun};
use crate::operation::{Operation, Refusal};
use crate::outbox::Send;
use crate::plan_request::{PlanRequest, PlanResult};
use lightbots_base::Instant;
use std::ops::Deref;

/// A [`Controller`] that writes a log of its inputs, once a log was begun. It has all inputs and outputs of a
/// controller, and dereferences to it. Take outputs of a kind until `None` is returned, because a replay does so.
#[derive(Debug)]
pub struct RecordedController {
    controller: Controller,
    recording: Option<Recording>,
}

impl Deref for RecordedController {
    type Target = Controller;

    fn deref(&self) -> &Controller {
        &self.controller
    }
}

impl RecordedController {
    /// Returns a controller without a log.
    pub fn new(controller: Controller) -> Self {
        Self { controller, recording: None }
    }

    /// Drops the present log, with its bytes that were not taken, and begins a new one. `notes`: names and values for
    /// people. During a run, while robots are being stopped, and if outputs wait to be taken, no new log begins. The
    /// present one is dropped even then, and the result is `false`.
    pub fn begin_log(&mut self, now: Instant, notes: Vec<(String, String)>) -> bool {
        let checkpoint = self.controller.checkpoint();
        self.recording = checkpoint.map(|checkpoint| Recording::begin(now, notes, checkpoint));
        self.recording.is_some()
    }

    /// Whether a log is being written.
    pub fn is_recording(&self) -> bool {
        self.recording.is_some()
    }

    /// Takes the bytes that are ready since the last call, to append to the log's file; may be empty.
    pub fn take_log(&mut self) -> Vec<u8> {
        self.recording.as_mut().map(Recording::take).unwrap_or_default()
    }

    /// Ends the log and returns its last bytes; empty if there is no log.
    pub fn end_log(&mut self) -> Vec<u8> {
        let Some(mut recording) = self.recording.take() else { return Vec::new() };
        recording.end();
        recording.take()
    }

    /// Keeps a journal of each run from now on, as [`Controller::keep_journal`] does. This is not recorded.
    pub fn keep_journal(&mut self) {
        self.controller.keep_journal();
    }

    /// Returns the next piece for the journal's file, as [`Controller::take_journal`] does. This is not recorded.
    pub fn take_journal(&mut self, clocks: ComputerTime) -> Option<JournalPiece> {
        self.controller.take_journal(clocks)
    }

    /// Makes the next piece of the journal a whole journal, as [`Controller::begin_journal_again`] does. This is not
    /// recorded.
    pub fn begin_journal_again(&mut self) {
        self.controller.begin_journal_again();
    }

    /// Records that the broker is connected, and handles it as [`Controller::connected`] does.
    pub fn connected(&mut self, now: Instant) {
        self.record(now, Record::Connected);
        self.controller.connected(now);
    }

    /// Records that the broker is lost, and handles it as [`Controller::disconnected`] does.
    pub fn disconnected(&mut self, now: Instant) {
        self.record(now, Record::Disconnected);
        self.controller.disconnected(now);
    }

    /// Records a message, and handles it as [`Controller::message`] does.
    pub fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        if let Some(recording) = &mut self.recording {
            recording.message(now, topic, payload);
        }
        self.controller.message(now, topic, payload);
    }

    /// Records an operation and its answer, and carries it out as [`Controller::operate`] does.
    pub fn operate(&mut self, now: Instant, operation: Operation) -> Result<(), Refusal> {
        if let Some(recording) = &mut self.recording {
            let operation = operation.clone();
            recording.input(now, |after| Record::Operation { after, operation });
        }
        let answer = self.controller.operate(now, operation);
        self.answered(&answer);
        answer
    }

    /// Records that a run is taken up, and takes it up as [`Controller::take_up`] does.
    pub fn take_up(
        &mut self,
        now: Instant,
        unfinished: &UnfinishedRun,
        on_return: OnReturn,
    ) -> Result<(), Refusal> {
        if let Some(recording) = &mut self.recording {
            let run = Box::new(unfinished.clone());
            recording.input(now, |after| Record::TakeUp { after, run, on_return });
        }
        let answer = self.controller.take_up(now, unfinished, on_return);
        self.answered(&answer);
        answer
    }

    fn answered(&mut self, answer: &Result<(), Refusal>) {
        if let Some(recording) = &mut self.recording {
            recording.digest.answer(answer);
            recording.taken |= OutputKinds::ANSWER;
        }
    }

    /// Records that time passed, and does what is due as [`Controller::wake`] does.
    pub fn wake(&mut self, now: Instant) {
        self.record(now, Record::Wake);
        self.controller.wake(now);
    }

    /// Records that a plan was made, but not the plan itself, and handles it as [`Controller::planned`] does.
    pub fn planned(&mut self, now: Instant, result: PlanResult) {
        let (number, cancelled_at) = (result.number, result.cancelled_at.unwrap_or(0));
        self.record(now, |after| Record::Planned { after, number, cancelled_at });
        self.controller.planned(now, result);
    }

    /// Takes the next message to publish as [`Controller::next_send`] does, and adds it to the digest of the log, if
    /// there is one.
    pub fn next_send(&mut self) -> Option<Send> {
        let send = self.controller.next_send()?;
        if let Some(recording) = &mut self.recording {
            recording.digest.send(&send);
            recording.taken |= OutputKinds::SENDS;
        }
        Some(send)
    }

    /// Takes the next event as [`Controller::next_event`] does, and adds it to the digest of the log, if there is one.
    pub fn next_event(&mut self) -> Option<Event> {
        let event = self.controller.next_event()?;
        if let Some(recording) = &mut self.recording {
            recording.digest.event(&event);
            recording.taken |= OutputKinds::EVENTS;
        }
        Some(event)
    }

    /// Takes the next plan request as [`Controller::next_plan_request`] does, and adds it to the digest of the log, if
    /// there is one.
    pub fn next_plan_request(&mut self) -> Option<PlanRequest> {
        let request = self.controller.next_plan_request()?;
        if let Some(recording) = &mut self.recording {
            recording.digest.request(&request);
            recording.taken |= OutputKinds::REQUESTS;
        }
        Some(request)
    }

    fn record(&mut self, now: Instant, record: impl FnOnce(lightbots_base::Span) -> Record<'static>) {
        if let Some(recording) = &mut self.recording {
            recording.input(now, record);
        }
    }
}

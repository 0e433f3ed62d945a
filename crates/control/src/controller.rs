//! The inputs and outputs of the controller.

use crate::clock;
use crate::computer_time::ComputerTime;
use crate::config::Config;
use crate::context::Context;
use crate::event::{Event, EventKind, RunOutcome};
use crate::journal::{Journal, JournalPiece};
use crate::operation::ControllerState;
use crate::outbox::Send;
use crate::plan_request::{PlanRequest, PlanResult};
use crate::preflight::PreflightReport;
use crate::run::{Run, RunPhase, RunPurpose};
use crate::snapshot::{Age, Counters};
use crate::stopping::{self, Stopping};
use lightbots_base::{Instant, RobotId, Span};
use lightbots_show::Show;
use lightbots_wire::{Command, Report, TimeQuestion, Topic};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Time between two updates of report ages. Each update covers one slice of the fleet.
const PATROL: Span = Span::from_millis(250);
/// Largest number of updates that cover the whole fleet: the age of each robot's last report is updated at least every
/// 2 s.
const ROUNDS: usize = 8;
/// Least time between two requests to all robots to report, between runs, if some robots have the original firmware.
/// Without repeated requests a robot stays unknown if its first report is lost, and others would drive into it.
const ASK_ALL: Span = Span::from_millis(600);
/// Time added to [`ASK_ALL`] for each robot, because all answers share one link.
const ASK_ALL_PER_ROBOT: Span = Span::from_millis(1);
/// A robot with the original firmware is asked to report after a silence of
/// [`Ageing::stale_after`](crate::Ageing::stale_after) divided by this number.
const ASK_AFTER: i64 = 2;

/// The controller of one fleet. Its inputs are [`message`](Self::message), [`operate`](Self::operate),
/// [`connected`](Self::connected), [`disconnected`](Self::disconnected), [`wake`](Self::wake),
/// [`planned`](Self::planned) and [`take_up`](Self::take_up). Each input takes `now`, which *is* the show clock and
/// must never go back. After each input, call [`next_send`](Self::next_send), [`next_event`](Self::next_event) and
/// [`next_plan_request`](Self::next_plan_request) until each returns `None`. Call `wake` at the moment that
/// [`wake_at`](Self::wake_at) returns.
#[derive(Debug, Serialize, Deserialize)]
pub struct Controller {
    pub(crate) context: Context,
    #[serde(with = "crate::shared_show::optional")]
    pub(crate) show: Option<Arc<Show>>,
    pub(crate) looping: bool,
    /// Speed of drives of all later runs except preflights, percent of the usual speed.
    pub(crate) speed_percent: u32,
    #[serde(skip)]
    pub(crate) run: Option<Run>,
    #[serde(skip)]
    pub(crate) stopping: Option<Stopping>,
    /// Where and why the last run failed, for people. Kept until the operator dismisses the message or begins another
    /// run.
    pub(crate) failure: Option<String>,
    /// The frame in which the last run of a show failed or was aborted, counted from 0. Kept until the operator
    /// dismisses the message, begins another run, or opens a show of another name.
    pub(crate) stopped_in: Option<usize>,
    /// Whether all robots are to be stopped once the broker is connected: the broker was lost while robots were being
    /// stopped, the run ended without a broker, or the run of a journal does not go on.
    pub(crate) stops_when_connected: bool,
    /// What the last preflight found; `None` if there was none, or one is under way.
    #[serde(skip)]
    pub(crate) preflight: Option<Arc<PreflightReport>>,
    #[serde(skip)]
    pub(crate) journal: Journal,
    said: ControllerState,
    patrol_at: Instant,
    ask_all_at: Instant,
    woken: Instant,
    received: u64,
    junk: u64,
}

impl Controller {
    /// Returns a controller that knows no robot yet.
    pub fn new(config: Config) -> Self {
        Self {
            context: Context::new(config),
            show: None,
            looping: false,
            speed_percent: 100,
            run: None,
            stopping: None,
            failure: None,
            stopped_in: None,
            stops_when_connected: false,
            preflight: None,
            journal: Journal::default(),
            said: ControllerState::Idle,
            patrol_at: Instant::ZERO,
            ask_all_at: Instant::ZERO,
            woken: Instant::ZERO,
            received: 0,
            junk: 0,
        }
    }

    /// Handles that the broker is connected, and asks all robots to report. If a stop of all robots is due, begins it
    /// first. Does nothing if the broker is connected already. The caller must have subscribed to `UUID`, `Arrival`,
    /// `Status` and `Time` under `T/LightBot/`.
    pub fn connected(&mut self, now: Instant) {
        if self.context.outbox.linked() {
            return;
        }
        self.context.outbox.link(true);
        self.context.log.record(now, EventKind::Connected);
        // STOP goes first: a robot that receives any other message turns towards the route that it keeps.
        if std::mem::take(&mut self.stops_when_connected) {
            self.stopping = Some(Stopping::begin_unplaced(&mut self.context, now, None));
        }
        self.refresh(now);
        self.conclude(now);
    }

    /// Handles that the connection to the broker is lost. Does nothing if the broker is not connected.
    pub fn disconnected(&mut self, now: Instant) {
        if !self.context.outbox.linked() {
            return;
        }
        self.context.outbox.link(false);
        self.context.log.record(now, EventKind::Disconnected);
        // A STOP that was being sent may be lost with the broker: it is sent again later.
        self.stops_when_connected |= self.stopping.take().is_some();
        if let Some(run) = &mut self.run {
            run.on_disconnect(&mut self.context, now);
        }
        self.conclude(now);
    }

    /// Handles a message. A message that cannot be read is counted and dropped, and so is one of a robot that sends too
    /// many.
    pub fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        self.received += 1;
        match Topic::parse(topic) {
            Some(Topic::Time) => match TimeQuestion::decode(payload) {
                Some(question) if !self.counts(now, question.id) => {}
                Some(question) => {
                    self.context.fleet.observe_clock(now, question, &mut self.context.log);
                    clock::answer(now, question, &mut self.context.outbox);
                }
                None => self.junk += 1,
            },
            Some(topic @ (Topic::Uuid | Topic::Arrival | Topic::Status)) => match Report::decode(payload) {
                Some(report) if !self.counts(now, report.id) => {}
                Some(report) => self.receive(now, topic, &report),
                None => self.junk += 1,
            },
            // Commands of this controller, which the broker returns, or of another controller.
            Some(Topic::Broadcast | Topic::Robot(_)) => {}
            None => self.junk += 1,
        }
    }

    /// Whether a message of a robot is to be handled. Messages above the allowed rate are ignored.
    fn counts(&mut self, now: Instant, id: RobotId) -> bool {
        self.context.fleet.counts(now, id, &mut self.context.log)
    }

    fn receive(&mut self, now: Instant, topic: Topic, report: &Report) {
        let context = &mut self.context;
        let Some(received) = context.fleet.receive(now, report, &context.config, &mut context.log) else {
            return;
        };
        if received.found && topic == Topic::Arrival {
            context.report_unexpected(now, report);
        }
        if let Some(stopping) = &mut self.stopping {
            stopping.on_report(context, received.index);
        } else if let Some(run) = &mut self.run {
            run.on_report(context, now, received, topic, report);
            self.conclude(now);
        } else {
            stopping::stop_late_comer(context, now, received.index);
            if topic == Topic::Arrival && !received.found {
                context.report_unexpected(now, report);
            }
        }
    }

    /// Asks all robots to report, by a broadcast that is sent twice.
    pub(crate) fn refresh(&mut self, now: Instant) {
        let every = Span::from_millis(500);
        self.context.outbox.broadcast(now, Command::Uuid, 2, every);
    }

    /// Does all timed work that is due at `now`.
    pub fn wake(&mut self, now: Instant) {
        self.woken = now;
        self.context.outbox.tick(now);
        self.context.log.tick(now);
        if now >= self.patrol_at {
            self.patrol_at = now + PATROL;
            self.patrol(now);
        }
        if let Some(stopping) = &mut self.stopping
            && stopping.tick(&mut self.context, now)
        {
            self.stopping = None;
        }
        if let Some(run) = &mut self.run {
            run.on_tick(&mut self.context, now);
        }
        self.conclude(now);
    }

    /// Updates the report ages of the next slice of the fleet. Asks silent robots with the original firmware to report,
    /// because they do not report by themselves. Between runs, if the slice has such a robot, also asks all robots now
    /// and then.
    fn patrol(&mut self, now: Instant) {
        let context = &mut self.context;
        let slice = context.fleet.patrol(now, ROUNDS, &context.config, &mut context.log);
        let patience = context.config.ageing.stale_after / ASK_AFTER;
        let mut has_originals = false;
        for index in slice {
            let robot = context.fleet.robot_mut(index);
            has_originals |= robot.is_original() && robot.contact.age != Age::Gone;
            let due = now - robot.contact.heard >= patience && now - robot.original.asked >= patience;
            if robot.is_original() && due && now - robot.contact.heard < context.config.ageing.gone_after {
                robot.original.asked = now;
                context.send(index, &[Command::Uuid]);
            }
        }
        if has_originals && self.run.is_none() && now >= self.ask_all_at {
            self.ask_all_at = now + ASK_ALL + ASK_ALL_PER_ROBOT * context.fleet.robots().len() as i64;
            context.outbox.send(Topic::Broadcast, &[Command::Uuid]);
        }
    }

    /// Handles the result of a plan request. The result of a request that is no longer wanted is dropped.
    pub fn planned(&mut self, now: Instant, result: PlanResult) {
        if let Some(run) = &mut self.run {
            run.on_plan(&mut self.context, now, result);
        }
        self.conclude(now);
    }

    /// Concludes an input: ends a run that is over, notes changes for the journal, and records an event if the
    /// controller's state changed.
    pub(crate) fn conclude(&mut self, now: Instant) {
        if let Some(Run { phase: RunPhase::Over(outcome, frame), .. }) = &self.run {
            let (outcome, frame) = (outcome.clone(), *frame);
            self.end(now, outcome, frame);
        }
        if let Some(run) = &self.run {
            self.journal.note(now, run, &self.context);
        }
        let state = self.state();
        if state != self.said {
            self.said = state;
            self.context.log.record(now, EventKind::StateChanged(state));
        }
    }

    /// Removes the run, which is over at `frame` (counted from 0) with this outcome. If the run failed and the broker
    /// is connected, begins to stop all robots.
    fn end(&mut self, now: Instant, outcome: RunOutcome, frame: usize) {
        let Some(mut run) = self.run.take() else { return };
        if outcome == RunOutcome::Finished {
            run.end_live_light(&mut self.context, now);
        }
        let is_whole = outcome == RunOutcome::Finished;
        let tested = run.preflight.as_ref().map(|check| check.report(&run.roster, &self.context, is_whole));
        run.leave(&mut self.context);
        let is_show = run.playback.purpose == RunPurpose::Play;
        self.stopped_in = Some(frame).filter(|_| is_show && outcome != RunOutcome::Finished);
        self.context.plan_request = None;
        let outcome = match outcome {
            RunOutcome::Failed(why) => {
                let line = match tested {
                    Some(_) => format!("Preflight stopped: {why}"),
                    None => format!("Show stopped in frame {}: {why}", frame + 1),
                };
                self.failure = Some(format!("{line}."));
                RunOutcome::Failed(line)
            }
            other => other,
        };
        self.journal.end(now, &outcome.to_string());
        let (frames_played, dropouts) = (run.tally.frames_played, run.tally.dropouts);
        // A robot may have missed the last STOP, and keeps a route then.
        let stops = matches!(outcome, RunOutcome::Failed(_));
        if let Some(report) = tested {
            let (passed, robots) = (report.passed(), report.robots.len());
            self.context.log.record(now, EventKind::PreflightEnded { passed, robots });
            self.preflight = Some(Arc::new(report));
        }
        self.context.log.record(now, EventKind::RunEnded { outcome, frames_played, dropouts });
        if stops {
            self.halt(now, None);
        }
    }

    /// Tells all robots to stop: now, or when the broker is connected again. `held_from`: see [`Stopping::begin`].
    pub(crate) fn halt(&mut self, now: Instant, held_from: Option<Instant>) {
        if self.context.outbox.linked() {
            self.stopping = Some(Stopping::begin(&mut self.context, now, held_from));
        } else {
            self.stops_when_connected = true;
        }
    }

    /// What the controller is doing.
    pub fn state(&self) -> ControllerState {
        match &self.run {
            Some(run) => run.state(),
            None if !self.context.outbox.linked() => ControllerState::Idle,
            None if self.stopping.is_some() => ControllerState::Aborting,
            None => ControllerState::Ready,
        }
    }

    /// Keeps a journal of each run from now on; see [`take_journal`](Self::take_journal).
    pub fn keep_journal(&mut self) {
        self.journal.keep();
    }

    /// Returns the next piece for the journal's file; `None` if there is nothing to write. `clocks`: what the clocks
    /// of the controller's computer read now.
    pub fn take_journal(&mut self, clocks: ComputerTime) -> Option<JournalPiece> {
        self.journal.take(clocks)
    }

    /// Makes the next piece of the journal a whole journal. Call this if an earlier piece was lost.
    pub fn begin_journal_again(&mut self) {
        self.journal.begin_again();
    }

    /// Takes the next message to publish (QoS 0, not retained); `None` if none waits.
    pub fn next_send(&mut self) -> Option<Send> {
        self.context.outbox.next()
    }

    /// Takes the next event; `None` if none waits.
    pub fn next_event(&mut self) -> Option<Event> {
        self.context.log.next()
    }

    /// Takes the next plan request; `None` if there is none. At most one plan is wanted at a time: a newer request
    /// replaces an older one.
    pub fn next_plan_request(&mut self) -> Option<PlanRequest> {
        self.context.plan_request.take()
    }

    /// Returns when to call [`wake`](Self::wake) next, show clock; always `Some`, and later than the last call of
    /// `wake`.
    pub fn wake_at(&self) -> Option<Instant> {
        let run = self.run.as_ref().map(|run| run.due(&self.context, self.woken));
        let stopping = self.stopping.as_ref().map(Stopping::due);
        let due = [self.context.outbox.due(), run, stopping].into_iter().flatten().min();
        Some(due.unwrap_or(Instant::FAR).min(self.patrol_at).max(self.woken + Span::from_millis(1)))
    }

    /// Whether a run is under way, or robots are being stopped.
    pub fn has_run(&self) -> bool {
        self.run.is_some() || self.stopping.is_some()
    }

    /// Whether the run waits for GO and is not paused, and the air time of the frame that has the cue is over.
    pub fn is_at_cue(&self, now: Instant) -> bool {
        self.run.as_ref().is_some_and(|run| run.is_at_cue(now))
    }

    /// Whether the run is interrupted and the operator can let it go on now: the broker is connected, and a robot
    /// reports again.
    pub fn may_go_on(&self) -> bool {
        self.run.as_ref().is_some_and(|run| run.may_go_on(&self.context))
    }

    /// The open show; `None` if no show is open.
    pub fn show(&self) -> Option<&Arc<Show>> {
        self.show.as_ref()
    }

    /// Returns the number of known robots, stale and gone ones included.
    pub fn robots(&self) -> usize {
        self.context.fleet.robots().len()
    }

    /// Returns the counts of messages and reports.
    pub fn counters(&self) -> Counters {
        Counters {
            received: self.received,
            junk: self.junk,
            sent: self.context.outbox.sent,
            resent: self.context.resent,
            unsent: self.context.outbox.unsent,
            overflow: self.context.fleet.overflow,
            flooded: self.context.fleet.flooded,
            unexpected: self.context.unexpected,
        }
    }
}

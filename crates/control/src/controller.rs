//! The inputs and outputs of the controller.

use crate::clock;
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

/// A slice of the fleet ages this often.
const PATROL: Span = Span::from_millis(250);
/// Number of slices: each robot ages every 2 s.
const ROUNDS: usize = 8;
/// Between runs all robots are asked to report this often, where some know TARGET only. Such a robot
/// that was not heard when it was switched on would be driven into.
const ASK_ALL: Span = Span::from_millis(600);
/// Added to that for each robot, because their answers share one link.
const ASK_ALL_PER_ROBOT: Span = Span::from_millis(1);
/// Robots that know TARGET only are asked to report after this share of the time until they are stale.
const ASK_AFTER: i64 = 2;

/// A controller of one fleet. Ways in: [`message`](Self::message), [`operate`](Self::operate),
/// [`connected`](Self::connected), [`disconnected`](Self::disconnected), [`wake`](Self::wake),
/// [`planned`](Self::planned), each with `now`, which *is* the show clock and never goes back. After each of them
/// drain [`next_send`](Self::next_send), [`next_event`](Self::next_event) and
/// [`next_plan_request`](Self::next_plan_request), and wake at [`wake_at`](Self::wake_at).
#[derive(Debug, Serialize, Deserialize)]
pub struct Controller {
    pub(crate) context: Context,
    #[serde(with = "crate::shared_show::optional")]
    pub(crate) show: Option<Arc<Show>>,
    pub(crate) looping: bool,
    /// Speed of drives of the next run, percent of the usual one.
    pub(crate) speed_percent: u32,
    #[serde(skip)]
    pub(crate) run: Option<Run>,
    #[serde(skip)]
    pub(crate) stopping: Option<Stopping>,
    /// Where and why the last run failed, for people; until the operator dismisses it or begins another run.
    pub(crate) failure: Option<String>,
    /// The frame in which the last run of a show was stopped; until the operator dismisses it or begins another run.
    pub(crate) stopped_in: Option<usize>,
    /// Robots are told to stop once there is a broker: they were cut off in a run that does not go on, or while they were
    /// told to stop.
    pub(crate) stops_when_connected: bool,
    /// What the last preflight found.
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
    /// A controller that knows no robot yet.
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

    /// The broker is connected and the topics are subscribed (`T/LightBot/UUID`, `Arrival`, `Status`, `Time`).
    pub fn connected(&mut self, now: Instant) {
        if self.context.outbox.linked() {
            return;
        }
        self.context.outbox.link(true);
        self.context.log.record(now, EventKind::Connected);
        // STOP first: a robot that hears anything else again turns towards the route it holds.
        if std::mem::take(&mut self.stops_when_connected) {
            self.stopping = Some(Stopping::begin(&mut self.context, now, None));
        }
        self.refresh(now);
        self.conclude(now);
    }

    /// The connection to the broker is lost.
    pub fn disconnected(&mut self, now: Instant) {
        if !self.context.outbox.linked() {
            return;
        }
        self.context.outbox.link(false);
        self.context.log.record(now, EventKind::Disconnected);
        // STOP was lost with the broker where it was under way.
        self.stops_when_connected |= self.stopping.take().is_some();
        if let Some(run) = &mut self.run {
            run.on_disconnect(&mut self.context, now);
        }
        self.conclude(now);
    }

    /// A message came. Junk is counted and dropped.
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
            // What a controller sends: this one's, which come back, or another's.
            Some(Topic::Broadcast | Topic::Robot(_)) => {}
            None => self.junk += 1,
        }
    }

    /// Whether a message of a robot counts: one that floods does not.
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
            stopping::stop_late_comer(context, received.index);
            if topic == Topic::Arrival && !received.found {
                context.report_unexpected(now, report);
            }
        }
    }

    /// Asks all robots to report.
    pub(crate) fn refresh(&mut self, now: Instant) {
        let every = Span::from_millis(500);
        self.context.outbox.broadcast(now, Command::Uuid, 2, every);
    }

    /// Time passed.
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

    /// Ages robots, and asks those to report that know TARGET only: they do not report of their own accord.
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

    /// A plan is made. Results of requests that were withdrawn are dropped.
    pub fn planned(&mut self, now: Instant, result: PlanResult) {
        if let Some(run) = &mut self.run {
            run.on_plan(&mut self.context, now, result);
        }
        self.conclude(now);
    }

    /// Ends a run that is over, writes the journal, and records the state of the controller if that changed.
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

    /// Ends a run that is over at a frame.
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
        // A robot that lost the last STOP on its way keeps a route.
        let stops = matches!(outcome, RunOutcome::Failed(_)) && self.context.outbox.linked();
        if let Some(report) = tested {
            let (passed, robots) = (report.passed(), report.robots.len());
            self.context.log.record(now, EventKind::PreflightEnded { passed, robots });
            self.preflight = Some(Arc::new(report));
        }
        self.context.log.record(now, EventKind::RunEnded { outcome, frames_played, dropouts });
        if stops {
            self.stopping = Some(Stopping::begin(&mut self.context, now, None));
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

    /// Runs are written into a journal from now on; see [`take_journal`](Self::take_journal).
    pub fn keep_journal(&mut self) {
        self.journal.keep();
    }

    /// What is to be written into the journal's file since it was asked last, if there is anything. `wall_us`: the time of
    /// day, microseconds since 1970.
    pub fn take_journal(&mut self, wall_us: u64) -> Option<JournalPiece> {
        self.journal.take(wall_us)
    }

    /// A piece of the journal was lost: the next one begins it again.
    pub fn begin_journal_again(&mut self) {
        self.journal.begin_again();
    }

    /// The next message to publish (QoS 0, not retained).
    pub fn next_send(&mut self) -> Option<Send> {
        self.context.outbox.next()
    }

    /// The next event.
    pub fn next_event(&mut self) -> Option<Event> {
        self.context.log.next()
    }

    /// The next plan to be made. At most one is wanted at a time; a newer request replaces an older one.
    pub fn next_plan_request(&mut self) -> Option<PlanRequest> {
        self.context.plan_request.take()
    }

    /// When to call [`wake`](Self::wake) next; always after the last time it was called.
    pub fn wake_at(&self) -> Option<Instant> {
        let run = self.run.as_ref().map(|run| run.due(&self.context, self.woken));
        let stopping = self.stopping.as_ref().map(Stopping::due);
        let due = [self.context.outbox.due(), run, stopping].into_iter().flatten().min();
        Some(due.unwrap_or(Instant::FAR).min(self.patrol_at).max(self.woken + Span::from_millis(1)))
    }

    /// Whether there is a run, or robots are being stopped.
    pub fn has_run(&self) -> bool {
        self.run.is_some() || self.stopping.is_some()
    }

    /// Whether a frame has stood for its air time and waits for GO.
    pub fn is_at_cue(&self, now: Instant) -> bool {
        self.run.as_ref().is_some_and(|run| run.is_at_cue(now))
    }

    /// Whether the operator can let an interrupted run go on.
    pub fn may_go_on(&self) -> bool {
        self.run.as_ref().is_some_and(|run| run.may_go_on(&self.context))
    }

    /// The open show.
    pub fn show(&self) -> Option<&Arc<Show>> {
        self.show.as_ref()
    }

    /// How many robots it remembers.
    pub fn robots(&self) -> usize {
        self.context.fleet.robots().len()
    }

    /// What was received and sent.
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

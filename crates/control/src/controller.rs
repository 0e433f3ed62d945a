//! The controller's ways in and out; each concern has a file of its own.

use crate::clock;
use crate::config::Config;
use crate::desk::Desk;
use crate::drafting::{Done, Job};
use crate::event::{Event, EventKind, Outcome};
use crate::hearing::unexpected;
use crate::operation::State;
use crate::outbox::Send;
use crate::run::Run;
use crate::snapshot::{Age, Counters, RobotView, Snapshot};
use crate::stopping::Stopping;
use lightbots_base::{Instant, RobotId, Span};
use lightbots_plan::Path;
use lightbots_show::Show;
use lightbots_wire::{Command, Report, TimeQuestion, Topic};
use std::sync::Arc;

/// The fleet is looked at this often; all of it within [`ROUNDS`] looks.
const PATROL: Span = Span::from_millis(250);
const ROUNDS: usize = 8;
/// Where there are originals, it is asked this often between runs who else is there, less often in large fleets: one that
/// was not heard when it was switched on would be driven into.
const ASK_ALL: Span = Span::from_millis(600);
const ASK_ALL_PER_ROBOT: Span = Span::from_millis(1);
/// Originals that have not been heard for this share of staleness are asked for a sign of life.
const ASK_AFTER: i64 = 2;

/// A controller of one fleet. Ways in: [`message`](Self::message), [`operate`](Self::operate),
/// [`connected`](Self::connected), [`disconnected`](Self::disconnected), [`wake`](Self::wake),
/// [`planned`](Self::planned), each with `now`, which *is* the show clock and never goes back. After each of them
/// drain [`next_send`](Self::next_send), [`next_event`](Self::next_event) and [`next_job`](Self::next_job), and
/// wake at [`wake_at`](Self::wake_at).
#[derive(Debug)]
pub struct Controller {
    pub(crate) desk: Desk,
    pub(crate) show: Option<Arc<Show>>,
    pub(crate) looping: bool,
    pub(crate) run: Option<Run>,
    pub(crate) stopping: Option<Stopping>,
    /// Where and why the last run failed, for people; until the operator dismisses it or starts again.
    pub(crate) failure: Option<String>,
    said: State,
    patrol_at: Instant,
    ask_all_at: Instant,
    woken: Instant,
    received: u64,
    junk: u64,
}

/// The paths of the drive under way or about to begin.
#[derive(Clone, Debug)]
pub struct PathsView<'a> {
    /// The frame they lead to, counted from 0.
    pub frame: usize,
    /// A number that differs from drive to drive.
    pub seq: u32,
    /// When they begin, show clock; holds come on top.
    pub began: Instant,
    /// Who drives which path.
    pub paths: Vec<(RobotId, &'a Path)>,
}

impl Controller {
    /// A controller that knows nobody yet.
    pub fn new(config: Config) -> Self {
        Self {
            desk: Desk::new(config),
            show: None,
            looping: false,
            run: None,
            stopping: None,
            failure: None,
            said: State::Idle,
            patrol_at: Instant::ZERO,
            ask_all_at: Instant::ZERO,
            woken: Instant::ZERO,
            received: 0,
            junk: 0,
        }
    }

    /// The broker is there and the topics are subscribed (`T/LightBot/UUID`, `Arrival`, `Status`, `Time`).
    pub fn connected(&mut self, now: Instant) {
        if self.desk.outbox.linked() {
            return;
        }
        self.desk.outbox.link(true);
        self.desk.log.tell(now, EventKind::Connected);
        self.refresh(now);
        if let Some(run) = &mut self.run {
            run.come_online(&mut self.desk, now);
        }
        self.conclude(now);
    }

    /// The broker is lost.
    pub fn disconnected(&mut self, now: Instant) {
        if !self.desk.outbox.linked() {
            return;
        }
        self.desk.outbox.link(false);
        self.desk.log.tell(now, EventKind::Disconnected);
        self.stopping = None;
        if let Some(run) = &mut self.run {
            run.go_offline(&mut self.desk, now);
        }
        self.conclude(now);
    }

    /// A message came. Junk is counted and dropped.
    pub fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        self.received += 1;
        match Topic::parse(topic) {
            Some(Topic::Time) => match TimeQuestion::decode(payload) {
                Some(question) => clock::answer(now, question, &mut self.desk.outbox),
                None => self.junk += 1,
            },
            Some(topic @ (Topic::Uuid | Topic::Arrival | Topic::Status)) => match Report::decode(payload) {
                Some(report) => self.hear(now, topic, &report),
                None => self.junk += 1,
            },
            // What controllers say: ours, come back, or another's.
            Some(Topic::Broadcast | Topic::Robot(_)) => {}
            None => self.junk += 1,
        }
    }

    fn hear(&mut self, now: Instant, topic: Topic, report: &Report) {
        let desk = &mut self.desk;
        let Some(heard) = desk.fleet.hear(now, report, &desk.config, &mut desk.log) else { return };
        if heard.found && topic == Topic::Arrival {
            unexpected(desk, now, report);
        }
        if let Some(stopping) = &mut self.stopping {
            stopping.hear(desk, heard.index);
        } else if let Some(run) = &mut self.run {
            run.hear(desk, now, heard, topic, report);
            self.conclude(now);
        } else if topic == Topic::Arrival && !heard.found {
            unexpected(desk, now, report);
        }
    }

    /// Asks who is out there.
    pub(crate) fn refresh(&mut self, now: Instant) {
        let every = Span::from_millis(500);
        self.desk.outbox.broadcast(now, Command::Uuid, 2, every);
    }

    /// Time passed.
    pub fn wake(&mut self, now: Instant) {
        self.woken = now;
        self.desk.outbox.tick(now);
        self.desk.log.tick(now);
        if now >= self.patrol_at {
            self.patrol_at = now + PATROL;
            self.patrol(now);
        }
        if let Some(stopping) = &mut self.stopping
            && stopping.tick(&mut self.desk, now)
        {
            self.stopping = None;
        }
        if let Some(run) = &mut self.run {
            run.tick(&mut self.desk, now);
        }
        self.conclude(now);
    }

    /// Ages robots, and asks originals, which say nothing of their own accord, for a sign of life.
    fn patrol(&mut self, now: Instant) {
        let desk = &mut self.desk;
        let slice = desk.fleet.patrol(now, ROUNDS, &desk.config, &mut desk.log);
        let patience = desk.config.stale_after / ASK_AFTER;
        let mut has_originals = false;
        for index in slice {
            let robot = desk.fleet.robot_mut(index);
            has_originals |= robot.is_original() && robot.age != Age::Gone;
            let due = now - robot.heard >= patience && now - robot.asked >= patience;
            if robot.is_original() && due && now - robot.heard < desk.config.gone_after {
                robot.asked = now;
                let topic = Topic::Robot(robot.id);
                desk.outbox.say(topic, &[Command::Uuid]);
            }
        }
        if has_originals && self.run.is_none() && now >= self.ask_all_at {
            self.ask_all_at = now + ASK_ALL + ASK_ALL_PER_ROBOT * desk.fleet.robots().len() as i64;
            desk.outbox.say(Topic::Broadcast, &[Command::Uuid]);
        }
    }

    /// A job is done. Answers to jobs that are not wanted any more are dropped.
    pub fn planned(&mut self, now: Instant, done: Done) {
        if let Some(run) = &mut self.run {
            run.planned(&mut self.desk, now, done);
        }
        self.conclude(now);
    }

    /// Ends a run that is over and says what the controller is doing, if that changed.
    pub(crate) fn conclude(&mut self, now: Instant) {
        if let Some(run) = &mut self.run
            && let Some(outcome) = run.over.take()
        {
            let frame = run.view(&self.desk, now).frame;
            run.leave(&mut self.desk);
            let (frames_played, dropouts) = (run.frames_played, run.dropouts);
            self.run = None;
            self.desk.job = None;
            let outcome = match outcome {
                Outcome::Failed(why) => {
                    let line = format!("Show stopped in frame {}: {why}", frame + 1);
                    self.failure = Some(format!("{line}."));
                    Outcome::Failed(line)
                }
                other => other,
            };
            self.desk.log.tell(now, EventKind::RunEnded { outcome, frames_played, dropouts });
        }
        let state = self.state();
        if state != self.said {
            self.said = state;
            self.desk.log.tell(now, EventKind::StateChanged(state));
        }
    }

    /// What the controller is doing.
    pub fn state(&self) -> State {
        match &self.run {
            _ if !self.desk.outbox.linked() => State::Idle,
            _ if self.stopping.is_some() => State::Aborting,
            Some(run) => run.state(),
            None => State::Ready,
        }
    }

    /// The next message to publish (QoS 0, not retained).
    pub fn next_send(&mut self) -> Option<Send> {
        self.desk.outbox.next()
    }

    /// The next thing that happened.
    pub fn next_event(&mut self) -> Option<Event> {
        self.desk.log.next()
    }

    /// The next plan to be made. At most one is wanted at a time; a newer one makes an older one needless.
    pub fn next_job(&mut self) -> Option<Job> {
        self.desk.job.take()
    }

    /// When to call [`wake`](Self::wake) next; always after the last time it was called.
    pub fn wake_at(&self) -> Option<Instant> {
        let run = self.run.as_ref().map(|run| run.due(&self.desk, self.woken));
        let stopping = self.stopping.as_ref().map(Stopping::due);
        let due = [self.desk.outbox.due(), run, stopping].into_iter().flatten().min();
        Some(due.unwrap_or(Instant::FAR).min(self.patrol_at).max(self.woken + Span::from_millis(1)))
    }

    /// The open show.
    pub fn show(&self) -> Option<&Arc<Show>> {
        self.show.as_ref()
    }

    /// What the controller was told at its start.
    pub fn config(&self) -> &Config {
        &self.desk.config
    }

    /// How many robots it remembers.
    pub fn robots(&self) -> usize {
        self.desk.fleet.robots().len()
    }

    /// What came and went.
    pub fn counters(&self) -> Counters {
        Counters {
            received: self.received,
            junk: self.junk,
            sent: self.desk.outbox.sent,
            resent: self.desk.resent,
            unsent: self.desk.outbox.unsent,
            overflow: self.desk.fleet.overflow,
            unexpected: self.desk.unexpected,
        }
    }

    /// How everything is. Costs time in proportion to the fleet.
    pub fn snapshot(&self, now: Instant) -> Snapshot {
        Snapshot {
            at: now,
            state: self.state(),
            connected: self.desk.outbox.linked(),
            show: self.show.as_ref().map(|show| show.name.clone()),
            frames: self.show.as_ref().map_or(0, |show| show.frames.len()),
            looping: self.looping,
            run: self.run.as_ref().map(|run| run.view(&self.desk, now)),
            failure: self.failure.clone(),
            robots: self.robot_views(now),
            counters: self.counters(),
        }
    }

    fn robot_views(&self, now: Instant) -> Vec<RobotView> {
        let view = |robot: &crate::fleet::Robot| {
            let mut view = robot.view();
            if let (Some(run), Some(seat)) = (&self.run, robot.seat) {
                run.complete(&mut view, seat as usize, now);
            }
            view
        };
        self.desk.fleet.robots().iter().map(view).collect()
    }

    /// The paths of the drive under way, for drawing; `None` when nobody drives paths.
    pub fn paths(&self) -> Option<PathsView<'_>> {
        let run = self.run.as_ref()?;
        let (leg, began) = run.driven_paths()?;
        let name = |seat: usize| self.desk.fleet.robot(run.seats[seat].robot).id;
        let paths = (0..leg.moves.len()).filter_map(|seat| Some((name(seat), leg.path(seat)?))).collect();
        Some(PathsView { frame: leg.frame, seq: leg.seq, began, paths })
    }
}

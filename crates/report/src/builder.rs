//! Makes the report of a recording.

use std::collections::BTreeSet;
use std::sync::Arc;

use lightbots_base::{Instant, RobotId, Span};
use lightbots_control::{
    Controller, Counters, Event, EventKind, LogEnd, LogError, ReplayReport, ReplayStep, RunOutcome,
    replay_observed,
};
use lightbots_show::{Obstacle, Severity, Show};
use lightbots_wire::{Report, Topic};

use crate::figures::{ThreeFigures, round};
use crate::frames::FrameNotes;
use crate::model::{ClosestApproach, Loss, MessageFigures, ReportBrakes, ReportedEvent, RunKind, ShowReport};
use crate::robots::AllRobots;
use crate::track::{Scrub, ScrubTrack, encoded};
use crate::truth::Truth;
use crate::words;

/// Least time between two samples of the planned places.
const SAMPLE: Span = Span::from_millis(100);
/// Largest number of incidents that a report lists, besides the end of the run.
const INCIDENTS_MAX: usize = 300;
/// Largest number of closest approaches that a report lists.
const APPROACHES: usize = 10;
/// A frame counts as late if all robots waited longer than this for the last one, seconds. Arrivals of a healthy fleet
/// differ by less.
const LATE_S: f64 = 0.3;

/// A report that is made while its recording is replayed.
#[derive(Debug, Default)]
pub struct ReportBuilder {
    show: Option<Arc<Show>>,
    is_running: bool,
    is_home: bool,
    is_preview: bool,
    has_real: bool,
    robots: AllRobots,
    taking_part: usize,
    /// Index of the first frame of the run, counted from 0.
    from: usize,
    frames: FrameNotes,
    began: Option<Instant>,
    /// Show-clock time of the latest input.
    now: Instant,
    outcome: Option<RunOutcome>,
    frames_played: usize,
    /// Whether a frame was chosen, skipped, left out or repeated, so that frames were not played once each in their order.
    is_order_changed: bool,
    /// Indices of the frames that robots reached.
    shown: BTreeSet<usize>,
    planned_s: f64,
    /// Distances between robots and their pixels in all frames, metres.
    errors_m: Vec<f64>,
    losses: Vec<(RobotId, Instant, Loss)>,
    incidents: Vec<(Instant, ReportedEvent)>,
    incidents_left_out: usize,
    counters: (Counters, Counters),
    sampled: Option<Instant>,
    truth: Option<Truth>,
}

/// Makes the report and the replay of a recording. `progress` is called repeatedly with the share that is done, 0 to 1.
pub fn report_of(log: &[u8], progress: &mut dyn FnMut(f64)) -> Result<(ShowReport, Scrub), LogError> {
    report_with_truth(log, None, progress)
}

/// Like [`report_of`], with what only the simulator of a rehearsal knows; `None`: nothing.
pub fn report_with_truth(
    log: &[u8],
    truth: Option<Truth>,
    progress: &mut dyn FnMut(f64),
) -> Result<(ShowReport, Scrub), LogError> {
    let mut builder = ReportBuilder { truth, ..ReportBuilder::default() };
    let replayed =
        replay_observed(log, progress, &mut |now, controller, step| builder.step(now, controller, step))?;
    Ok(builder.finish(replayed))
}

impl ReportBuilder {
    /// Handles a step of a replay.
    pub fn step(&mut self, now: Instant, controller: &Controller, step: ReplayStep<'_>) {
        match step {
            ReplayStep::Message { topic, payload } if self.is_running => self.message(now, topic, payload),
            ReplayStep::Event(event) => self.event(event, controller),
            ReplayStep::Message { .. } | ReplayStep::Woken => {}
            ReplayStep::Input(_) | ReplayStep::Sent(_) => return,
        }
        if self.is_running {
            self.now = self.now.max(now);
            self.sample(now, controller);
        }
    }

    fn message(&mut self, now: Instant, topic: &str, payload: &[u8]) {
        let Some(topic @ (Topic::Uuid | Topic::Arrival | Topic::Status)) = Topic::parse(topic) else {
            return;
        };
        let Some(report) = Report::decode(payload) else { return };
        self.robots.receive(now, topic, &report, self.frames.current);
        if topic == Topic::Arrival {
            self.frames.arrive(report.id, now);
        }
    }

    fn sample(&mut self, now: Instant, controller: &Controller) {
        if self.sampled.is_some_and(|sampled| now - sampled < SAMPLE) {
            return;
        }
        self.sampled = Some(now);
        for (id, place) in controller.planned_places(now) {
            if let Some(robot) = self.robots.get(id) {
                robot.planned.add(now.as_secs(), place);
            }
        }
    }

    fn event(&mut self, event: &Event, controller: &Controller) {
        match &event.kind {
            EventKind::RunBegun { from, robots } => self.begin(event.at, controller, (*from, *robots)),
            EventKind::GoingHome { robots } => {
                self.begin(event.at, controller, (0, *robots));
                self.is_home = true;
            }
            EventKind::TakenUp { frame, robots, .. } => self.begin(event.at, controller, (*frame, *robots)),
            _ if !self.is_running => return,
            EventKind::TransitionStarted { frame, starts, duration } => {
                self.began.get_or_insert(*starts);
                self.frames.leave(*frame, *starts, *duration);
                self.note_lights(*starts, controller);
            }
            EventKind::Replanning { .. } => self.frames.plan_anew(),
            EventKind::LoopBegun { .. } => self.is_order_changed = true,
            EventKind::GoesTo { .. } | EventKind::Skipped { .. } | EventKind::LeftOutForMusic { .. } => {
                self.is_order_changed = true;
                self.frames.plan_anew();
            }
            EventKind::FrameReached { frame, wait, .. } => {
                self.stand(*frame, event.at, controller);
                self.is_late(*frame, event.at, *wait);
            }
            EventKind::AtHome => self.stand(0, event.at, controller),
            EventKind::Dropout { robot, why } => self.lose(*robot, event.at, why.to_string()),
            EventKind::Rejoined(robot) => self.come_back(*robot, event.at),
            EventKind::RunEnded { outcome, frames_played, .. } => {
                (self.outcome, self.frames_played) = (Some(outcome.clone()), *frames_played);
                (self.now, self.counters.1) = (event.at, controller.counters());
            }
            _ => {}
        }
        self.note(event);
        self.is_running &= self.outcome.is_none();
    }

    fn begin(&mut self, now: Instant, controller: &Controller, (from, robots): (usize, usize)) {
        self.is_running = self.outcome.is_none();
        (self.from, self.taking_part, self.now) = (from, robots, now);
        self.show = controller.show().cloned();
        self.is_preview = controller.state() == lightbots_control::ControllerState::Preview;
        self.counters.0 = controller.counters();
        for view in controller.snapshot(now).robots {
            self.has_real |= !view.reported.simulated;
            if let (Some(robot), Some(at)) = (self.robots.get(view.id), view.reported.at) {
                robot.driven.add(now.as_secs(), at);
                robot.planned.add(now.as_secs(), at);
            }
        }
    }

    fn stand(&mut self, frame: usize, now: Instant, controller: &Controller) {
        let snapshot = controller.snapshot(now);
        // Without air time the next drive may have begun, whose goals are not those of this frame.
        let stands = snapshot.run.as_ref().is_none_or(|run| run.frame == frame || self.is_home);
        let mut errors_m = Vec::new();
        for view in snapshot.robots.iter().filter(|view| stands && view.takes_part) {
            let Some(error_m) = view.reported.at.zip(view.goal).map(|(at, goal)| at.distance(goal)) else {
                continue;
            };
            if view.pixel.is_some() || self.is_home {
                errors_m.push(error_m);
                if let Some(robot) = self.robots.get(view.id) {
                    robot.errors_m.push(error_m);
                }
            }
        }
        let picture = self.show.as_ref().and_then(|show| show.frames.get(frame));
        let name = picture.map_or(String::new(), |frame| frame.name.clone());
        let name = if self.is_home { "Home".to_owned() } else { name };
        let air_s = picture.filter(|_| !self.is_home).map_or(0.0, |frame| frame.air_time_s);
        let began = self.began.unwrap_or(now);
        self.planned_s += self.frames.stand((frame, name), now, began, &errors_m, &mut self.robots) + air_s;
        self.frames_played += 1;
        self.shown.insert(frame);
        self.errors_m.append(&mut errors_m);
        self.robots.thin();
        self.note_lights(now, controller);
    }

    fn note_lights(&mut self, now: Instant, controller: &Controller) {
        for view in controller.snapshot(now).robots {
            let value = view.light.number();
            if let Some(robot) = self.robots.get(view.id)
                && robot.lights.last().is_none_or(|last| last.1 != value)
            {
                robot.lights.push((now, value));
            }
        }
    }

    fn is_late(&mut self, frame: usize, at: Instant, wait: Span) {
        let late_s = wait.as_secs();
        if late_s > LATE_S {
            let line =
                format!("Frame {} stood {late_s:.1} s late: all waited for the last robot.", frame + 1);
            self.add(at, ReportedEvent { at_s: 0.0, tone: "look", line, robot: None });
        }
    }

    fn lose(&mut self, robot: RobotId, at: Instant, why: String) {
        if let Some(notes) = self.robots.get(robot) {
            notes.lost = Some(at);
        }
        let name = robot.as_str().to_owned();
        let loss = Loss { robot: name, at_s: 0.0, frame: self.frames.current, why, back_at_s: None };
        self.losses.push((robot, at, loss));
    }

    fn come_back(&mut self, robot: RobotId, at: Instant) {
        if let Some(notes) = self.robots.get(robot) {
            notes.lost = None;
        }
        if let Some((.., loss)) = self.losses.iter_mut().rev().find(|loss| loss.0 == robot) {
            loss.back_at_s.get_or_insert(at.as_secs());
        }
    }

    fn note(&mut self, event: &Event) {
        if let Some((line, robot)) = words::incident(&event.kind) {
            let tone = match (&event.kind, event.kind.severity()) {
                (EventKind::RunEnded { outcome: RunOutcome::Finished, .. } | EventKind::AtHome, _) => "good",
                (_, Severity::Error) => "bad",
                (_, Severity::Warning) => "look",
                _ => "note",
            };
            self.add(event.at, ReportedEvent { at_s: 0.0, tone, line, robot });
        }
    }

    fn add(&mut self, at: Instant, incident: ReportedEvent) {
        // The end of the run is always listed.
        if self.incidents.len() < INCIDENTS_MAX || self.outcome.is_some() {
            self.incidents.push((at, incident));
        } else {
            self.incidents_left_out += 1;
        }
    }

    /// Returns the report and the replay. `replayed` is the result of replaying the recording to its end.
    pub fn finish(mut self, replayed: ReplayReport) -> (ShowReport, Scrub) {
        let began = self.began.unwrap_or(self.now);
        let since = |at: Instant| round((at - began).as_secs().max(0.0), 3);
        let mut incidents: Vec<ReportedEvent> = self
            .incidents
            .iter()
            .map(|(at, incident)| ReportedEvent { at_s: since(*at), ..incident.clone() })
            .collect();
        incidents.sort_by(|a, b| a.at_s.total_cmp(&b.at_s));
        let back = |loss: &Loss| loss.back_at_s.map(|at_s| round(at_s - began.as_secs(), 3));
        let losses = self.losses.iter().map(|(_, at, loss)| Loss {
            at_s: since(*at),
            back_at_s: back(loss),
            ..loss.clone()
        });
        let approaches = self.approaches(&since);
        let mut report = ShowReport {
            show: self.show.as_ref().map_or(String::new(), |show| show.name.clone()),
            kind: self.kind(&replayed),
            began_unix_ms: note(&replayed, "began_unix_ms").and_then(|text| text.parse().ok()),
            robots: self.taking_part,
            frames: self.frames_wanted(),
            frames_played: if self.is_order_changed { self.shown.len() } else { self.frames_played },
            planned_s: round(self.planned_s, 3),
            duration_s: since(self.now),
            closest_m: approaches.first().map(|approach| approach.gap_m),
            approaches,
            brakes: ReportBrakes { all: self.robots.brakes(), ..ReportBrakes::default() },
            position_error_m: ThreeFigures::of(&self.errors_m, 5),
            errors_m: std::mem::take(&mut self.errors_m),
            arrival_spread_s: ThreeFigures::of(&self.frames.spreads_s, 3),
            tracking_error_m: self.robots.offs_m.figures(),
            messages: self.messages(),
            losses: losses.collect(),
            incidents,
            incidents_left_out: self.incidents_left_out,
            per_frame: std::mem::take(&mut self.frames.list),
            per_robot: self.robots.by_name.iter().map(|(&id, robot)| robot.figures(id)).collect(),
            is_complete: replayed.end == LogEnd::Complete && replayed.difference.is_none(),
            ..ShowReport::default()
        };
        report.notes = replayed.notes;
        if let Some(truth) = &self.truth {
            truth.tell(&mut report);
        }
        report.ok = self.outcome == Some(RunOutcome::Finished)
            && report.frames_played >= report.frames
            && report.contacts.unwrap_or(0) == 0
            && report.losses.iter().all(|loss| loss.back_at_s.is_some());
        report.verdict = words::verdict(&report, self.outcome.as_ref(), self.is_home, self.frames.current);
        let scrub = self.scrub(began);
        (report, scrub)
    }

    fn frames_wanted(&self) -> usize {
        let frames = self.show.as_ref().map_or(0, |show| show.frames.len());
        if self.is_home || self.is_preview { 1 } else { frames.saturating_sub(self.from) }
    }

    fn kind(&self, replayed: &ReplayReport) -> RunKind {
        match note(replayed, "command") {
            Some("rehearse") => RunKind::Rehearsal,
            _ if self.has_real => RunKind::Real,
            _ => RunKind::Simulated,
        }
    }

    fn messages(&self) -> MessageFigures {
        let (from, to) = &self.counters;
        // A recording that was cut has no counters at its end.
        let grown = |from: u64, to: u64| to.saturating_sub(from);
        MessageFigures {
            sent: grown(from.sent, to.sent),
            received: grown(from.received, to.received),
            resent: grown(from.resent, to.resent),
            unsent: grown(from.unsent, to.unsent),
            junk: grown(from.junk, to.junk),
            lost: None,
        }
    }

    fn approaches(&self, since: &dyn Fn(Instant) -> f64) -> Vec<ClosestApproach> {
        let near = |(id, robot): (&RobotId, &crate::robots::RobotNotes)| {
            let (gap_m, at, frame) = robot.near?;
            let robots = vec![id.as_str().to_owned()];
            Some(ClosestApproach { robots, gap_m: round(gap_m, 5), at_s: since(at), frame })
        };
        let mut all: Vec<ClosestApproach> = self.robots.by_name.iter().filter_map(near).collect();
        all.sort_by(|a, b| a.gap_m.total_cmp(&b.gap_m));
        all.truncate(APPROACHES);
        all
    }

    fn scrub(mut self, began: Instant) -> Scrub {
        let hundredths = |at: Instant| ((at - began).as_secs() * 100.0).round() as i64;
        let (mut lights, mut lost, mut tracks) = (Vec::new(), Vec::new(), Vec::new());
        for (id, robot) in self.robots.by_name {
            let mut last = 0;
            let light = robot.lights.iter().flat_map(|&(at, value)| {
                let after = hundredths(at) - last;
                last += after;
                [after, i64::from(value)]
            });
            lights.push(light.collect::<Vec<_>>());
            lost.push(robot.lost.map(hundredths));
            let true_places = self.truth.as_mut().and_then(|truth| truth.take(id));
            tracks.push((robot.planned, true_places.unwrap_or(robot.driven)));
        }
        let (tracks, tolerance_m) = encoded(tracks, began.as_secs());
        let track = |(((planned, driven), light), lost)| ScrubTrack { planned, driven, light, lost };
        let stage = self.show.map(|show| show.stage.clone()).unwrap_or_default();
        Scrub {
            floor: [stage.width_m, stage.depth_m],
            radius_m: stage.limits.radius_m,
            end_s: round((self.now - began).as_secs().max(0.0), 2),
            tolerance_m,
            areas: stage.obstacles.iter().map(area).collect(),
            tracks: tracks.into_iter().zip(lights).zip(lost).map(track).collect(),
        }
    }
}

fn area(obstacle: &Obstacle) -> Vec<f64> {
    match obstacle {
        Obstacle::Disc { at, radius_m } => vec![at.x, at.y, *radius_m],
        Obstacle::Rect { min, max } => vec![min.x, min.y, max.x, max.y],
    }
}

/// The value of the recording's note called `name`; `None` if there is no such note.
fn note<'a>(replayed: &'a ReplayReport, name: &str) -> Option<&'a str> {
    replayed.notes.iter().find(|note| note.0 == name).map(|note| note.1.as_str())
}

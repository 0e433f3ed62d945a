//! Record of a rehearsal: events, their times, and quality of the frames.

use std::collections::BTreeSet;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_control::{Controller, Event, EventKind, RobotView, RunOutcome};
use lightbots_show::{Issue, Issues, Show};

use crate::breakdowns::{Breakdowns, Fate};
use crate::broker_outages::BrokerEvent;
use crate::bumps::{Bump, EDGE_SLACK_M};
use crate::controller_crashes::CrashEvent;
use crate::floor::FloorObject;
use crate::light_watch::LightCounts;
use crate::report::{FrameRecord, RehearsalReport, SHOWN_M};
use crate::robot_set::RobotSet;
use crate::statistics::Spread;
use crate::world::World;

/// Largest number of listed issues that have the same code. Further issues with this code are only counted.
const OF_A_KIND_MAX: usize = 20;

/// The record until now.
pub(crate) struct RehearsalRecord {
    began: Option<Instant>,
    /// When the first drive to the current frame began, or the first drive after the last new plan.
    started: Instant,
    /// Whether a drive has begun since the last call of `take_departure`.
    departed: bool,
    /// `[robot]`: time of its last report of arrival since the drive to the current frame began; `None`: no report yet.
    arrivals: Vec<Option<Instant>>,
    /// Index of the frame that robots drive to or show.
    heading_for: usize,
    /// Whether `started` and `arrivals` are reset when the next drive begins: robots reached the current frame, were
    /// sent elsewhere, or get a new plan.
    stood: bool,
    /// Number of replans since the first departure.
    replans: usize,
    /// Number of contacts of two robots after the first replan.
    contacts_after_replan: u64,
    errors_m: Vec<f64>,
    frames: Vec<FrameRecord>,
    /// Robots that dropped out, each once.
    dropouts: BTreeSet<RobotId>,
    outcome: Option<RunOutcome>,
    ended: Instant,
    issues: Issues,
    unlisted: usize,
}

impl RehearsalRecord {
    /// An empty record.
    pub fn new(robots: usize) -> Self {
        Self {
            began: None,
            started: Instant::ZERO,
            departed: false,
            arrivals: vec![None; robots],
            heading_for: 0,
            stood: true,
            replans: 0,
            contacts_after_replan: 0,
            errors_m: Vec::with_capacity(robots),
            frames: Vec::new(),
            dropouts: BTreeSet::new(),
            outcome: None,
            ended: Instant::ZERO,
            issues: Vec::new(),
            unlisted: 0,
        }
    }

    /// Whether the show has ended, successfully or not.
    pub fn is_over(&self) -> bool {
        self.outcome.is_some()
    }

    /// Time of the first departure; `None` before it is known.
    pub fn began_at(&self) -> Option<Instant> {
        self.began
    }

    /// Whether a drive has begun since the last call of this function.
    pub fn take_departure(&mut self) -> bool {
        std::mem::take(&mut self.departed)
    }

    /// Number of frames that robots have reached.
    pub fn frames_played(&self) -> usize {
        self.frames.len()
    }

    /// Records that the controller refused to play.
    pub fn refused(&mut self, why: &str) {
        self.outcome = Some(RunOutcome::Failed(why.into()));
        self.add(Issue::error("play-refused", why));
    }

    /// Records an arrival that a robot reports.
    pub fn arrived(&mut self, robot: usize, now: Instant) {
        self.arrivals[robot] = Some(now);
    }

    /// Time between the first and the last robot's arrival at the current frame. Only the latest arrival of each robot
    /// counts. Zero if no robot has arrived.
    fn arrival_spread(&self) -> Span {
        let first = self.arrivals.iter().flatten().min();
        let last = self.arrivals.iter().flatten().max();
        first.zip(last).map_or(Span::ZERO, |(first, last)| *last - *first)
    }

    /// Records a breakdown of a robot, or the end of a breakdown.
    pub fn broke_down(&mut self, robot: usize, id: RobotId, fate: Fate, now: Instant) {
        let (code, what) = match fate {
            Fate::Killed => ("robot-killed", "lost its power, as asked for"),
            Fate::Muted => ("robot-muted", "fell silent, as asked for"),
            Fate::Stuck => ("robot-stuck", "got stuck, as asked for"),
            Fate::Cut => ("robot-cut", "lost its link, as asked for"),
            Fate::Blinded => ("robot-blind", "got no fixes any more, as asked for"),
            Fate::Linked | Fate::Seeing => ("robot-back", "has what it lacked again"),
        };
        let issue = Issue::warning(
            code,
            format!("Robot {robot} ({id}) {what}, {:.2} s into the show.", self.since(now)),
        );
        self.add(issue.in_frame(self.heading_for));
    }

    /// Records that the broker freezes or dies.
    pub fn broker(&mut self, event: BrokerEvent, now: Instant) {
        let (code, what) = match event {
            BrokerEvent::Freezes(_) => ("broker-frozen", "passes nothing on, as asked for"),
            BrokerEvent::Dies => ("broker-gone", "is gone, as asked for"),
            BrokerEvent::ControllerBack | BrokerEvent::RobotBack(_) => return,
        };
        let message = format!("The broker {what}, {:.2} s into the show.", self.since(now));
        self.add(Issue::warning(code, message).in_frame(self.heading_for));
    }

    /// Records that the controller is killed, or is back.
    pub fn controller(&mut self, event: CrashEvent, now: Instant) {
        let (code, what) = match event {
            CrashEvent::Killed => ("controller-killed", "is killed, as asked for"),
            CrashEvent::Back => ("controller-back", "is started again"),
        };
        let message = format!("The controller {what}, {:.2} s into the show.", self.since(now));
        self.add(Issue::warning(code, message).in_frame(self.heading_for));
    }

    /// Records that the operator let an interrupted show go on.
    pub fn pressed(&mut self, now: Instant) {
        let message = format!("The operator pressed Go on, {:.2} s into the show.", self.since(now));
        self.add(Issue::warning("pressed", message).in_frame(self.heading_for));
    }

    /// Records new contacts after a step.
    pub fn contacts(&mut self, now: Instant, world: &World) {
        let (touches, bumps) = (world.contacts().fresh(), world.bumps().fresh());
        if touches.is_empty() && bumps.is_empty() {
            return;
        }
        if self.replans > 0 {
            self.contacts_after_replan += touches.len() as u64;
        }
        let frame = self.heading_for;
        let when = format!("{:.2} s into the show, about frame {}", self.since(now), frame + 1);
        for &(a, b) in touches {
            let place = (world.places()[a as usize] + world.places()[b as usize]) / 2.0;
            let message = format!("Robots {a} and {b} touched at {}, {when}.", at(place));
            self.add(Issue::error("contact", message).in_frame(frame));
        }
        for bump in bumps {
            self.add(bumped(bump, world.places()[bump.robot], &when).in_frame(frame));
        }
    }

    /// Records an event of the controller.
    pub fn event(
        &mut self,
        event: &Event,
        controller: &Controller,
        robots: &RobotSet,
        by_id: &[(RobotId, usize)],
        show: &Show,
    ) {
        match &event.kind {
            EventKind::TransitionStarted { frame, starts, .. } => {
                self.began.get_or_insert(*starts);
                self.departed = true;
                // Where original robots take part, a frame takes several drives.
                if self.stood || self.heading_for != *frame {
                    self.started = *starts;
                    self.arrivals.fill(None);
                }
                (self.heading_for, self.stood) = (*frame, false);
            }
            EventKind::GoesTo { .. } | EventKind::Skipped { .. } | EventKind::LeftOutForMusic { .. } => {
                self.stood = true
            }
            EventKind::Replanning { .. } => {
                self.stood = true;
                self.replans += usize::from(self.began.is_some());
            }
            EventKind::FrameReached { frame, .. } => {
                self.frame_stands(*frame, show, event.at, controller, robots, by_id);
                self.stood = true;
            }
            EventKind::Dropout { robot, .. } => {
                self.dropouts.insert(*robot);
                self.note("dropout", event);
            }
            EventKind::Waiting { .. } => self.note("waiting", event),
            EventKind::LinkLost { .. } => self.note("link-lost", event),
            EventKind::TakenUp { .. } => self.note("taken-up", event),
            EventKind::LinkBack { .. } => self.note("link-back", event),
            EventKind::LeftOut { .. } => self.note("pixels-dark", event),
            EventKind::Rejoined(_) => self.note("rejoined", event),
            EventKind::Misaligned { .. } => self.note("misaligned", event),
            EventKind::PlanFailed { .. } => self.note("plan-failed", event),
            EventKind::RunEnded { outcome, .. } => {
                self.ended = event.at;
                if let RunOutcome::Failed(_) = outcome {
                    self.note("run-failed", event);
                }
                self.outcome = Some(outcome.clone());
            }
            _ => {}
        }
    }

    /// Makes the report. The caller fills in the figures of plan, lights, stops after crashes, network, seed and hash.
    pub fn report(mut self, now: Instant, breakdowns: &Breakdowns, robots: &RobotSet) -> RehearsalReport {
        let finished = self.outcome == Some(RunOutcome::Finished);
        if self.outcome.is_none() {
            let message = format!("The show did not end within {:.0} s: given up.", now.as_secs());
            self.issues.push(Issue::error("no-end", message));
        }
        if self.unlisted > 0 {
            let message = format!("{} more things happened that are not listed.", self.unlisted);
            self.issues.push(Issue::warning("more", message));
        }
        let ended = if self.outcome.is_some() { self.ended } else { now };
        let spreads: Vec<f64> = self.frames.iter().map(|frame| frame.arrival_spread_s).collect();
        let (world, errors) = (&robots.world, robots.errors());
        let bumps = world.bumps();
        RehearsalReport {
            ok: finished && self.dropouts.len() <= breakdowns.count(),
            robots: robots.len(),
            frames_played: self.frames.len(),
            frames: 0,
            duration_s: self.began.map_or(0.0, |began| (ended - began).max(Span::ZERO).as_secs()),
            planned_s: 0.0,
            lower_bound_s: 0.0,
            contacts: world.contacts().count() + bumps.obstacles + bumps.over,
            contacts_after_replan: self.contacts_after_replan,
            replans: self.replans,
            wall_contacts: bumps.edges,
            wall_pressed_m: bumps.edge_most_m,
            brakes: robots.brakes(),
            closest_m: world.contacts().closest_m(),
            arrival_spread_s: Spread::of(&spreads),
            position_error_m: Spread::of(&self.errors_m),
            estimate_error_m: errors.estimate_m(),
            tracking_error_m: errors.tracking_m(),
            clock_spread_s: errors.clocks_s(),
            lights: LightCounts::default(),
            stop_after_crash_s: None,
            messages: Default::default(),
            dropouts: self.dropouts.len(),
            seed: 0,
            state_hash: String::new(),
            real_time_factor: None,
            issues: self.issues,
            per_frame: self.frames,
        }
    }

    /// Records that robots reached a frame: when, and how far each robot is from its pixel.
    fn frame_stands(
        &mut self,
        frame: usize,
        show: &Show,
        at: Instant,
        controller: &Controller,
        robots: &RobotSet,
        by_id: &[(RobotId, usize)],
    ) {
        let places = robots.world.places();
        let mut errors_m = Vec::with_capacity(robots.len());
        let snapshot = controller.snapshot(at);
        // Without air time, original robots may be on their way to the next frame already.
        let stands = snapshot.run.as_ref().is_none_or(|run| run.frame == frame);
        let shows = |view: &&RobotView| stands && view.takes_part && view.pixel.is_some();
        for view in snapshot.robots.iter().filter(shows) {
            let place = by_id.binary_search_by_key(&view.id, |entry| entry.0);
            if let (Ok(place), Some(goal)) = (place, view.goal) {
                errors_m.push(places[by_id[place].1].distance(goal));
            }
        }
        let picture = show.frames.get(frame);
        // After a last frame without air time no robot takes part any more, so each pixel is matched with the nearest
        // robot.
        if errors_m.is_empty() {
            let nearest_m = |goal: Vec2| places.iter().map(|at| at.distance(goal)).reduce(f64::min);
            let pixels = picture.map_or(&[][..], |frame| &frame.pixels);
            errors_m.extend(pixels.iter().filter_map(|pixel| nearest_m(pixel.at)));
        }
        self.frames.push(FrameRecord {
            frame,
            name: picture.map_or(String::new(), |frame| frame.name.clone()),
            at_s: self.since(at),
            drive_s: (at - self.started).as_secs(),
            arrival_spread_s: self.arrival_spread().as_secs(),
            position_error_m: Spread::of(&errors_m),
            pixels_shown: errors_m.iter().filter(|error_m| **error_m <= SHOWN_M).count(),
        });
        self.errors_m.append(&mut errors_m);
    }

    /// Adds an event of the controller to the issues.
    fn note(&mut self, code: &str, event: &Event) {
        let when = match self.began {
            Some(_) => format!("{:.2} s into the show", self.since(event.at)),
            None => "before the show".into(),
        };
        let message = format!("{} ({when})", event.kind);
        let issue = Issue { severity: event.kind.severity(), ..Issue::warning(code, message) };
        self.add(issue.in_frame(self.heading_for));
    }

    fn add(&mut self, issue: Issue) {
        // A bound per kind: a hundred waits would hide the one robot that dropped out.
        if self.issues.iter().filter(|known| known.code == issue.code).count() < OF_A_KIND_MAX {
            self.issues.push(issue);
        } else {
            self.unlisted += 1;
        }
    }

    fn since(&self, now: Instant) -> f64 {
        self.began.map_or(0.0, |began| (now - began).as_secs())
    }
}

/// The issue for a contact of a robot at `place` with a wall or a no-go area.
fn bumped(bump: &Bump, place: Vec2, when: &str) -> Issue {
    let (robot, place) = (bump.robot, at(place));
    match bump.thing {
        FloorObject::Obstacle(index) => {
            let message = format!("Robot {robot} touched area {} at {place}, {when}.", index + 1);
            Issue::error("contact-obstacle", message)
        }
        FloorObject::Edge if bump.over => {
            let over_mm = EDGE_SLACK_M * 1e3;
            let message = format!(
                "Robot {robot} went over the floor's edge by more than {over_mm:.0} mm at {place}, {when}."
            );
            Issue::error("contact-edge", message)
        }
        FloorObject::Edge => {
            let message = format!("Robot {robot} touched the floor's edge at {place}, {when}.");
            Issue::warning("edge-touched", message)
        }
    }
}

fn at(place: Vec2) -> String {
    format!("({:.3}, {:.3}) m", place.x, place.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_touch_is_reported_with_robot_place_and_time() {
        let say = |thing, over| {
            let bump = Bump { robot: 7, thing, over };
            let issue = bumped(&bump, Vec2::new(0.5, -0.25), "3.20 s into the show, about frame 2");
            (issue.is_error(), issue.message)
        };
        let area = "Robot 7 touched area 3 at (0.500, -0.250) m, 3.20 s into the show, about frame 2.";
        assert_eq!(say(FloorObject::Obstacle(2), false), (true, area.into()));
        let edge =
            "Robot 7 touched the floor's edge at (0.500, -0.250) m, 3.20 s into the show, about frame 2.";
        assert_eq!(say(FloorObject::Edge, false), (false, edge.into()));
        let over = "Robot 7 went over the floor's edge by more than 10 mm at (0.500, -0.250) m, 3.20 s into the show, about frame 2.";
        assert_eq!(say(FloorObject::Edge, true), (true, over.into()));
    }
}

//! Views for screens: what the controller is doing, the run, its robots and their paths.

use crate::context::Context;
use crate::controller::Controller;
use crate::leg::LegKind;
use crate::operation::ControllerState;
use crate::run::{Run, RunPhase, RunPurpose};
use crate::snapshot::{LegProgress, PreflightProgress, RobotView, RunView, RunWait, Snapshot};
use lightbots_base::{Instant, Rgb, RobotId, Span, Vec2};
use lightbots_plan::Path;

/// Largest number of robots in [`RunWait::robots`].
const WAITING_MAX: usize = 20;

/// The paths of the drive that is under way or about to begin.
#[derive(Clone, Debug)]
pub struct PathsView<'a> {
    /// The frame to which the paths lead, counted from 0.
    pub frame: usize,
    /// When the drive began or will begin, show clock. Holds delay robots on their paths, which this moment does not
    /// show.
    pub began: Instant,
    /// The robots that have a path in this drive, and their paths. A path may also keep its robot in place.
    pub paths: Vec<(RobotId, &'a Path)>,
}

impl Run {
    /// Returns the controller's state during this run.
    pub fn state(&self) -> ControllerState {
        match self.phase {
            RunPhase::Interrupted(_) => ControllerState::LinkLost,
            _ if self.playback.paused => ControllerState::Paused,
            RunPhase::Gathering(_) | RunPhase::Standing(_) | RunPhase::Starting(_)
                if self.pipeline.driven.is_none() =>
            {
                ControllerState::Preparing
            }
            _ if self.playback.purpose != RunPurpose::Play => ControllerState::Preview,
            _ => ControllerState::Playing,
        }
    }

    /// Returns a view of the run at `now`.
    pub fn view(&self, context: &Context, now: Instant) -> RunView {
        RunView {
            frame: self.frame(),
            next: self.next_frame(),
            may_jump: self.playback.purpose == RunPurpose::Play && self.may_jump(),
            home: self.playback.purpose == RunPurpose::Home,
            preflight: self.preflight.as_ref().map(|check| {
                let (round, rounds) = check.round();
                PreflightProgress { round, rounds, doing: check.doing() }
            }),
            doing: self.doing(context),
            progress: LegProgress {
                share: self.share(now),
                drive_s: self.pipeline.leg().map_or(0.0, |leg| leg.duration.as_secs()),
            },
            position: self.music_position(now),
            live_light: self.pipeline.light.live().names().map(str::to_owned).collect(),
            wait: RunWait {
                cue: self.cue().map(str::to_owned),
                may_go_on: self.may_go_on(context),
                robots: self.waiting_for(context, now),
            },
            repeats: self.repeats(),
            dropouts: self.tally.dropouts,
        }
    }

    /// Returns the name of the cue at which the run waits for GO; `None` if it does not wait.
    fn cue(&self) -> Option<&str> {
        let frame = self.pipeline.leg().map_or(usize::MAX, |leg| leg.frame);
        self.playback.waits_for_go.then(|| self.playback.cue(frame).unwrap_or_default())
    }

    /// Whether the run waits for GO and is not paused, and the air time of the frame that has the cue is over.
    pub fn is_at_cue(&self, now: Instant) -> bool {
        let RunPhase::Standing(standing) = &self.phase else { return false };
        self.playback.waits_for_go && !self.playback.paused && now >= standing.air.until
    }

    fn doing(&self, context: &Context) -> &'static str {
        match &self.phase {
            RunPhase::Interrupted(_) if !context.outbox.linked() => "waiting for the broker",
            RunPhase::Interrupted(interrupted) if interrupted.asks_operator() => "waiting for you to go on",
            RunPhase::Interrupted(_) => "waiting for robots to report",
            RunPhase::Gathering(gathering) if gathering.waits_for_clocks_only(context, &self.roster) => {
                "waiting for robots to set their clocks"
            }
            RunPhase::Gathering(_) => "asking robots where they are",
            RunPhase::Starting(_) => "starting",
            RunPhase::Driving(drive) if drive.clock.hold.is_some() => "holding",
            RunPhase::Driving(_) => "driving",
            RunPhase::Standing(_) if self.playback.waits_for_go => "waiting for GO",
            RunPhase::Standing(_) if self.is_frame_reached() => "showing",
            RunPhase::Standing(_) if self.pipeline.planning.pending.is_some() => "planning",
            RunPhase::Standing(_) => "uploading routes",
            RunPhase::Over(..) => "over",
        }
    }

    /// Whether the operator can let an interrupted run go on: the broker is connected and a robot reports again.
    pub fn may_go_on(&self, context: &Context) -> bool {
        let RunPhase::Interrupted(interrupted) = &self.phase else { return false };
        context.outbox.linked() && interrupted.is_any_back()
    }

    fn share(&self, now: Instant) -> f64 {
        let share = |past: Span, whole: Span| {
            if whole.0 > 0 { (past.as_secs() / whole.as_secs()).clamp(0.0, 1.0) } else { 1.0 }
        };
        match (&self.phase, &self.pipeline.driven) {
            (RunPhase::Driving(drive), Some(driven)) => match driven.leg.kind {
                LegKind::Targets => driven.targets.share(&driven.leg),
                LegKind::Routes => share(drive.clock.path_time(now), driven.leg.duration),
            },
            (RunPhase::Standing(standing), _) if standing.air.left.is_none() => {
                share(now - standing.air.since, standing.air.until - standing.air.since)
            }
            _ => 0.0,
        }
    }

    fn waiting_for(&self, context: &Context, now: Instant) -> Vec<RobotId> {
        let id = |robot: usize| context.fleet.robot(robot).id;
        if let RunPhase::Gathering(gathering) = &self.phase {
            return gathering.awaited(context, &self.roster).take(WAITING_MAX).map(id).collect();
        }
        let (RunPhase::Driving(drive), Some(driven)) = (&self.phase, &self.pipeline.driven) else {
            return Vec::new();
        };
        let is_overdue = now > drive.clock.ends && driven.leg.kind == LegKind::Routes;
        let holds_up = |&(participant, _): &(usize, _)| {
            let progress = &drive.progress[participant];
            progress.late_since.is_some()
                || driven.targets.is_stalled(participant)
                || is_overdue && !progress.arrived && driven.leg.is_driven_by(participant)
        };
        let late = self.roster.active().filter(holds_up).take(WAITING_MAX);
        late.map(|(_, known)| id(known.robot)).collect()
    }

    /// Adds to the view of a robot what the run knows of this robot. Of one that dropped out, only that it takes no
    /// part. `participant`: its participant number.
    pub fn complete(&self, view: &mut RobotView, participant: usize, now: Instant) {
        let Some(known) = self.roster.participants.get(participant) else { return };
        view.takes_part = !known.is_excluded();
        let Some(leg) = self.pipeline.leg() else { return };
        let Some(step) = leg.robots.get(participant).filter(|_| !known.is_excluded()) else { return };
        view.pixel = step.pixel.filter(|_| self.playback.purpose.is_of_show());
        view.goal = Some(step.goal);
        if let Some(colour) = self.pipeline.light.colour(now, (leg, self.pipeline.queue.front()), participant)
        {
            view.light = colour;
        }
        if let (RunPhase::Driving(drive), LegKind::Routes) = (&self.phase, leg.kind) {
            let place = |path: &Path| path.as_ref().at(drive.clock.path_time(now)).position;
            view.planned = leg.path(participant).map(place);
        }
    }
}

impl Controller {
    /// Returns the state of controller, run and fleet at `now`. The call takes time in proportion to the size of the
    /// fleet.
    pub fn snapshot(&self, now: Instant) -> Snapshot {
        Snapshot {
            at: now,
            state: self.state(),
            connected: self.context.outbox.linked(),
            show: self.show.as_ref().map(|show| show.name.clone()),
            looping: self.looping,
            speed_percent: self.speed_percent,
            run: self.run.as_ref().map(|run| run.view(&self.context, now)),
            failure: self.failure.clone(),
            stopped_in: self.stopped_in,
            preflight: self.preflight.clone(),
            robots: self.robot_views(now),
            counters: self.counters(),
        }
    }

    fn robot_views(&self, now: Instant) -> Vec<RobotView> {
        let view = |robot: &crate::robot::KnownRobot| {
            let mut view = robot.view();
            if let (Some(run), Some(participant)) = (&self.run, robot.participant) {
                run.complete(&mut view, participant as usize, now);
            }
            view
        };
        self.context.fleet.robots().iter().map(view).collect()
    }

    /// Returns the paths of the drive that is under way or about to begin, for drawing. A drive is about to begin once
    /// START was sent. `None` if there is none, or if robots drive by TARGET.
    pub fn paths(&self) -> Option<PathsView<'_>> {
        let run = self.run.as_ref()?;
        let (leg, began) = run.driven_paths()?;
        let name = |participant: usize| run.roster.robot(&self.context, participant).id;
        let paths = (0..leg.robots.len()).filter_map(|one| Some((name(one), leg.path(one)?))).collect();
        Some(PathsView { frame: leg.frame, began, paths })
    }

    /// Returns the number of the pass through a loop of frames that is under way, counted from 1. `None` if no loop is
    /// under way, or the operator gave GO.
    pub fn loop_round(&self) -> Option<u32> {
        let repeats = self.run.as_ref()?.repeats()?;
        (!repeats.leaves).then_some(repeats.round)
    }

    /// Returns the colours that layers of light give at `now` to robots that support LIGHT. Empty if the show has no
    /// layers and no live light was used, and while robots blend from one light to another. Also empty unless robots
    /// drive, are about to start, or stand.
    pub fn layered_lights(&self, now: Instant) -> Vec<(RobotId, Rgb)> {
        let Some(Run { pipeline, roster, phase, .. }) = &self.run else { return Vec::new() };
        let plays = matches!(phase, RunPhase::Driving(_) | RunPhase::Standing(_) | RunPhase::Starting(_));
        let Some(leg) = pipeline.leg().filter(|_| plays && !pipeline.light.blends(now)) else {
            return Vec::new();
        };
        let colour = |(participant, _)| {
            let robot = roster.robot(&self.context, participant);
            robot.reported.abilities.light.then_some(())?;
            let colour = pipeline.light.colour(now, (leg, pipeline.queue.front()), participant)?;
            Some((robot.id, colour))
        };
        roster.active().filter_map(colour).collect()
    }

    /// Returns the planned places of robots at `now` on the paths of the drive under way, stage metres. Empty if no
    /// routes are being driven.
    pub fn planned_places(&self, now: Instant) -> Vec<(RobotId, Vec2)> {
        let Some(Run { phase: RunPhase::Driving(drive), pipeline, roster, .. }) = &self.run else {
            return Vec::new();
        };
        let Some(leg) = pipeline.leg().filter(|leg| leg.kind == LegKind::Routes) else { return Vec::new() };
        let time = drive.clock.path_time(now);
        let place = |participant: usize| {
            let at = leg.path(participant)?.as_ref().at(time).position;
            Some((roster.robot(&self.context, participant).id, at))
        };
        (0..leg.robots.len().min(roster.len())).filter_map(place).collect()
    }
}

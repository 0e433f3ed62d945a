//! All changes of phase of a run; no other file changes a phase.
//!
//! A phase returns [`Next`] to request a change. A leg is the drive of all robots between two moments at which all
//! stand. A participant is a robot that takes part in the run, or took part before it dropped out.

use crate::context::Context;
use crate::event::{EventKind, Trouble};
use crate::journal::Position;
use crate::leg::LegKind;
use crate::mutant::Mutant;
use crate::run::candidates;
use crate::run::driving::Driving;
use crate::run::gathering::Gathering;
use crate::run::interrupted::Interrupted;
use crate::run::link::LinkEstimate;
use crate::run::link_loss::{self, Verdict};
use crate::run::membership::Probation;
use crate::run::next::{AirTime, Dropout, Next};
use crate::run::phase::RunPhase;
use crate::run::pipeline::Pipeline;
use crate::run::playback::{PlayedShow, RunPurpose};
use crate::run::preflight_check::PreflightCheck;
use crate::run::roster::{Roster, Whereabouts};
use crate::run::run_context::RunContext;
use crate::run::standing::Standing;
use crate::run::starting::Starting;
use crate::run::tally::Tally;
use lightbots_base::{Instant, RobotId, Span};
use lightbots_plan::Claims;

/// Everything about one run.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// The show that is played, and how far it has come.
    pub playback: PlayedShow,
    /// The robots that take part.
    pub roster: Roster,
    /// What is planned, uploaded and driven.
    pub pipeline: Pipeline,
    /// How slow and lossy the link is.
    pub link: LinkEstimate,
    /// The present phase.
    pub phase: RunPhase,
    /// Counts of frames and dropouts, times of arrivals, and what recovery from dropouts and waits for clocks have
    /// cost.
    pub tally: Tally,
    /// The checks of a preflight. `None` if the run is no preflight.
    pub preflight: Option<PreflightCheck>,
}

impl Run {
    pub fn split<'a>(&'a mut self, io: &'a mut Context, now: Instant) -> (&'a mut RunPhase, RunContext<'a>) {
        let Self { playback, roster, pipeline, link, phase, tally, .. } = self;
        (phase, RunContext { now, io, playback, roster, pipeline, link, tally })
    }

    pub fn apply(&mut self, io: &mut Context, now: Instant, mut next: Next) {
        while !next.stays() {
            next = self.change(io, now, next);
        }
    }

    pub fn next_at_tick(&mut self, io: &mut Context, now: Instant) -> Next {
        if matches!(self.phase, RunPhase::Standing(_)) {
            self.update_roster(io, now);
        }
        let next = self.check_preflight(io, now);
        if !next.stays() {
            return next;
        }
        let (phase, mut cx) = self.split(io, now);
        match phase {
            RunPhase::Gathering(gathering) => gathering.on_tick(&mut cx),
            RunPhase::Standing(standing) => standing.on_tick(&mut cx),
            RunPhase::Starting(starting) => starting.on_tick(&mut cx),
            RunPhase::Driving(drive) => drive.on_tick(&mut cx),
            RunPhase::Interrupted(interrupted) => interrupted.on_tick(&mut cx),
            RunPhase::Over(..) => Next::Stay,
        }
    }

    fn check_preflight(&mut self, io: &mut Context, now: Instant) -> Next {
        let Some(mut check) = self.preflight.take() else { return Next::Stay };
        let is_frame_reached = self.is_frame_reached();
        let (phase, mut cx) = self.split(io, now);
        let next = match phase {
            RunPhase::Driving(drive) => check.on_driving(drive, &mut cx),
            RunPhase::Standing(_) => check.on_standing(&mut cx, is_frame_reached),
            RunPhase::Starting(_) => {
                check.on_starting(&cx);
                Next::Stay
            }
            RunPhase::Gathering(_) | RunPhase::Interrupted(_) | RunPhase::Over(..) => Next::Stay,
        };
        self.preflight = Some(check);
        next
    }

    fn update_roster(&mut self, io: &mut Context, now: Instant) {
        let (_, mut cx) = self.split(io, now);
        if candidates::admit(&mut cx) || cx.pipeline.planning.is_outdated {
            self.regather(io, now);
        }
    }

    fn change(&mut self, io: &mut Context, now: Instant, next: Next) -> Next {
        match next {
            Next::Stay => Next::Stay,
            Next::Stand(air) => self.stand(io, now, air),
            Next::Start(earliest) => {
                assert!(matches!(self.phase, RunPhase::Standing(_)), "only robots that stand can start");
                let starting = Starting::begin(&mut self.split(io, now).1, earliest);
                self.enter(RunPhase::Starting(starting));
                Next::Stay
            }
            Next::Drive(began) => self.drive(io, now, began),
            Next::Regather => {
                self.regather(io, now);
                Next::Stay
            }
            Next::Interrupt(silent) => {
                self.interrupt(io, now, silent);
                Next::Stay
            }
            Next::GoOn => {
                self.go_on_from_where_robots_stand(io, now);
                Next::Stay
            }
            Next::Drop(dropped) => self.drop(io, now, dropped),
            Next::Over(outcome) => {
                let frame = self.frame();
                self.enter(RunPhase::Over(outcome, frame));
                Next::Stay
            }
        }
    }

    fn stand(&mut self, io: &mut Context, now: Instant, air: AirTime) -> Next {
        let may_stand = matches!(self.phase, RunPhase::Gathering(_) | RunPhase::Driving(_));
        assert!(may_stand, "robots stand after they drove or were gathered");
        self.enter(RunPhase::Standing(Standing::begin(now, air)));
        self.next_at_tick(io, now)
    }

    fn drive(&mut self, io: &mut Context, now: Instant, began: Instant) -> Next {
        let kind = self.pipeline.queue.front().map(|leg| leg.kind);
        match self.phase {
            RunPhase::Starting(_) => assert!(kind == Some(LegKind::Routes), "a START begins routes"),
            RunPhase::Standing(_) => assert!(kind == Some(LegKind::Targets), "routes begin with a START"),
            _ => panic!("only robots that stand or start can drive"),
        }
        let (drive, next) = Driving::begin(&mut self.split(io, now).1, began);
        self.enter_drive(drive);
        next
    }

    fn drop(&mut self, io: &mut Context, now: Instant, dropped: Vec<Dropout>) -> Next {
        assert!(!dropped.is_empty(), "a drop has participants");
        let dropped = match self.without_lost_link(io, now, dropped) {
            Ok(dropped) => dropped,
            Err(next) => return next,
        };
        let was_gathering = matches!(self.phase, RunPhase::Gathering(_));
        for (participant, why) in dropped {
            self.drop_out(io, now, participant, why);
        }
        // The remaining robots may all be ready by now.
        if was_gathering { self.next_at_tick(io, now) } else { Next::Stay }
    }

    /// Returns those of `dropped` that drop out now. Silent robots do not drop out while it is unknown whether the link
    /// is lost, unless the run is interrupted already. `Err`: no robot drops out now, and the run makes this change
    /// instead.
    fn without_lost_link(
        &mut self,
        io: &mut Context,
        now: Instant,
        dropped: Vec<Dropout>,
    ) -> Result<Vec<Dropout>, Next> {
        if matches!(self.phase, RunPhase::Interrupted(_)) {
            return Ok(dropped);
        }
        let (phase, mut cx) = self.split(io, now);
        let is_starting = matches!(phase, RunPhase::Starting(_));
        let (silent, others): (Vec<_>, Vec<_>) =
            dropped.into_iter().partition(|dropout| link_loss::is_by_silence(&cx, dropout));
        if silent.is_empty() {
            return Ok(others);
        }
        match link_loss::judge(&mut cx, &silent, is_starting) {
            Verdict::RobotsLost => Ok(silent.into_iter().chain(others).collect()),
            Verdict::LinkLost(silent) => Err(Next::Interrupt(Some(silent))),
            Verdict::Unknown if others.is_empty() => Err(Next::Stay),
            Verdict::Unknown => Ok(others),
        }
    }

    fn drop_out(&mut self, io: &mut Context, now: Instant, participant: usize, why: Trouble) {
        if self.roster.is_excluded(participant) {
            return;
        }
        let known = &mut self.roster.participants[participant];
        known.membership.exclude(why, self.tally.frames_played);
        known.probation = Probation::after(why);
        self.pipeline.lights.settle(participant);
        self.tally.dropouts += 1;
        if let Some(check) = &mut self.preflight {
            check.drop_out(participant, why);
        }
        self.roster.changes += 1;
        self.roster.participants[participant].last_seen = self.whereabouts(io, now, participant, why);
        let robot = self.roster.robot(io, participant).id;
        io.log.record(now, EventKind::Dropout { robot, why });
        self.tally.recovery.dropped_out(robot, why);
        self.tally.recovery.begins(self.reached_by(now));
        self.regather(io, now);
    }

    /// The places where a robot that drops out now may stand. Empty if it stands at the place that it reported last.
    fn whereabouts(
        &mut self,
        io: &mut Context,
        now: Instant,
        participant: usize,
        why: Trouble,
    ) -> Whereabouts {
        let robot = self.roster.robot(io, participant);
        let (reported, last) = (robot.reported.at, robot.standstill.at);
        match why {
            Trouble::Shared => {
                let places = robot.namesakes.places();
                Whereabouts { possible: places.clone(), likely: places }
            }
            // The robot does not know where it is. It stopped at once on its path, or had not yet left the place
            // where it last stood.
            _ if reported.is_none() && !Mutant::ForgetLostRobot.is_planted() => {
                let mut places = self.whereabouts_on_path(io, now, participant);
                places.possible.extend(last);
                places.likely.extend(last);
                places
            }
            // A robot that does not acknowledge and is silent may have begun a drive after its last report.
            _ if self.is_lost_by_silence(io, now, (participant, why)) => {
                self.whereabouts_on_path(io, now, participant)
            }
            _ => Whereabouts::default(),
        }
    }

    fn is_lost_by_silence(&mut self, io: &mut Context, now: Instant, dropout: Dropout) -> bool {
        link_loss::is_by_silence(&self.split(io, now).1, &dropout)
    }

    fn whereabouts_on_path(&mut self, io: &mut Context, now: Instant, participant: usize) -> Whereabouts {
        let (phase, cx) = self.split(io, now);
        phase.whereabouts(&cx, participant)
    }

    fn reached_by(&self, now: Instant) -> Instant {
        let takes = self.pipeline.queue.front().map_or(Span::ZERO, |leg| leg.duration);
        match &self.phase {
            RunPhase::Driving(drive) => drive.clock.ends,
            RunPhase::Starting(starting) => starting.at + takes,
            _ => now + takes,
        }
    }

    pub fn regather(&mut self, io: &mut Context, now: Instant) {
        self.drop_plans(io);
        let is_over = matches!(self.phase, RunPhase::Over(..));
        if is_over || matches!(self.phase, RunPhase::Interrupted(_) | RunPhase::Gathering(_)) {
            return;
        }
        self.report_replanning(io, now);
        self.gather_what_moves(io, now);
    }

    /// Stops all robots and asks where they are. In phase Standing without TARGET-only robots, robots stand already and
    /// report of their own accord. It then only notes that they may stand off their goals.
    pub fn gather_what_moves(&mut self, io: &mut Context, now: Instant) {
        // TARGET-only robots (they understand the command TARGET but no routes) report only when asked: their last
        // reports may be old.
        if !matches!(self.phase, RunPhase::Standing(_)) || self.roster.has_target_robots(io) {
            let left = self.phase.left(&self.pipeline);
            self.gather(io, now, left);
        } else if let RunPhase::Standing(standing) = &mut self.phase {
            // A robot may have been moved, so its reported place counts rather than its goal.
            standing.air.is_at_goals = false;
        }
    }

    pub fn gather(&mut self, io: &mut Context, now: Instant, left: Position) {
        let gathering = Gathering::begin(&mut self.split(io, now).1, left);
        self.enter(RunPhase::Gathering(gathering));
    }

    /// Interrupts the run until robots report again. `silent` is the number of silent robots; `None` if the connection
    /// to the broker is lost. Does nothing if the run is interrupted already or over.
    fn interrupt(&mut self, io: &mut Context, now: Instant, silent: Option<usize>) {
        if matches!(self.phase, RunPhase::Interrupted(_) | RunPhase::Over(..)) {
            return;
        }
        let left = self.phase.left(&self.pipeline);
        if matches!(self.phase, RunPhase::Starting(_)) {
            // Robots may have started on this leg, although no report of that arrives.
            self.pipeline.drive_next();
        }
        self.drop_plans(io);
        io.outbox.stop_repeating();
        if let Some(silent) = silent {
            let robots = self.roster.active().count();
            io.log.record(now, EventKind::LinkLost { silent, robots });
        }
        let by_itself = io.config.waits.goes_on_within;
        // If only some robots fell silent, the link broke about when the last of their reports was received.
        let silence = if silent.is_some() { io.config.silence } else { Span::ZERO };
        let heard = self.roster.active().map(|(_, known)| io.fleet.robot(known.robot).contact.heard);
        let broke = heard.filter(|heard| now - *heard >= silence).max();
        let interrupted = Interrupted::begin(now, left, by_itself).broke(broke.unwrap_or(now));
        self.enter(RunPhase::Interrupted(interrupted));
    }

    /// Leaves phase Interrupted for Gathering, because robots report again. Everything is then planned from where they
    /// stand.
    fn go_on_from_where_robots_stand(&mut self, io: &mut Context, now: Instant) {
        let RunPhase::Interrupted(interrupted) = &self.phase else { return };
        let left = interrupted.left;
        self.tally.recovery.put_off(now - interrupted.since);
        self.link.reconnected = Some(now);
        self.report_replanning(io, now);
        let gathering = Gathering::begin(&mut self.split(io, now).1, left);
        self.enter(RunPhase::Gathering(gathering));
    }

    /// Drops all queued legs and the plan request, because robots will not stand where these begin.
    pub fn drop_plans(&mut self, io: &mut Context) {
        let next = (!self.playback.is_ended()).then_some(self.playback.next);
        self.pipeline.clear(next);
        io.plan_request = None;
        io.mapping.shown = self.shown(io);
        self.tally.arrivals = None;
    }

    pub fn enter(&mut self, phase: RunPhase) {
        assert!(!matches!(self.phase, RunPhase::Over(..)), "a run that is over goes on");
        self.pipeline.upload_from = Instant::ZERO;
        self.pipeline.lights.end_drive();
        self.phase = phase;
    }

    fn enter_drive(&mut self, drive: Driving) {
        assert!(drive.progress.len() == self.roster.len(), "a participant has no progress");
        self.phase = RunPhase::Driving(drive);
    }

    fn shown(&self, io: &Context) -> Claims<RobotId> {
        let robots = self.pipeline.leg().map_or(&[][..], |leg| &leg.robots);
        let mut shown = Claims::default();
        for (participant, known) in self.roster.active() {
            if let Some(pixel) = robots.get(participant).and_then(|step| step.pixel) {
                shown.show(pixel, io.fleet.robot(known.robot).id);
            }
        }
        shown
    }

    pub fn report_replanning(&self, io: &mut Context, now: Instant) {
        // A preflight stops robots on purpose.
        let is_news = self.playback.purpose != RunPurpose::Preflight;
        if let Some(next) = self.pipeline.planning.next.filter(|_| is_news) {
            io.log.record_limited(now, EventKind::Replanning { frame: next.frame });
        }
    }

    /// Index, from 0, of the frame in which robots stand, or else of the frame that they drive to or are to drive to
    /// next. For a run that is over: the frame at which it ended.
    pub fn frame(&self) -> usize {
        let reached = self.pipeline.leg().map(|leg| leg.frame);
        match &self.phase {
            RunPhase::Over(_, frame) => *frame,
            RunPhase::Starting(_) => self.playback.shown_frame(),
            _ if self.playback.jump.is_some() && !self.is_frame_reached() => self.playback.shown_frame(),
            _ => reached.unwrap_or(self.playback.shown_frame()),
        }
    }

    /// Whether robots have reached [`frame`](Self::frame) and are not leaving it. `false` in phases Starting, Driving
    /// and Over, and while robots are to leave at once for a frame that the operator chose.
    pub fn is_frame_reached(&self) -> bool {
        let Some(leg) = self.pipeline.leg().filter(|leg| leg.reaches_frame) else { return false };
        let towards = self.playback.jump.map_or(self.playback.next, |jump| jump.instead_of);
        match &self.phase {
            RunPhase::Starting(_) | RunPhase::Driving(_) | RunPhase::Over(..) => false,
            // Once robots have reached a frame, `next` is another one.
            _ => !self.playback.leaves() && leg.cursor() != towards,
        }
    }
}

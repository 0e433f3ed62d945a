//! A run plays one show on live robots. This module has its phases (robots stand, start, drive …), which own their
//! data, and the state that outlives a phase.
//!
//! This file passes each input of a run to the present phase. The phase returns [`Next`], the change of phase that it
//! requests, and `machine` makes that change. A phase reaches the rest of the run through a [`RunContext`]; it never
//! sees [`Run`].
//!
//! A leg is the drive of all robots between two moments at which all stand; a drive to a frame takes one leg or
//! several. A participant is a robot that takes part in the run, or took part before it dropped out.

mod bystanders;
mod candidates;
mod clock_wait;
mod driving;
mod gathering;
mod interrupted;
mod jumping;
mod keeping_up;
mod light_leg;
mod light_player;
mod lights;
mod link;
mod link_loss;
mod looping;
mod machine;
mod membership;
mod misplaced;
mod misplacements;
mod music_time;
mod next;
mod obstacles;
mod outdated_journal;
mod path_clock;
mod phase;
mod pipeline;
mod playback;
mod preflight_check;
mod probation;
mod readiness;
mod recovery_bound;
mod reports;
mod requests;
mod roster;
mod run_context;
mod show_position;
mod show_times;
mod silence;
mod standing;
mod starting;
mod stop_times;
mod tally;
mod target_commands;
mod target_progress;
mod upload;

pub(crate) use light_player::{LIVE_MAX, NAME_MAX};
pub(crate) use machine::Run;
pub(crate) use membership::{Membership, Probation};
pub(crate) use music_time::MusicTime;
pub(crate) use next::AirTime;
pub(crate) use path_clock::PathClock;
pub(crate) use phase::RunPhase;
pub(crate) use playback::{PlayedShow, RunPurpose};
pub(crate) use preflight_check::PreflightCheck;
pub(crate) use roster::{Participant, Roster, Whereabouts};
pub(crate) use stop_times::StopTimes;

use crate::context::Context;
use crate::event::{EventKind, RunOutcome};
use crate::journal::Position;
use crate::leg::{Leg, LegKind};
use crate::plan_request::PlanResult;
use crate::robot::LastRun;
use gathering::Gathering;
use interrupted::Interrupted;
use lightbots_base::{Instant, Span};
use lightbots_lighting::LiveLayers;
use lightbots_wire::RobotState;
use link::LinkEstimate;
use next::Next;
use pipeline::{DrivenLeg, Pipeline};
#[cfg(doc)]
use run_context::RunContext;
use std::ops::ControlFlow;
use tally::Tally;
use target_progress::TargetProgress;

impl Run {
    /// Creates a run with all robots of the fleet that can take part, and records an event. If any of them does not
    /// report that it is idle, the run begins by stopping all robots and asking where they are.
    pub fn begin(context: &mut Context, now: Instant, playback: PlayedShow) -> Self {
        context.mapping.shown.clear();
        let roster = Roster::of_fleet(context, now);
        let from = playback.next.frame;
        let robots = roster.len();
        context.log.record(
            now,
            match playback.purpose {
                RunPurpose::Home => EventKind::GoingHome { robots },
                RunPurpose::Preflight => EventKind::PreflightBegun { robots },
                _ => EventKind::RunBegun { from, robots },
            },
        );
        // TARGET-only robots (they understand the command TARGET but no routes) do not report whether they drive.
        // Their places count once they stay the same.
        let may_drive = (0..roster.len()).any(|participant| {
            let robot = roster.robot(context, participant);
            robot.is_original() || robot.reported.state != Some(RobotState::Idle)
        });
        let mut run = Self {
            pipeline: Pipeline::new(&playback),
            playback,
            roster,
            link: LinkEstimate::default(),
            phase: RunPhase::Gathering(Gathering::at_begin(now)),
            tally: Tally::default(),
            preflight: None,
        };
        if may_drive {
            run.gather(context, now, Position::default());
        }
        run
    }

    /// Creates a run in phase Interrupted: its robots are out of reach at present. `leg` is the leg that they drive or
    /// drove last. `left` is the drive, or the stay in a frame, that was interrupted. The run goes on without the
    /// operator if robots report again within `by_itself`. `broke` estimates when the link broke.
    pub fn interrupted(
        now: Instant,
        playback: PlayedShow,
        roster: Roster,
        leg: Option<Leg>,
        (left, by_itself, broke): (Position, Span, Instant),
    ) -> Self {
        let driven = leg.map(|leg| DrivenLeg { targets: TargetProgress::of_journal(&leg), leg });
        Self {
            pipeline: Pipeline { driven, ..Pipeline::new(&playback) },
            playback,
            roster,
            link: LinkEstimate::default(),
            phase: RunPhase::Interrupted(Interrupted::begin(now, left, by_itself).broke(broke)),
            tally: Tally::default(),
            preflight: None,
        }
    }

    /// Releases the robots at the end of the run. Notes in the fleet table for each participant whether it may still
    /// keep a route, and its pixel and goal. Robots that dropped out get neither pixel nor goal. A drive home and a
    /// preflight leave no pixels.
    pub fn leave(&mut self, context: &mut Context) {
        for (participant, known) in self.roster.participants.iter().enumerate() {
            let step = self.pipeline.leg().and_then(|leg| leg.robots.get(participant));
            let step = step.filter(|_| !known.is_excluded());
            let robot = context.fleet.robot_mut(known.robot);
            robot.participant = None;
            robot.last_run = LastRun {
                may_keep_route: !robot.is_original(),
                stop_sent: None,
                pixel: step.and_then(|step| step.pixel).filter(|_| self.playback.purpose.is_of_show()),
                goal: step.map(|step| step.goal),
            };
        }
    }

    /// Does what is due at `now`.
    pub fn on_tick(&mut self, io: &mut Context, now: Instant) {
        self.tally.recovery.pause(now, self.playback.waits());
        self.tick_phase(io, now);
        self.follow_music(now);
        self.keep_up_with_music(io, now);
    }

    fn tick_phase(&mut self, io: &mut Context, now: Instant) {
        let next = self.next_at_tick(io, now);
        self.apply(io, now, next);
    }

    /// The show-clock moment at which [`on_tick`](Self::on_tick) has to be called next; [`Instant::FAR`] if no call is
    /// due.
    pub fn due(&self, io: &Context, now: Instant) -> Instant {
        let checked = self.preflight.as_ref().map_or(Instant::FAR, PreflightCheck::due);
        checked.min(self.phase_due(io, now))
    }

    fn phase_due(&self, io: &Context, now: Instant) -> Instant {
        match &self.phase {
            RunPhase::Gathering(gathering) => gathering.due(now),
            RunPhase::Standing(standing) => {
                let start_lead = self.link.start_lead(&io.config, self.roster.len());
                let due = standing.due(&self.pipeline, start_lead, now, self.playback.waits());
                due.min(self.pipeline.light.due(now))
            }
            RunPhase::Starting(starting) => {
                starting.due().min(self.pipeline.due()).min(self.pipeline.light.due(now))
            }
            RunPhase::Driving(drive) => {
                let lights = self.pipeline.lights.due().min(self.pipeline.light.due(now));
                drive.due().min(lights).min(self.pipeline.due())
            }
            RunPhase::Interrupted(interrupted) => interrupted.due(now),
            RunPhase::Over(..) => Instant::FAR,
        }
    }

    /// Takes in the result of a plan request, and continues the phase with the new plan. Ignores a result that is not
    /// awaited.
    pub fn on_plan(&mut self, io: &mut Context, now: Instant, result: PlanResult) {
        let is_standing = matches!(self.phase, RunPhase::Standing(_));
        let (_, mut cx) = self.split(io, now);
        let next = match requests::accept(&mut cx, result, is_standing) {
            ControlFlow::Break(next) => return self.apply(io, now, next),
            ControlFlow::Continue(next) => next,
        };
        self.apply(io, now, next);
        match self.phase {
            RunPhase::Standing(_) => self.tick_phase(io, now),
            RunPhase::Driving(_) => {
                let next = self.split(io, now).1.pump();
                self.apply(io, now, next);
            }
            _ => {}
        }
    }

    /// Resumes a paused run for the operator. With `step`, robots that stand leave at once, even if they wait for GO,
    /// and the run pauses again in the next frame. Without `step`, a wait for GO goes on.
    pub fn resume(&mut self, io: &mut Context, now: Instant, step: bool) {
        (self.playback.paused, self.playback.stepping) = (false, step);
        self.playback.waits_for_go &= !step;
        let (phase, mut cx) = self.split(io, now);
        match phase {
            RunPhase::Standing(standing) if step => standing.leave_now(now),
            RunPhase::Driving(drive) => drive.resume(&mut cx),
            _ => {}
        }
    }

    /// Handles the operator's GO, which ends the wait at a cue. Must not be called while the run is paused. Robots that
    /// stand leave at once: the rest of the air time (how long the show keeps robots in a frame) is dropped. The music
    /// goes on from the position of the show.
    pub fn go(&mut self, now: Instant) {
        self.playback.waits_for_go = false;
        self.playback.music.seen = None;
        if let RunPhase::Standing(standing) = &mut self.phase {
            standing.leave_now(now);
        }
    }

    /// Applies the operator's change of live light (light layers that are added while the show plays).
    pub fn set_live_light(&mut self, io: &mut Context, now: Instant, live: LiveLayers) {
        let Pipeline { light, driven, .. } = &mut self.pipeline;
        light.set_live(io, (&self.roster, driven.as_ref().map(|driven| &driven.leg)), now, live);
    }

    /// Ends live light because the show was played to its end. Robots then show only the light that the show has for
    /// their frame.
    pub fn end_live_light(&mut self, io: &mut Context, now: Instant) {
        let Pipeline { light, driven, .. } = &mut self.pipeline;
        if let Some(driven) = driven {
            light.end_live(io, &self.roster, now, &driven.leg);
        }
    }

    /// Sets whether the show starts again after its last frame, and plans or drops the next round.
    pub fn set_looping(&mut self, io: &mut Context, now: Instant, looping: bool) {
        let is_starting = matches!(self.phase, RunPhase::Starting(_));
        requests::set_looping(&mut self.split(io, now).1, looping, is_starting);
    }

    /// Ends the run because the operator aborts it.
    pub fn abort(&mut self, io: &mut Context, now: Instant) {
        self.apply(io, now, Next::Over(RunOutcome::Aborted));
    }

    /// The moment at which robots begin to slow down together on their paths before STOP, if all are to be stopped now.
    /// `None` if STOP is to be sent at once. This is the case if robots stand, have not started, are out of reach,
    /// drive by TARGET, or arrive before that moment.
    pub fn holds_before_stop(&mut self, io: &mut Context, now: Instant) -> Option<Instant> {
        let (phase, cx) = self.split(io, now);
        match phase {
            // STOP cancels a RESUME whose moment is still to come, so the hold does not wait for that RESUME.
            RunPhase::Driving(drive) => {
                let soonest = cx.now + cx.link.hold_lead();
                gathering::hold_before_stop(&cx, &drive.clock).map(|at| at.min(soonest))
            }
            RunPhase::Gathering(gathering) => gathering.held_from(),
            _ => None,
        }
    }

    /// Interrupts the run because the connection to the broker is lost. Without messages, robots that drive stop by
    /// themselves.
    pub fn on_disconnect(&mut self, io: &mut Context, now: Instant) {
        self.apply(io, now, Next::Interrupt(None));
    }

    /// Continues an interrupted run because the operator asks, without robots that do not report. Returns `false` and
    /// does nothing if the run is not interrupted, the broker is away, or no robot has reported since the interruption.
    pub fn go_on(&mut self, io: &mut Context, now: Instant) -> bool {
        let (phase, cx) = self.split(io, now);
        let RunPhase::Interrupted(interrupted) = phase else { return false };
        if !cx.io.outbox.linked() || !interrupted.is_any_back() {
            return false;
        }
        let next = interrupted.go_on(&cx);
        self.apply(io, now, next);
        true
    }

    /// The leg that robots drive, or are about to start, and the show-clock time at which it begins. `None` in other
    /// phases, and for legs that are driven by TARGETs instead of routes.
    pub fn driven_paths(&self) -> Option<(&Leg, Instant)> {
        let (leg, began) = match &self.phase {
            RunPhase::Starting(starting) => (self.pipeline.queue.front(), starting.at),
            RunPhase::Driving(drive) => (self.pipeline.leg(), drive.clock.began),
            _ => return None,
        };
        leg.filter(|leg| leg.kind == LegKind::Routes).map(|leg| (leg, began))
    }
}

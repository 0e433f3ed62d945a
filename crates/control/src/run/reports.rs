//! What a run does with a report of a robot: it notes what the robot has acknowledged, and the present phase handles
//! the report.

use crate::context::Context;
use crate::event::Trouble;
use crate::fleet::FleetUpdate;
use crate::run::next::Next;
use crate::run::target_commands::PASSED_ERROR_M;
use crate::run::{Run, RunPhase, bystanders, candidates, lights, misplaced};
use lightbots_base::Instant;
use lightbots_wire::{Report, Topic};

impl Run {
    /// Handles a report of a robot. The fleet table has taken in the report before, with the result `received`.
    pub fn on_report(
        &mut self,
        io: &mut Context,
        now: Instant,
        received: FleetUpdate,
        topic: Topic,
        report: &Report,
    ) {
        let participant = io.fleet.robot(received.index).participant.map(|participant| participant as usize);
        let Some(participant) = participant.filter(|&one| !self.roster.is_excluded(one)) else {
            if topic == Topic::Arrival {
                io.report_unexpected(now, report);
            }
            self.roster.locate(io.fleet.robot(received.index));
            return self.on_bystander(io, now, received.index);
        };
        if io.fleet.robot(received.index).namesakes.are_there() {
            return self.apply(io, now, Next::drop(participant, Trouble::Shared));
        }
        if topic == Topic::Arrival || report.details.is_none() {
            let next = self.on_place(io, now, participant, topic, report);
            return self.apply(io, now, next);
        }
        self.on_status(io, now, participant, received.restarted, report);
    }

    /// Handles a report of a robot that takes no part or dropped out. The robot may become a candidate for the next
    /// frame. If it obstructs a path, all is planned again.
    fn on_bystander(&mut self, io: &mut Context, now: Instant, robot: usize) {
        let (phase, mut cx) = self.split(io, now);
        candidates::consider(&mut cx, robot, matches!(phase, RunPhase::Gathering(_)));
        let participant = cx.io.fleet.robot(robot).participant.map(|participant| participant as usize);
        let driven = match phase {
            RunPhase::Driving(drive) => Some(drive.clock.path_time(now)),
            RunPhase::Starting(_) => None,
            _ => return,
        };
        if participant.is_some_and(|participant| bystanders::obstructs(&mut cx, participant, driven)) {
            self.apply(io, now, Next::Regather);
        }
    }

    fn on_place(
        &mut self,
        io: &mut Context,
        now: Instant,
        participant: usize,
        topic: Topic,
        report: &Report,
    ) -> Next {
        let (phase, mut cx) = self.split(io, now);
        match (phase, &report.details) {
            (RunPhase::Driving(drive), _) => drive.on_report(&mut cx, participant, topic, report),
            (RunPhase::Starting(starting), Some(details)) => {
                starting.on_arrival(&mut cx, participant, details)
            }
            (RunPhase::Standing(_), _) => {
                let noise_m = if topic == Topic::Arrival { 0.0 } else { PASSED_ERROR_M };
                misplaced::check(&mut cx, participant, noise_m)
            }
            _ => Next::Stay,
        }
    }

    fn on_status(
        &mut self,
        io: &mut Context,
        now: Instant,
        participant: usize,
        restarted: bool,
        report: &Report,
    ) {
        let Some(details) = &report.details else { return };
        if let Some(check) = &mut self.preflight {
            check.on_report(now, participant, report.at, details);
        }
        let (_, mut cx) = self.split(io, now);
        let may_send = cx.pipeline.acknowledge(cx.link, now, participant, details);
        let next = if may_send { cx.pump() } else { Next::Stay };
        self.apply(io, now, next);
        let (phase, mut cx) = self.split(io, now);
        let next = match phase {
            RunPhase::Driving(drive) => drive.on_report(&mut cx, participant, Topic::Status, report),
            RunPhase::Standing(standing) => standing.on_report(&mut cx, participant, details, restarted),
            RunPhase::Starting(starting) => starting.on_report(&mut cx, participant, details, restarted),
            RunPhase::Gathering(_) | RunPhase::Interrupted(_) | RunPhase::Over(..) => Next::Stay,
        };
        self.apply(io, now, next);
        if let Some(driven) = self.pipeline.driven.as_ref().filter(|_| restarted) {
            let light = &self.pipeline.light;
            match light.is_active() {
                true => light.relight(io, &self.roster, now, &driven.leg, participant),
                false => lights::relight(io, &self.roster, &driven.leg, participant),
            }
        }
        self.keep_up_with_music(io, now);
        if matches!(self.phase, RunPhase::Standing(_)) && self.pipeline.is_uploaded() {
            self.tick_phase(io, now);
        }
    }
}

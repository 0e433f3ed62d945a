//! What a phase works with: the moment, the controller's context, and the parts of the run that outlive a phase.
//!
//! A leg is the drive of all robots between two moments at which all stand. The present leg is the leg that robots
//! drive, or drove last. The next leg is the first one in the queue. Participants are numbered in the order in which
//! they joined the run.

use crate::context::Context;
use crate::event::{EventKind, Trouble};
use crate::leg::LegKind;
use crate::robot::KnownRobot;
use crate::run::link::LinkEstimate;
use crate::run::next::Next;
use crate::run::pipeline::Pipeline;
use crate::run::playback::PlayedShow;
use crate::run::roster::{Participant, Roster};
use crate::run::tally::Tally;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::Command;

/// What a phase works with.
pub(crate) struct RunContext<'a> {
    pub now: Instant,
    /// Fleet, messages and events.
    pub io: &'a mut Context,
    pub playback: &'a mut PlayedShow,
    pub roster: &'a mut Roster,
    pub pipeline: &'a mut Pipeline,
    pub link: &'a mut LinkEstimate,
    pub tally: &'a mut Tally,
}

impl RunContext<'_> {
    /// The participant with this number.
    pub fn participant(&self, participant: usize) -> &Participant {
        &self.roster.participants[participant]
    }

    /// What the fleet table has about the robot of a participant.
    pub fn robot(&self, participant: usize) -> &KnownRobot {
        self.roster.robot(self.io, participant)
    }

    /// Sends commands to a participant.
    pub fn send(&mut self, participant: usize, commands: &[Command]) {
        self.io.send(self.participant(participant).robot, commands);
    }

    /// Whether the present leg ends only after this participant has arrived. `false` for robots that dropped out or
    /// that have no drive in the leg.
    pub fn is_awaited(&self, participant: usize) -> bool {
        let drives = self.pipeline.leg().is_some_and(|leg| leg.is_driven_by(participant));
        !self.roster.is_excluded(participant) && drives
    }

    /// The goal of a participant in the present leg, stage metres. `None` if there is no leg, or the participant joined
    /// after the leg was planned.
    pub fn goal(&self, participant: usize) -> Option<Vec2> {
        self.pipeline.leg().and_then(|leg| leg.goal(participant))
    }

    /// The place that a participant's robot reported last, stage metres. Without one: its goal in the present leg, or
    /// the stage's origin if it has no goal either.
    pub fn place(&self, participant: usize) -> Vec2 {
        let said = self.robot(participant).reported.at;
        said.or_else(|| self.goal(participant)).unwrap_or(Vec2::ZERO)
    }

    /// Whether the present leg is driven by TARGETs.
    pub fn is_target_leg(&self) -> bool {
        self.pipeline.leg().is_some_and(|leg| leg.kind == LegKind::Targets)
    }

    /// How long before its moment a START is to be sent. START names the moment at which all robots begin their routes.
    pub fn start_lead(&self) -> Span {
        self.link.start_lead(&self.io.config, self.roster.len())
    }

    /// The earliest moment for a START that is sent now: late enough for all robots, and later than every HOLD.
    pub fn earliest_start(&self) -> Instant {
        (self.now + self.start_lead()).max(self.io.outbox.start_after_holds())
    }

    /// Sends those routes of the next leg that may be sent now. Returns a dropout or a failure if robots do not
    /// acknowledge.
    pub fn pump(&mut self) -> Next {
        self.pipeline.pump(self.io, (self.playback, self.roster), self.link, self.now)
    }

    /// Makes the route of the next leg due again for a participant that acknowledged the route and lost it. Then does
    /// as [`pump`](Self::pump).
    pub fn upload_again(&mut self, participant: usize) -> Next {
        self.pipeline.upload_again(self.now, participant);
        self.pump()
    }

    /// Requests that all robots stop and are planned again, because a participant was cut off, lost its route, or began
    /// to drive alone. Records an event that names this participant.
    pub fn replan_with(&mut self, participant: usize) -> Next {
        self.report_waiting(participant, Trouble::Cut);
        Next::Regather
    }

    /// Sends changes of light that are due.
    pub fn pump_lights(&mut self) {
        let Pipeline { lights, light, queue, driven: Some(driven), .. } = &mut *self.pipeline else { return };
        light.look(self.now);
        if light.is_active() {
            light.pump(self.io, self.roster, self.now, (&driven.leg, queue.front()));
        } else {
            lights.pump(self.io, self.roster, self.now, &driven.leg);
        }
    }

    /// Records an event, at a bounded rate: all robots wait for this participant because of `why`.
    pub fn report_waiting(&mut self, participant: usize, why: Trouble) {
        let robot = self.robot(participant).id;
        self.io.log.record_limited(self.now, EventKind::Waiting { robot, why });
    }
}

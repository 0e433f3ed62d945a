//! The phase in which robots drive a leg: the drive of all robots between two moments at which all stand. All state
//! that belongs to one drive is kept here. Read [`drive`] first, then the files in the order of the list.

mod arrivals;
mod drive;
mod hold;
mod lateness;
mod obstruction;
mod sightings;
mod targets;
mod watch;

pub(crate) use arrivals::is_there;
pub(crate) use drive::Driving;

use crate::event::{EventKind, Trouble};
use crate::leg::LegKind;
use crate::run::lights;
use crate::run::next::Next;
use crate::run::path_clock::PathClock;
use crate::run::pipeline::Pipeline;
use crate::run::run_context::RunContext;
use crate::run::target_commands;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Details, Report, RobotState, Topic};

/// How often the START of the present drive is sent again, so that robots know that the link works. Without messages
/// they stop after 1.9 s (R43). If the link breaks while copies are on their way, robots receive different last copies.
/// The shorter the interval, the closer together in time they then stop.
const HEARTBEAT: Heartbeat =
    Heartbeat { a_robot: Span::from_millis(2), least: Span::from_millis(60), most: Span::from_millis(500) };
/// For how long after a drive began routes of the next leg are not sent. A robot with a clock a little behind has not
/// begun the drive yet. A new route would replace the one that it is about to drive.
const BEGUN: Span = drive::WATCH_EVERY;
/// For how long after a drive began a report may still describe the time before the drive.
const OLD_REPORTS: Span = Span::from_millis(800);
/// How long before the planned end a robot may end its route, because its clock is ahead.
const EARLY: Span = Span::from_millis(100);

/// Parameters of the time between two copies of START during a drive.
struct Heartbeat {
    /// Interval divided by the number of robots, because the broker delivers every copy to every robot. Fleets whose
    /// interval lies between `least` and `most` get 500 messages a second in all.
    a_robot: Span,
    least: Span,
    most: Span,
}

impl Heartbeat {
    /// Time between two copies. `rests`: robots stand in a hold. Then `most` is enough, because they stay where they
    /// are if the link breaks.
    fn every(&self, robots: usize, rests: bool) -> Span {
        let by_count = self.a_robot * i64::try_from(robots).unwrap_or(i64::MAX);
        if rests { self.most } else { by_count.clamp(self.least, self.most) }
    }
}

impl Driving {
    /// Begins the drive of the first leg of the queue, which is under way since `began` (show clock). The returned
    /// [`Next`] ends the leg if all robots have arrived already; it may also be a dropout or a failure from sending
    /// routes. Panics if no leg is queued.
    pub fn begin(cx: &mut RunContext, began: Instant) -> (Self, Next) {
        let leg = cx.pipeline.drive_next().expect("a drive begins with a planned leg");
        let clock = PathClock::new(began, leg.duration);
        let heartbeat_at = match leg.kind {
            LegKind::Routes => cx.now + HEARTBEAT.every(cx.roster.len(), false),
            LegKind::Targets => Instant::FAR,
        };
        let mut drive = Self::new(clock, cx.now, heartbeat_at, cx.roster.len());
        let (frame, duration) = (leg.frame, leg.duration);
        if cx.playback.purpose.is_of_show() {
            cx.io.log.record(cx.now, EventKind::TransitionStarted { frame, starts: began, duration });
        }
        cx.pipeline.upload = None;
        cx.pipeline.upload_from = began + BEGUN;
        drive.begin_leg(cx);
        cx.playback.jump = None;
        let next = cx.pump();
        let next = next.or_else(|| drive.arrive_before_start(cx)).or_else(|| drive.end_leg(cx));
        (drive, next)
    }

    /// Begins the changes of light of the leg. In a leg of TARGETs, also sends TARGET-only robots (they understand the
    /// command TARGET but no routes) their first targets.
    fn begin_leg(&mut self, cx: &mut RunContext) {
        let Pipeline { driven: Some(driven), queue, lights, light, .. } = &mut *cx.pipeline else { return };
        lights.forget(cx.roster.len());
        light.begin_drive(cx.io, (cx.playback, cx.roster), &driven.leg, (cx.now, self.clock));
        let is_lit = light.is_active();
        match driven.leg.kind {
            LegKind::Routes if is_lit => {}
            LegKind::Routes => {
                let times = (cx.now, self.clock.began, self.clock.ends);
                lights.begin_drive(cx.io, cx.roster, times, (&driven.leg, queue.front()));
            }
            LegKind::Targets => {
                if !is_lit {
                    lights::color_target_robots(cx.io, cx.roster, &driven.leg);
                }
                target_commands::begin(cx);
            }
        }
    }

    /// Handles a report of a participant.
    pub fn on_report(
        &mut self,
        cx: &mut RunContext,
        participant: usize,
        topic: Topic,
        report: &Report,
    ) -> Next {
        let arrived = topic == Topic::Arrival;
        let Some(details) = &report.details else {
            let at = report.at.filter(|_| cx.is_target_leg());
            return match at {
                Some(at) => self.on_target_report(cx, participant, at, arrived),
                None if arrived => self.on_arrival(cx, participant, report.at),
                None => Next::Stay,
            };
        };
        match (arrived, cx.is_target_leg()) {
            (true, true) => {
                let drives = cx.pipeline.leg().is_some_and(|leg| leg.seq == details.route);
                match report.at.filter(|_| drives) {
                    Some(at) => self.on_target_report(cx, participant, at, true),
                    None => Next::Stay,
                }
            }
            (true, false) if cx.pipeline.leg().is_some_and(|leg| leg.seq == details.route) => {
                self.on_arrival(cx, participant, report.at)
            }
            (true, false) | (false, true) => Next::Stay,
            (false, false) => self.on_status(cx, participant, details),
        }
    }

    /// Handles a status report of a robot that follows a path.
    fn on_status(&mut self, cx: &mut RunContext, participant: usize, details: &Details) -> Next {
        if !self.is_under_way(cx, participant) {
            return Next::Stay;
        }
        match details.state {
            RobotState::Lost => Next::drop(participant, Trouble::Lost),
            RobotState::Faulty => Next::drop(participant, Trouble::Faulty),
            RobotState::Cut => cx.replan_with(participant),
            RobotState::Driving | RobotState::Held => {
                self.on_obstruction(cx, participant, details.blocked);
                self.on_progress(cx, participant, details);
                Next::Stay
            }
            RobotState::Idle | RobotState::Ready => self.on_rest(cx, participant, details),
        }
    }

    /// Handles the report of a robot that stands during a drive: it arrived, it has yet to start, or it lost its route.
    fn on_rest(&mut self, cx: &mut RunContext, participant: usize, details: &Details) -> Next {
        let Some(leg) = cx.pipeline.leg() else { return Next::Stay };
        let has_route = details.route == leg.seq;
        let goal = leg.robots[participant].goal;
        // If a robot only had to rest, it makes no difference that it began its route too early.
        let rested = has_route && leg.path(participant).is_some_and(|path| path.as_ref().rests());
        let at = cx.robot(participant).reported.at;
        let there = at.is_some_and(|at| is_there(at, goal, cx.io.config.arrival_tolerance_m));
        let waits = details.state == RobotState::Ready && has_route;
        let is_over = cx.now + EARLY >= self.clock.ends;
        // A robot that was lifted at the end of its route has given it up.
        let gave_up = details.state == RobotState::Idle && !has_route && !there;
        if there && (is_over || rested) && !waits {
            self.arrive(cx, participant)
        } else if (!is_over || gave_up) && cx.now > self.clock.began + OLD_REPORTS {
            cx.replan_with(participant)
        } else {
            Next::Stay
        }
    }

    /// Does what is due: HOLD and RESUME, copies of START, light, uploads of routes, the watch, and the end of the leg.
    pub fn on_tick(&mut self, cx: &mut RunContext) -> Next {
        if cx.playback.paused && self.clock.hold.is_none() {
            self.hold(cx, true);
        }
        if self.clock.hold.and_then(|hold| hold.release_at).is_some_and(|at| cx.now >= at) {
            self.release(cx);
        }
        self.clock.end_hold(cx.now);
        if cx.now >= self.heartbeat_at {
            let rests = self.clock.rests_from().is_some_and(|at| cx.now >= at);
            self.heartbeat_at = cx.now + HEARTBEAT.every(cx.roster.len(), rests);
            let (seq, at) = (cx.pipeline.leg().map_or(0, |leg| leg.seq), self.clock.began);
            cx.io.outbox.send(Topic::Broadcast, &[Command::Start { seq, at }]);
        }
        cx.pipeline.light.see(self.clock);
        cx.pump_lights();
        cx.pump().or_else(|| self.watch(cx)).or_else(|| self.end_leg(cx))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn start_is_repeated_less_often_to_more_robots_and_to_those_that_stand() {
        let every_ms = |robots, rests| HEARTBEAT.every(robots, rests).0 / 1000;
        assert_eq!([0, 30, 100, 250, 10_000].map(|robots| every_ms(robots, false)), [60, 60, 200, 500, 500]);
        assert_eq!(every_ms(30, true), 500);
    }
}

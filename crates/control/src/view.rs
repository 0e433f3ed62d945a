//! The snapshot's making.

use crate::desk::Desk;
use crate::driving::Drive;
use crate::leg::Kind;
use crate::operation::State;
use crate::run::{Phase, Purpose, Run};
use crate::snapshot::{RobotView, RunView};
use lightbots_base::{Instant, RobotId, Span};

/// The most robots a view says everybody waits for.
const WAITING_MAX: usize = 8;

impl Run {
    /// What the controller is doing, as people see it.
    pub fn state(&self) -> State {
        match self.phase {
            Phase::Offline(_) => State::Idle,
            _ if self.pause => State::Paused,
            Phase::Gathering(_) if self.current.is_none() => State::Preparing,
            Phase::Standing(_) | Phase::Starting(_) if self.current.is_none() => State::Preparing,
            _ if self.purpose == Purpose::Preview => State::Preview,
            _ => State::Playing,
        }
    }

    /// The run at `now`.
    pub fn view(&self, desk: &Desk, now: Instant) -> RunView {
        let last = self.show.frames.len().saturating_sub(1);
        let current = self.current.as_ref().map(|leg| leg.frame);
        let (frame, began) = match &self.phase {
            Phase::Driving(drive) => (current.unwrap_or(0), Some(drive.began)),
            Phase::Starting(_) => (self.next.frame.min(last), None),
            _ => (current.unwrap_or(self.next.frame.min(last)), None),
        };
        RunView {
            frame,
            doing: self.doing(),
            progress: self.progress(now),
            drive_s: self.current.as_ref().map_or(0.0, |leg| leg.duration.as_secs()),
            began,
            waiting_for: self.waiting_for(desk, now),
            frames_played: self.frames_played,
            dropouts: self.dropouts,
        }
    }

    fn doing(&self) -> &'static str {
        match &self.phase {
            Phase::Offline(_) => "waiting for the broker",
            Phase::Gathering(_) => "asking where everybody stands",
            Phase::Starting(_) => "about to leave",
            Phase::Driving(drive) if drive.hold.is_some() => "holding",
            Phase::Driving(_) => "driving",
            Phase::Standing(_) if self.current.as_ref().is_some_and(|leg| leg.airs) => "showing",
            Phase::Standing(_) if self.drafting.is_some() => "planning",
            Phase::Standing(_) => "handing out routes",
        }
    }

    fn progress(&self, now: Instant) -> f64 {
        let share = |past: Span, whole: Span| {
            if whole.0 > 0 { (past.as_secs() / whole.as_secs()).clamp(0.0, 1.0) } else { 1.0 }
        };
        match &self.phase {
            Phase::Driving(_) if self.current.as_ref().is_some_and(|leg| leg.kind == Kind::Targets) => {
                self.hops_passed()
            }
            Phase::Driving(drive) => {
                share(drive.path_time(now), self.current.as_ref().map_or(Span::ZERO, |leg| leg.duration))
            }
            Phase::Standing(standing) if standing.paused.is_none() => {
                share(now - standing.since, standing.until - standing.since)
            }
            _ => 0.0,
        }
    }

    fn waiting_for(&self, desk: &Desk, now: Instant) -> Vec<RobotId> {
        let Phase::Driving(drive) = &self.phase else { return Vec::new() };
        let follows_path = self.current.as_ref().is_some_and(|leg| leg.kind == Kind::Routes);
        let overdue = now > drive.ends && follows_path;
        let held_up = |seat: &usize| {
            let known = &self.seats[*seat];
            known.late.is_some()
                || self.is_stuck(*seat) && !known.out
                || overdue && !known.arrived && self.is_awaited(*seat)
        };
        let late = (0..self.seats.len()).filter(held_up).take(WAITING_MAX);
        late.map(|seat| desk.fleet.robot(self.seats[seat].robot).id).collect()
    }

    /// Adds to a robot's view what the run knows of it.
    pub fn complete(&self, view: &mut RobotView, seat: usize, now: Instant) {
        let Some(known) = self.seats.get(seat) else { return };
        view.takes_part = !known.out;
        let Some(leg) = &self.current else { return };
        let Some(step) = leg.moves.get(seat).filter(|_| !known.out) else { return };
        view.pixel = step.pixel;
        view.goal = Some(step.goal);
        if let (Phase::Driving(drive), Kind::Routes) = (&self.phase, leg.kind) {
            view.planned = self.planned_place(drive, seat, now);
        }
    }

    fn planned_place(&self, drive: &Drive, seat: usize, now: Instant) -> Option<lightbots_base::Vec2> {
        let path = self.current.as_ref()?.path(seat)?;
        Some(path.as_ref().at(drive.path_time(now)).position)
    }
}

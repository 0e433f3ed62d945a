//! Carries out the operations of the operator.

use crate::context::Context;
use crate::controller::Controller;
use crate::event::EventKind;
use crate::frame_cursor::FrameCursor;
use crate::home;
use crate::operation::{ControllerState, MissingPolicy, Operation, Refusal};
use crate::preflight::{self, TestedRobot};
use crate::robot::KnownRobot;
use crate::run::{LIVE_MAX, NAME_MAX, PlayedShow, PreflightCheck, Run, RunPurpose};
use crate::snapshot::Age;
use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_show::{Issue, Layer, SPEED_MIN_PERCENT, Show, slowed, validate};
use lightbots_wire::{Blink, Command, Topic};
use std::sync::Arc;

/// How long a robot flashes after [`Operation::Identify`], so that people find it.
const BLINK: Span = Span::from_millis(5_000);
/// Largest number of pixels that [`Refusal::PinnedMissing`] lists.
const LISTED: usize = 16;

impl Controller {
    /// Carries out an operation, or returns why it is refused.
    pub fn operate(&mut self, now: Instant, operation: Operation) -> Result<(), Refusal> {
        self.journal.operated(now, operation.name());
        if let Some(run) = &mut self.run {
            run.follow_music(now);
        }
        let done = match operation {
            Operation::Open(show) => self.open(now, show),
            Operation::Play { from, missing } => self.begin(now, RunPurpose::Play, from, missing),
            Operation::Preview { frame, missing } => self.begin(now, RunPurpose::Preview, frame, missing),
            Operation::Pause => self.pause(),
            Operation::Resume => self.resume(now, false),
            Operation::Step => self.resume(now, true),
            Operation::Go => self.go(now),
            Operation::GoOn => self.go_on(now),
            Operation::Abort => self.abort(now),
            Operation::StopAll => self.stop_all(now),
            Operation::DismissFailure => {
                (self.failure, self.stopped_in) = (None, None);
                Ok(())
            }
            Operation::Refresh => self.linked().map(|()| self.refresh(now)),
            Operation::Identify(id) => self.identify(id),
            Operation::Forget(id) => self.forget(id),
            Operation::Loop(looping) => {
                self.looping = looping;
                if let Some(run) = &mut self.run {
                    run.set_looping(&mut self.context, now, looping);
                }
                Ok(())
            }
            Operation::Admit(names) => {
                self.context.config.admitted = names;
                self.context.fleet.admit(&self.context.config);
                Ok(())
            }
            Operation::GoTo(frame) => self.go_to(now, frame),
            Operation::Skip => self.skip(now),
            Operation::LiveLight { name, layer } => self.change_live_light(now, &name, layer.as_ref()),
            Operation::Home => self.go_home(now),
            Operation::Preflight => self.begin_preflight(now),
            Operation::Speed(percent) => self.set_speed(percent),
            Operation::Pin { pixel, robot } => {
                match robot {
                    Some(robot) => self.context.mapping.pins.insert(pixel, robot),
                    None => self.context.mapping.pins.remove(&pixel),
                };
                Ok(())
            }
        };
        if done.is_ok()
            && let Some(run) = &mut self.run
        {
            run.on_tick(&mut self.context, now);
        }
        self.conclude(now);
        done
    }

    fn linked(&self) -> Result<(), Refusal> {
        if self.context.outbox.linked() { Ok(()) } else { Err(Refusal::NotConnected) }
    }

    fn idle(&self) -> Result<(), Refusal> {
        match self.state() {
            state if self.run.is_some() || self.stopping.is_some() => Err(Refusal::Busy(state)),
            _ => Ok(()),
        }
    }

    fn open(&mut self, now: Instant, show: Arc<Show>) -> Result<(), Refusal> {
        if self.run.is_some() {
            return Err(Refusal::Busy(self.state()));
        }
        self.context
            .log
            .record(now, EventKind::ShowOpened { name: show.name.clone(), frames: show.frames.len() });
        // A show with another name has other frames and pixels.
        if self.show.as_ref().is_some_and(|before| before.name != show.name) {
            self.stopped_in = None;
            self.context.mapping.forget_show();
        }
        self.show = Some(show);
        Ok(())
    }

    fn begin(
        &mut self,
        now: Instant,
        purpose: RunPurpose,
        frame: usize,
        missing: MissingPolicy,
    ) -> Result<(), Refusal> {
        self.linked()?;
        self.idle()?;
        let show = self.show.clone().ok_or(Refusal::NoShow)?;
        let frames = show.frames.len();
        if frame >= frames {
            return Err(Refusal::NoSuchFrame { frame, frames });
        }
        let last = if purpose == RunPurpose::Preview { frame } else { frames - 1 };
        self.enough(&show, frame..=last, missing)?;
        let show = if self.speed_percent == 100 { show } else { Arc::new(slowed(&show, self.speed_percent)) };
        if let Some(issue) = validate(&show).into_iter().find(Issue::is_error) {
            return Err(Refusal::Unfit { issue: issue.message });
        }
        self.start(now, show, purpose, (frame, missing));
        Ok(())
    }

    /// Begins a run in which all robots that can take part drive to the starting places of the open show. The show need
    /// not be valid.
    fn go_home(&mut self, now: Instant) -> Result<(), Refusal> {
        self.linked()?;
        self.idle()?;
        let show = self.show.as_ref().ok_or(Refusal::NoShow)?;
        let robots = self.context.fleet.robots().iter().filter(|robot| robot.can_take_part()).count();
        if robots == 0 {
            return Err(Refusal::NoRobot);
        }
        let home = slowed(&home::show(show, robots), self.speed_percent);
        self.start(now, Arc::new(home), RunPurpose::Home, (0, MissingPolicy::LeaveOut));
        Ok(())
    }

    /// Begins a preflight of all robots that can take part, from the places where they stand, on the stage of the open
    /// show.
    fn begin_preflight(&mut self, now: Instant) -> Result<(), Refusal> {
        self.linked()?;
        self.idle()?;
        if self.failure.is_some() || self.stopped_in.is_some() {
            return Err(Refusal::NotDismissed);
        }
        let show = self.show.clone().ok_or(Refusal::NoShow)?;
        // A run numbers its participants in this order.
        let fleet = self.context.fleet.robots();
        let takes_part = |robot: &&KnownRobot| robot.can_take_part();
        let (mut robots, mut candidates): (Vec<(RobotId, Vec2)>, Vec<TestedRobot>) = Default::default();
        for robot in fleet.iter().filter(takes_part) {
            let at = robot.reported.at.unwrap_or_default();
            robots.push((robot.id, at));
            candidates.push(TestedRobot { at, heading: robot.reported.heading.unwrap_or(0.0) });
        }
        if robots.is_empty() {
            return Err(Refusal::NoRobot);
        }
        let stands = fleet.iter().filter(|robot| !robot.can_take_part() && robot.contact.age != Age::Gone);
        let standing: Vec<Vec2> = stands.filter_map(|robot| robot.standstill.at).collect();
        let rounds = preflight::rounds(&show.stage, &candidates, &standing);
        if rounds.is_empty() {
            return Err(Refusal::NoRoom);
        }
        let tested = preflight::show(show.name.clone(), show.stage.clone(), &robots, &rounds);
        self.preflight = None;
        self.start(now, Arc::new(tested), RunPurpose::Preflight, (0, MissingPolicy::LeaveOut));
        if let Some(run) = &mut self.run {
            run.preflight = Some(PreflightCheck::new(&rounds, robots.iter().map(|robot| robot.1)));
        }
        Ok(())
    }

    /// Begins a run.
    fn start(
        &mut self,
        now: Instant,
        show: Arc<Show>,
        purpose: RunPurpose,
        (frame, missing): (usize, MissingPolicy),
    ) {
        (self.failure, self.stopped_in) = (None, None);
        let next = FrameCursor { frame, ..FrameCursor::default() };
        let playback = PlayedShow { looping: self.looping, ..PlayedShow::new(show, purpose, missing, next) };
        self.run = Some(Run::begin(&mut self.context, now, playback));
    }

    /// Checks that there are robots for all pixels of these frames. With [`MissingPolicy::LeaveOut`] one robot is
    /// enough.
    fn enough(
        &self,
        show: &Show,
        frames: std::ops::RangeInclusive<usize>,
        missing: MissingPolicy,
    ) -> Result<(), Refusal> {
        let fleet = self.context.fleet.robots();
        let pixels = show.frames[frames.clone()].iter().map(|frame| frame.pixels.len()).max().unwrap_or(0);
        let robots = fleet.iter().filter(|robot| robot.can_take_part()).count();
        if robots == 0 || robots < pixels && missing == MissingPolicy::Refuse {
            let without_place = fleet.iter().filter(|r| r.is_heard() && r.reported.at.is_none()).count();
            let unfit = fleet.len() - robots - without_place;
            return Err(Refusal::TooFewRobots { pixels, robots, without_place, unfit });
        }
        if missing == MissingPolicy::LeaveOut {
            return Ok(());
        }
        let present =
            |id: RobotId| self.context.fleet.find(id).is_some_and(|index| fleet[index].can_take_part());
        let bound = show.frames[frames].iter().flat_map(|frame| &frame.pixels);
        let mut away: Vec<u32> = bound
            .filter(|pixel| match &pixel.robot {
                Some(name) => !RobotId::new(name).is_some_and(present),
                None => self.context.mapping.pins.get(&pixel.id).is_some_and(|&id| !present(id)),
            })
            .map(|pixel| pixel.id)
            .collect();
        away.sort_unstable();
        away.dedup();
        away.truncate(LISTED);
        if away.is_empty() { Ok(()) } else { Err(Refusal::PinnedMissing { pixels: away }) }
    }

    fn pause(&mut self) -> Result<(), Refusal> {
        self.linked()?;
        self.run.as_mut().ok_or(Refusal::NoRun)?.playback.paused = true;
        Ok(())
    }

    fn resume(&mut self, now: Instant, step: bool) -> Result<(), Refusal> {
        self.linked()?;
        let run = self.run.as_mut().ok_or(Refusal::NoRun)?;
        if !run.playback.paused {
            return Err(Refusal::NotPaused);
        }
        run.resume(&mut self.context, now, step);
        Ok(())
    }

    fn set_speed(&mut self, percent: u32) -> Result<(), Refusal> {
        self.idle()?;
        if !(SPEED_MIN_PERCENT..=100).contains(&percent) {
            return Err(Refusal::NoSuchSpeed);
        }
        self.speed_percent = percent;
        Ok(())
    }

    fn go(&mut self, now: Instant) -> Result<(), Refusal> {
        self.linked()?;
        let run = self.run.as_mut().ok_or(Refusal::NoRun)?;
        if run.playback.paused {
            return Err(Refusal::Paused);
        }
        if run.playback.waits_for_go {
            run.go(now);
            return Ok(());
        }
        if run.leave_loop(&mut self.context, now) { Ok(()) } else { Err(Refusal::NoCue) }
    }

    fn go_on(&mut self, now: Instant) -> Result<(), Refusal> {
        self.linked()?;
        let run = self.run.as_mut().ok_or(Refusal::NoRun)?;
        if run.go_on(&mut self.context, now) { Ok(()) } else { Err(Refusal::NothingToGoOn) }
    }

    /// Returns the run, if it plays a show and the operator may choose its next frame now. That is so if robots stand,
    /// are being stopped, or are held, or if the run is paused. Otherwise returns the reason why the operation is
    /// refused.
    fn standing_show(&mut self) -> Result<(&mut Run, &mut Context), Refusal> {
        self.linked()?;
        let state = self.state();
        let run = self.run.as_mut().ok_or(Refusal::NoRun)?;
        if run.playback.purpose != RunPurpose::Play || state == ControllerState::LinkLost {
            return Err(Refusal::Busy(state));
        }
        if run.may_jump() { Ok((run, &mut self.context)) } else { Err(Refusal::Driving) }
    }

    fn go_to(&mut self, now: Instant, frame: usize) -> Result<(), Refusal> {
        let (run, context) = self.standing_show()?;
        let frames = run.playback.show.frames.len();
        if frame >= frames {
            return Err(Refusal::NoSuchFrame { frame, frames });
        }
        run.go_to(context, now, frame);
        Ok(())
    }

    fn skip(&mut self, now: Instant) -> Result<(), Refusal> {
        let (run, context) = self.standing_show()?;
        if run.playback.is_ended() {
            return Err(Refusal::NothingToSkip);
        }
        run.skip(context, now);
        Ok(())
    }

    fn change_live_light(&mut self, now: Instant, name: &str, layer: Option<&Layer>) -> Result<(), Refusal> {
        let run = self.run.as_mut().filter(|run| run.playback.purpose == RunPurpose::Play);
        let run = run.ok_or(Refusal::NoShowPlays)?;
        let wrong = |issue| Refusal::WrongLayer { issue };
        if name.is_empty() || name.chars().count() > NAME_MAX {
            return Err(wrong(format!("its name has 1 to {NAME_MAX} characters")));
        }
        let mut live = run.pipeline.light.live().clone();
        if layer.is_some() && live.names().filter(|other| *other != name).count() >= LIVE_MAX {
            return Err(Refusal::TooMuchLight { most: LIVE_MAX });
        }
        match layer {
            Some(layer) => live
                .put_on(name.to_owned(), layer, (now - Instant::ZERO).as_secs())
                .map_err(|faults| wrong(faults.first().map_or_else(String::new, ToString::to_string)))?,
            None => live.take_off(name),
        }
        run.set_live_light(&mut self.context, now, live);
        Ok(())
    }

    fn abort(&mut self, now: Instant) -> Result<(), Refusal> {
        if self.state() == ControllerState::Aborting {
            self.halt(now, None);
            return Ok(());
        }
        let run = self.run.as_mut().ok_or(Refusal::NoRun)?;
        let held_from = run.holds_before_stop(&mut self.context, now);
        run.abort(&mut self.context, now);
        self.halt(now, held_from);
        Ok(())
    }

    fn stop_all(&mut self, now: Instant) -> Result<(), Refusal> {
        if self.run.is_none() {
            self.linked()?;
        }
        let mut held_from = None;
        if let Some(run) = &mut self.run {
            held_from = run.holds_before_stop(&mut self.context, now);
            run.abort(&mut self.context, now);
        }
        self.halt(now, held_from);
        self.context.log.record(now, EventKind::StoppedAll);
        Ok(())
    }

    fn identify(&mut self, id: RobotId) -> Result<(), Refusal> {
        self.linked()?;
        let index = self.context.fleet.find(id).ok_or(Refusal::UnknownRobot(id))?;
        let robot = self.context.fleet.robot(index);
        let commands = if robot.reported.abilities.blink {
            vec![Command::Blink(Blink { over: BLINK })]
        } else {
            vec![Command::Uuid]
        };
        self.context.outbox.send(Topic::Robot(id), &commands);
        Ok(())
    }

    fn forget(&mut self, id: RobotId) -> Result<(), Refusal> {
        self.idle()?;
        let index = self.context.fleet.find(id).ok_or(Refusal::UnknownRobot(id))?;
        self.context.fleet.forget(index);
        self.context.mapping.forget(id);
        Ok(())
    }
}

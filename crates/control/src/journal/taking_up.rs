//! Takes up a run from its journal: this controller goes on with the run, from where its robots stand.

use super::{JournalState, ParticipantEntry, Position, UnfinishedRun};
use crate::config::WaitBounds;
use crate::context::Context;
use crate::controller::Controller;
use crate::event::EventKind;
use crate::leg::Leg;
use crate::mutant::Mutant;
use crate::operation::Refusal;
use crate::run::{Participant, PlayedShow, Roster, Run, RunPurpose, StopTimes};
use lightbots_base::{Instant, Span, Vec2};
use serde::{Deserialize, Serialize};

/// Longest silence of a driving robot at the moment of the journal's last entry. After a longer silence the controller
/// would have held all robots.
const UNHEARD: Span = Span::from_millis(1_500);
/// Time after the journal's last entry by which all robots stand. The controller ended at most 2 s after the entry. At
/// most 2.5 s later each robot has stopped (R43 of docs/protocol.md).
const STANDS_AFTER: Span = Span::from_millis(4_500);
/// A time that is longer than any run: 1,000 days.
const FOR_EVER: Span = Span::from_millis(86_400_000_000);

/// What a new controller does with a run that was cut off. A preflight never goes on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum OnReturn {
    /// The run goes on by itself if its robots report within `WaitBounds::goes_on_within` of the journal's last entry,
    /// and no later entry was lost. Otherwise the operator is asked.
    #[default]
    GoOrAsk,
    /// The run goes on by itself once its robots report, however long that takes.
    Go,
    /// The operator is asked.
    Ask,
    /// The run is over. Robots are told to stop.
    Stop,
}

impl Controller {
    /// Takes up a run whose former controller is gone, and opens its show. The run is interrupted until its robots
    /// report, and is then planned from where robots stand. If `on_return` is `Stop` or the run is a preflight, all
    /// robots are told to stop instead. Refused during another run and while robots are being stopped. Call this before
    /// [`connected`](Self::connected), with `now` from [`show_clock_at`](UnfinishedRun::show_clock_at).
    pub fn take_up(
        &mut self,
        now: Instant,
        unfinished: &UnfinishedRun,
        on_return: OnReturn,
    ) -> Result<(), Refusal> {
        if self.has_run() {
            return Err(Refusal::Busy(self.state()));
        }
        let (state, away) = (&unfinished.state, (now - unfinished.at).max(Span::ZERO));
        self.show = Some(state.begun.show.clone());
        self.looping = state.progress.looping;
        restore_mapping(&mut self.context, state);
        // The measurements of a preflight are lost, so that it cannot go on.
        let is_preflight = state.begun.purpose == RunPurpose::Preflight;
        let goes_on = on_return != OnReturn::Stop && !is_preflight;
        let robots = state.participants.iter().filter(|entry| !entry.membership.excluded).count();
        let frame = unfinished.frame();
        self.context.log.record(now, EventKind::TakenUp { frame, robots, away, goes_on });
        if goes_on {
            let by_itself = unfinished.goes_on_within(now, on_return, &self.context.config.waits);
            self.run = Some(Run::take_up(&mut self.context, now, unfinished, by_itself));
        } else {
            self.stops_when_connected = true;
        }
        self.conclude(now);
        Ok(())
    }
}

impl UnfinishedRun {
    /// Returns for how long from `now` on the robots may stay silent so that the run still goes on without the
    /// operator. Zero: the operator is asked in any case. `now`: see [`show_clock_at`](Self::show_clock_at).
    pub fn goes_on_within(&self, now: Instant, on_return: OnReturn, waits: &WaitBounds) -> Span {
        match on_return {
            OnReturn::Go => FOR_EVER,
            OnReturn::GoOrAsk if !self.is_outdated => {
                (waits.goes_on_within - (now - self.at)).max(Span::ZERO)
            }
            OnReturn::GoOrAsk | OnReturn::Ask | OnReturn::Stop => Span::ZERO,
        }
    }
}

fn restore_mapping(context: &mut Context, state: &JournalState) {
    context.mapping.pins = state.pins.iter().copied().collect();
    context.mapping.owners = Default::default();
    for &(pixel, robot) in &state.owners {
        context.mapping.owners.show(pixel, robot);
    }
}

impl Run {
    /// Returns the run of a journal in the phase Interrupted, as if its robots had been out of reach until now.
    /// `by_itself`: longest interruption after which the run goes on without the operator.
    fn take_up(context: &mut Context, now: Instant, unfinished: &UnfinishedRun, by_itself: Span) -> Self {
        let UnfinishedRun { at, state, .. } = unfinished;
        let (begun, progress) = (&state.begun, &state.progress);
        let mut playback = PlayedShow {
            looping: progress.looping,
            paused: progress.paused,
            stepping: progress.stepping,
            waits_for_go: progress.waits_for_go,
            leaves_loop: progress.leaves_loop,
            ..PlayedShow::new(begun.show.clone(), begun.purpose, begun.missing, progress.next)
        };
        if Mutant::WrongFrameAfterRestart.is_planted() {
            playback.next = playback.after(playback.next).unwrap_or(playback.next);
        }
        let leg = state.leg.as_ref().and_then(|leg| leg.to_leg(state.participants.len()));
        let mut participants = Vec::new();
        for (number, entry) in state.participants.iter().enumerate() {
            let goal = leg.as_ref().filter(|leg| stands_at_goal(leg, progress.position, number));
            let goal = goal.and_then(|leg| leg.goal(number));
            let robot = context.fleet.expect(entry.id, *at, &context.config);
            expect(context, robot, entry, goal);
            context.fleet.robot_mut(robot).participant = Some(number as u32);
            participants.push(Participant {
                membership: entry.membership,
                probation: entry.probation,
                last_seen: entry.last_seen.clone(),
                ..Participant::new(robot)
            });
        }
        let roster = Roster { participants, begun: begun.at, ..Roster::default() };
        // A robot that failed may be the reason for a hold or stop, even one that began long ago. The journal does not
        // say when each robot was received last.
        let mut left = progress.position;
        let held = left.drive.and_then(|clock| clock.open_hold().map(|hold| hold.at));
        let stopped = left.stops.map(|stops| stops.began);
        let known = [held, stopped].into_iter().flatten().fold(*at, Instant::min);
        let began = Instant(known.0.saturating_sub(UNHEARD.0 as u64));
        let stood = left.stops.map_or(*at + STANDS_AFTER, |stops| stops.stood);
        left.stops = Some(StopTimes { began, stood });
        let mut run = Self::interrupted(now, playback, roster, leg, (left, by_itself, *at));
        run.tally.frames_played = progress.frames_played as usize;
        run.tally.dropouts = progress.dropouts as usize;
        run.tally.taken_up = progress.taken_up + 1;
        run.pipeline.obstacles.found.clone_from(&state.found);
        run.pipeline.obstacles.ignores_strangers = state.ignores_strangers;
        run.drop_plans(context);
        run
    }
}

/// Whether a participant stands at its goal in the leg of a journal. All participants do after the leg. During the leg,
/// only those do that the leg leaves where they are.
fn stands_at_goal(leg: &Leg, position: Position, participant: usize) -> bool {
    position.is_at_goals() || position.drive.is_some() && !leg.is_driven_by(participant)
}

/// Stores what the journal says of a robot. Until the robot reports, its place is `goal` (stage metres) if it takes
/// part and `goal` is given, otherwise the place in the journal.
fn expect(context: &mut Context, robot: usize, entry: &ParticipantEntry, goal: Option<Vec2>) {
    let robot = context.fleet.robot_mut(robot);
    robot.reported.abilities = entry.abilities;
    robot.reported.at = goal.filter(|_| !entry.membership.excluded).or(entry.at);
    robot.standstill.at = robot.reported.at;
}

//! The phase in which all robots are stopped and report where they stand. Robots that do not answer drop out.

use crate::context::Context;
use crate::event::Trouble;
use crate::journal::Position;
use crate::leg::LegKind;
use crate::mutant::Mutant;
use crate::operation::MissingPolicy;
use crate::run::clock_wait::PRECISE_US;
use crate::run::next::{AirTime, Next};
use crate::run::outdated_journal;
use crate::run::path_clock::{Hold, PathClock};
use crate::run::readiness::missing;
use crate::run::roster::{Roster, Whereabouts};
use crate::run::run_context::RunContext;
use crate::run::stop_times::StopTimes;
use crate::run::target_commands;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, Route};

/// How many copies of HOLD and STOP are sent, and the time between them.
const COPIES: (u32, Span) = (4, Span::from_millis(40));
/// Time from when robots stand after STOP until their reports begin to count; a round trip comes on top. All copies
/// have arrived by then.
const SETTLE: Span = Span::from_millis(200);
/// Time between requests to robots that have not answered.
const ASK: Span = Span::from_millis(300);
/// Time between two checks of the phase.
const CHECK_EVERY: Span = Span::from_millis(50);

/// How long a robot may take to become ready. After that it drops out.
struct Bounds {
    /// Time to answer; it comes on top of the silence after which a robot drops out. TARGET-only robots (they
    /// understand the command TARGET but no routes) have three times as long, because both the question and the answer
    /// must be delivered.
    answer: Span,
    /// Time to stop, for a TARGET-only robot that does not receive the command to halt and drives on to its target.
    stop: Span,
    /// Time to set its clock, for which a robot needs four to sixteen answers to time questions (R29 of
    /// docs/protocol.md).
    clock: Span,
}

/// With shorter times, robots on a lossy link drop out; with longer ones, all wait for a dead robot.
const BOUNDS: Bounds = Bounds {
    answer: Span::from_millis(1_500),
    stop: Span::from_millis(20_000),
    clock: Span::from_millis(8_000),
};

/// The state while robots are stopped and asked where they stand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gathering {
    /// The moment at which robots that received STOP or HOLD in time stand, show clock.
    since: Instant,
    /// Reports from this moment on count.
    fresh_from: Instant,
    /// When robots that have not answered are asked next.
    ask_at: Instant,
    /// When STOP is sent, if a HOLD comes first, so that robots slow down on their paths. `None` once STOP was sent.
    stop_at: Option<Instant>,
    /// Whether nothing was driven yet in this run. Too few robots for the first frame then end it, unless pixels may be
    /// left out.
    is_first: bool,
    /// The drive, or the stay in a frame, that was interrupted.
    pub left: Position,
}

impl Gathering {
    /// The state at the beginning of a run in which no robot has to stop, because all stand at known places.
    pub fn at_begin(now: Instant) -> Self {
        Self {
            since: now,
            fresh_from: Instant::ZERO,
            ask_at: now,
            stop_at: None,
            is_first: true,
            left: Position::default(),
        }
    }

    /// Stops all robots. On a drive of routes they first slow down together in a HOLD. `left` is the drive that is
    /// interrupted, or the stay in a frame.
    pub fn begin(cx: &mut RunContext, mut left: Position) -> Self {
        cx.io.outbox.stop_repeating();
        let held_from = left.drive.and_then(|clock| hold_before_stop(cx, &clock));
        let first_command = held_from.map_or(Command::Stop, |at| Command::Hold { at });
        cx.io.outbox.broadcast(cx.now, first_command, COPIES.0, COPIES.1);
        target_commands::halt_all(cx);
        let stop_at = held_from.map(|at| at + Route::EASE);
        let since = stop_at.unwrap_or(cx.now);
        let fresh_from = since + SETTLE + cx.link.round_trip;
        left.stops.get_or_insert(StopTimes { began: held_from.unwrap_or(cx.now), stood: since });
        Self {
            since,
            fresh_from,
            ask_at: fresh_from,
            stop_at,
            is_first: cx.pipeline.driven.is_none() && cx.tally.frames_played == 0,
            left,
        }
    }

    /// The moment at which robots begin to slow down in the HOLD before STOP. `None` once STOP was sent, or without a
    /// HOLD.
    pub fn held_from(&self) -> Option<Instant> {
        self.stop_at.map(|at| at - Route::EASE)
    }

    /// Ends the air time of the frame in which robots stood, so that they leave it as soon as all are ready.
    pub fn leave_now(&mut self) {
        self.left.stood = None;
    }

    /// The robots (indices into the fleet) for which all others wait: not ready yet, or with a clock that is not
    /// precise.
    pub fn awaited<'a>(&'a self, io: &'a Context, roster: &'a Roster) -> impl Iterator<Item = usize> + 'a {
        let robots = roster.active().map(|(_, known)| known.robot);
        robots.filter(|&robot| {
            missing(io, robot, self.fresh_from).is_some() || clock_us(io, robot) > PRECISE_US
        })
    }

    /// Whether all robots are ready, except that some clock is not precise yet.
    pub fn waits_for_clocks_only(&self, io: &Context, roster: &Roster) -> bool {
        let is_ready = |robot: usize| missing(io, robot, self.fresh_from).is_none();
        roster.active().all(|(_, known)| is_ready(known.robot)) && self.awaited(io, roster).next().is_some()
    }

    /// When [`on_tick`](Self::on_tick) has something to do next.
    pub fn due(&self, now: Instant) -> Instant {
        now + CHECK_EVERY
    }

    /// Does what is due: sends STOP, asks robots for missing reports, drops robots that take too long, or ends the
    /// phase. Ends the run if recovery from dropouts has exceeded its bound.
    pub fn on_tick(&mut self, cx: &mut RunContext) -> Next {
        if let Some(stop_at) = self.stop_at {
            if cx.now >= stop_at {
                cx.io.outbox.broadcast(cx.now, Command::Stop, COPIES.0, COPIES.1);
                self.stop_at = None;
            }
            return Next::Stay;
        }
        if let Some(why) = cx.tally.recovery.exceeded(cx.now) {
            return Next::failed(why);
        }
        let unready: Vec<(usize, Trouble)> = cx
            .roster
            .active()
            .filter_map(|(one, known)| Some((one, missing(cx.io, known.robot, self.fresh_from)?)))
            .collect();
        let is_overdue = |&(one, why): &(usize, Trouble)| {
            !Mutant::WaitForEver.is_planted() && cx.now - self.since > self.bound(cx, one, why)
        };
        let overdue: Vec<(usize, Trouble)> = unready.iter().copied().filter(is_overdue).collect();
        if !overdue.is_empty() {
            return Next::Drop(overdue);
        }
        if unready.is_empty() {
            return if waits_for_clocks(cx) { Next::Stay } else { self.end(cx) };
        }
        if cx.now >= self.ask_at {
            self.ask_at = cx.now + ASK;
            ask(cx, &unready);
        }
        Next::Stay
    }

    /// How long after `since` a robot may take to become ready if it is not ready because of `why`.
    fn bound(&self, cx: &RunContext, participant: usize, why: Trouble) -> Span {
        let is_original = cx.robot(participant).is_original();
        let bound = match why {
            Trouble::Cut => BOUNDS.clock,
            Trouble::Deaf if is_original => BOUNDS.stop,
            _ => {
                let answers = BOUNDS.answer * if is_original { 3 } else { 1 };
                cx.io.config.silence + answers + cx.link.round_trip * 2
            }
        };
        let reports = matches!(why, Trouble::Cut | Trouble::Deaf);
        if reports { bound.max(cx.link.patience(self.since)) } else { bound }
    }

    /// Ends the phase, because all robots stand at known places. The run fails if no robot is left, or if it has too
    /// few robots for its first frame and may not leave pixels out.
    fn end(&self, cx: &RunContext) -> Next {
        let active = cx.roster.active().count();
        let frame = cx.playback.show.frames.get(cx.playback.next.frame);
        let pixels = frame.map_or(0, |frame| frame.pixels.len());
        let must_be_complete = self.is_first && cx.playback.missing == MissingPolicy::Refuse;
        if active == 0 || must_be_complete && active < pixels {
            return Next::failed(self.shortage(cx, active, pixels));
        }
        let (until, left) = self.left.stood.map_or((cx.now, None), |stood| (stood.until, stood.left));
        Next::Stand(AirTime { since: cx.now, until: until.max(cx.now), left, is_at_goals: false })
    }

    /// A text for people: why `active` robots are too few for the `pixels` of the next frame.
    fn shortage(&self, cx: &RunContext, active: usize, pixels: usize) -> String {
        if active > 0 {
            return format!("only {active} of the {pixels} robots it needs can take part");
        }
        let is_silent = |robot: usize| missing(cx.io, robot, self.fresh_from) == Some(Trouble::Silent);
        let all_silent = cx.roster.participants.iter().all(|known| is_silent(known.robot));
        let what = if all_silent { "lost contact" } else { "dropped out" };
        match cx.roster.len() {
            1 => format!("the only robot {what}"),
            robots => format!("all {robots} robots {what}"),
        }
    }

    /// Where a participant that fell silent on the interrupted drive may stand.
    pub fn whereabouts(&self, cx: &RunContext, participant: usize) -> Whereabouts {
        outdated_journal::whereabouts_after(cx, &self.left, participant)
    }
}

/// The moment of a HOLD before STOP, if all robots are to be stopped now on the drive of `clock`. In a hold all slow
/// down together. Without it, a robot that misses the first copy of STOP stops 40 ms later than the others. At full
/// speed that is 11 mm, more than plans leave. `None` (STOP is sent at once) for legs of TARGETs, if robots stand
/// already, or if the drive ends before the hold.
pub(crate) fn hold_before_stop(cx: &RunContext, clock: &PathClock) -> Option<Instant> {
    if cx.pipeline.leg().is_none_or(|leg| leg.kind == LegKind::Targets) {
        return None;
    }
    let soonest = cx.now + cx.link.hold_lead();
    let at = match clock.hold {
        Some(Hold { at, until: None, .. }) if at < clock.ends => at,
        // Robots are still picking up speed: they slow down after that.
        Some(Hold { until: Some(until), .. }) => soonest.max(until + Route::EASE),
        // Without a hold, or with one that comes after the end of the drive, robots are held as soon as possible.
        _ => soonest,
    };
    (cx.now < at + Route::EASE && at < clock.ends).then_some(at)
}

/// Whether the run still waits for robots with clocks that are not precise yet. When the wait begins, an event names
/// the robot with the least precise clock.
fn waits_for_clocks(cx: &mut RunContext) -> bool {
    let clocks = cx.roster.active().map(|(one, known)| (clock_us(cx.io, known.robot), one));
    let worst = clocks.max().filter(|&(us, _)| us > PRECISE_US);
    let begins = !cx.tally.clock_wait.is_on();
    let passed = worst.and_then(|_| cx.tally.clock_wait.look(cx.now));
    let (Some((_, worst)), Some(passed)) = (worst, passed) else {
        cx.tally.clock_wait.end();
        return false;
    };
    // This time is lost because of the link, and not because of a robot that dropped out.
    cx.tally.recovery.put_off(passed);
    if begins {
        cx.report_waiting(worst, Trouble::Clock);
    }
    true
}

/// Error of a robot's clock, 2 sigma, microseconds; 0 if its report contains none.
fn clock_us(io: &Context, robot: usize) -> u32 {
    io.fleet.robot(robot).reported.clock_us.unwrap_or(0)
}

/// Asks each robot for what it lacks: a robot that does not stand is told to stop, the others are asked for a report.
fn ask(cx: &mut RunContext, unready: &[(usize, Trouble)]) {
    for &(participant, why) in unready {
        if why == Trouble::Deaf {
            target_commands::halt(cx, participant);
        }
        let command = match why {
            _ if cx.robot(participant).is_original() => Command::Uuid,
            Trouble::Deaf => Command::Stop,
            _ => Command::Status,
        };
        cx.send(participant, &[command]);
    }
}

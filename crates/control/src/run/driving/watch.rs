//! The watch over a drive finds robots that are silent, late or overdue, and checks that robots stand in a hold.

use crate::event::Trouble;
use crate::leg::LegKind;
use crate::run::driving::arrivals::MISSED_M;
use crate::run::driving::drive::{ASKED_EVERY, Driving, WATCH_EVERY};
use crate::run::driving::lateness::LATE_MAX_M;
use crate::run::next::Next;
use crate::run::run_context::RunContext;
use crate::run::silence::LINK_LOSS;
use lightbots_base::{Instant, Span};
use lightbots_wire::{Command, RobotState, Route};

/// A turn of the watch covers this number of participants plus an eighth of all. It is large, so that a silent robot is
/// asked for a report often. With one message in ten lost and only four questions to a silent robot, live robots
/// dropped out in one of ten runs.
const SLICE: usize = 512;

/// Bounds on the silence of a driving robot; round trips of the link are added.
struct Silence {
    /// Silence after which the robot is asked for a report: it missed the report that is due every 500 ms (R41).
    asked_after: Span,
    /// Silence after which all robots hold and wait for the silent one.
    held_after: Span,
}

/// With an earlier hold, two lost reports stop the fleet; with a later one, the fleet runs into a dead robot.
const SILENCE: Silence = Silence { asked_after: Span::from_millis(560), held_after: Span::from_millis(800) };

const _: () = assert!(SILENCE.asked_after.0 + ASKED_EVERY.0 < SILENCE.held_after.0);

/// Time after the planned end of the drive, or after the robot was last on its route if that is later. When it is over,
/// the robot's place decides whether it counts as arrived or drops out.
const OVERDUE: Span = Span::from_millis(3_000);
/// Longest time after the planned end for which the fleet waits for a robot that still drives on its route. Also the
/// longest time for which all hold for a late robot that makes progress. The robot may be in a simulated world that
/// runs slower than the plan, on a busy machine. Without a bound, a robot that reports nonsense would stop the show for
/// good.
const SLOW: Span = Span::from_millis(60_000);
/// A robot is still on its way if its distance to the goal minus its distance off the route exceeds this, metres.
const END_M: f64 = 0.01;
/// Least decrease of the distance to its goal that counts as a robot's progress, metres: more than the error of its
/// position fixes.
const NEARER_M: f64 = 0.005;
/// Bound on the time after the moment at which robots should stand in a hold. If some still drive when it is over, all
/// robots are stopped and planned again.
const HOLD_BOUND: Span = Span::from_millis(1_200);
/// Time until the next check of a hold in which all robots stand.
const HOLD_CHECK_EVERY: Span = Span::from_millis(1_000);

impl Driving {
    /// Watches the next slice of participants, and checks the hold, if a turn is due.
    pub fn watch(&mut self, cx: &mut RunContext) -> Next {
        if cx.now < self.watch_at {
            return Next::Stay;
        }
        self.watch_at = cx.now + WATCH_EVERY;
        let next = self.check_hold(cx);
        if !next.stays() {
            return next;
        }
        let (is_held, ends) = (self.clock.is_held(), self.clock.ends);
        self.lose_patience(cx);
        let count = cx.roster.len();
        let first = if self.watched < count { self.watched } else { 0 };
        self.watched = (first + SLICE + count / 8).min(count);
        let kind = cx.pipeline.leg().map(|leg| leg.kind);
        for participant in first..self.watched {
            if !self.is_under_way(cx, participant) {
                continue;
            }
            let next = match kind {
                Some(LegKind::Routes) => self.watch_path_robot(cx, participant, is_held, ends),
                _ => self.watch_target_robot(cx, participant),
            };
            if !next.stays() {
                return next;
            }
        }
        Next::Stay
    }

    /// Watches a robot that follows a path. `is_held` and `ends` were read when this turn of the watch began. A hold
    /// that begins during the turn therefore does not count yet.
    fn watch_path_robot(
        &mut self,
        cx: &mut RunContext,
        participant: usize,
        is_held: bool,
        ends: Instant,
    ) -> Next {
        if let Some(next) = self.watch_probed(cx, participant) {
            return next;
        }
        let silent = cx.now - cx.robot(participant).contact.heard.max(self.clock.began);
        if let Some(next) = self.watch_silent(cx, participant, silent) {
            return next;
        }
        if let Some(since) = self.progress[participant].obstructed_since {
            return self.watch_obstructed(cx, participant, since);
        }
        let progressed = self.last_progress(cx, participant);
        let bound = cx.io.config.late.wait;
        let waited = |since: Instant| cx.now - since.max(progressed) > bound || cx.now - since > SLOW;
        if self.progress[participant].late_since.is_some_and(waited) && is_held {
            return Next::drop(participant, Trouble::Late);
        }
        if cx.now <= ends + SLOW {
            let on_route_at = if is_on_its_way(cx, participant) { cx.now } else { progressed };
            let known = &mut self.progress[participant];
            known.on_route_at = on_route_at.max(known.on_route_at);
        }
        if !is_held && cx.now > ends.max(self.progress[participant].on_route_at) + OVERDUE {
            return self.settle_overdue(cx, participant);
        }
        let is_overdue = !is_held && cx.now >= self.ask_at;
        if is_overdue || silent > SILENCE.asked_after + cx.link.round_trip {
            self.ask(cx, participant);
        }
        Next::Stay
    }

    /// Watches a driving robot that has been silent for the time `silent`. After a short silence all hold and wait for
    /// it. After a longer one it drops out, once all robots should stand or it must have stopped by itself. `None` if
    /// neither happens in this turn.
    fn watch_silent(&mut self, cx: &mut RunContext, participant: usize, silent: Span) -> Option<Next> {
        let bound = cx.io.config.silence + cx.link.round_trip * 2;
        if silent > bound && self.all_stand(cx, silent) {
            return Some(Next::drop(participant, Trouble::Silent));
        }
        let is_late = self.progress[participant].late_since.is_some();
        if self.clock.is_held() || silent <= SILENCE.held_after + cx.link.round_trip || is_late {
            return None;
        }
        self.mark_late(cx, participant, Trouble::Silent);
        Some(Next::Stay)
    }

    /// Whether a silent robot may drop out, because all robots stand or it has been silent for long enough to have
    /// stopped by itself. A dropout stops all robots at once. The silent robot, which may not receive STOP, would
    /// otherwise drive on among them.
    fn all_stand(&self, cx: &RunContext, silent: Span) -> bool {
        let bound = LINK_LOSS.stands_after() + Route::EASE + cx.link.hold_lead() * 2;
        let stand_at = self.clock.rests_from().unwrap_or(self.clock.ends);
        silent > bound || cx.now >= stand_at
    }

    /// When a robot last made progress: its reported place was nearer to its goal, by more than `NEARER_M`, than at its
    /// progress before. If it never did: when the drive began. All wait for a robot while it makes progress.
    fn last_progress(&mut self, cx: &RunContext, participant: usize) -> Instant {
        let nearest = &mut self.progress[participant].nearest;
        if let (Some(at), Some(goal)) = (cx.robot(participant).reported.at, cx.goal(participant))
            && at.distance(goal) < nearest.0 - NEARER_M
        {
            *nearest = (at.distance(goal), cx.now);
        }
        nearest.1
    }

    /// Ends the drive of a robot that should have arrived long ago. It drops out if it may still move or is far from
    /// its goal. Otherwise it counts as arrived.
    fn settle_overdue(&mut self, cx: &mut RunContext, participant: usize) -> Next {
        let robot = cx.robot(participant);
        let goal = cx.goal(participant).unwrap_or_default();
        let off_m = robot.reported.at.map_or(f64::INFINITY, |at| at.distance(goal));
        if robot.may_move() || off_m > MISSED_M {
            return Next::drop(participant, Trouble::Missed);
        }
        self.accept_misaligned(cx, participant, off_m)
    }

    /// Checks during a hold whether all robots that follow routes stand. Robots that still drive are sent HOLD
    /// individually. If some drive after `HOLD_BOUND`, all robots are stopped and planned again.
    fn check_hold(&mut self, cx: &mut RunContext) -> Next {
        let Some(hold) = self.clock.open_hold().copied().filter(|hold| cx.now >= hold.check_at) else {
            return Next::Stay;
        };
        if cx.pipeline.leg().is_none_or(|leg| leg.kind == LegKind::Targets) {
            return Next::Stay;
        }
        let moves = |&one: &usize| {
            self.is_under_way(cx, one) && cx.robot(one).reported.state == Some(RobotState::Driving)
        };
        let moving: Vec<usize> = (0..cx.roster.len()).filter(moves).collect();
        if moving.is_empty() {
            let check_at = cx.now + HOLD_CHECK_EVERY;
            self.clock.hold = Some(crate::run::path_clock::Hold { check_at, ..hold });
            return Next::Stay;
        }
        if cx.now - hold.at > HOLD_BOUND + Route::EASE {
            return Next::Regather;
        }
        for participant in moving {
            cx.send(participant, &[Command::Hold { at: hold.at }, Command::Status]);
        }
        Next::Stay
    }
}

/// Whether a robot drives close to its route and is not near the end of the route, by its report. Near the end, its
/// distance off the route and its distance to the goal are about equal.
fn is_on_its_way(cx: &RunContext, participant: usize) -> bool {
    let robot = cx.robot(participant);
    let (Some(at), Some(goal), Some(off_m)) = (robot.reported.at, cx.goal(participant), robot.reported.off_m)
    else {
        return false;
    };
    robot.may_move() && off_m <= LATE_MAX_M && at.distance(goal) > off_m + END_M
}

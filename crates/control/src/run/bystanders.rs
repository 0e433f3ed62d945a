//! Robots that dropped out and still report. People may put them aside, or robots find their position again, so that
//! plans do not know where they stand.
//!
//! A leg is the drive of all robots between two moments at which all stand.

use crate::leg::Leg;
use crate::run::run_context::RunContext;
use lightbots_base::{Span, Vec2};
use std::sync::Arc;

/// A reported place and a place that the plan drives around count as the same if they are closer than this, metres.
/// This is 4 sigma of a position fix, whose sigma is 2 mm.
const SAME_M: f64 = 0.008;
/// Share of the contact distance (between the centres of two robots that touch). A path that comes closer to a robot
/// than this share leads through the robot. Plans keep the whole distance and more; position fixes are off by a few
/// millimetres.
const THROUGH: f64 = 0.9;
/// Least time between two sampled places of a path; in it a robot drives 14 mm at full speed.
const STEP: Span = Span::from_millis(50);
/// How often all is planned again because of one robot. After that its reports are ignored, because a robot that is
/// somewhere else each time must not hold up the show.
const REPLANS_MAX: u8 = 3;
/// Least time between two comparisons of paths with the reports of one robot; before a START paths are compared in any
/// case. It takes milliseconds to compare 10,000 paths, and a robot that stands reports only every 2 s (R41).
const LOOK_EVERY: Span = Span::from_millis(500);

/// The places where robots that dropped out stand, by their reports, stage metres. Plans drive around them.
pub(crate) fn places(cx: &RunContext) -> Arc<[Vec2]> {
    (0..cx.roster.len()).filter_map(|participant| place(cx, participant)).collect()
}

/// Whether the first leg of the queue leads through a robot that dropped out and stands where no plan expected it. If
/// so, counts a replan for that robot.
pub(crate) fn obstruct_next(cx: &mut RunContext) -> bool {
    let obstructing = cx.pipeline.queue.front().and_then(|leg| {
        (0..cx.roster.len()).find(|&participant| {
            unexpected(cx, leg, participant).is_some_and(|at| leads_through(cx, leg, Span::ZERO, at))
        })
    });
    obstructing.inspect(|&participant| plan_around(cx, participant)).is_some()
}

/// Whether a leg leads through a participant that dropped out and reports its place. With `driven`, the leg is the one
/// that robots drive, from this path time on. With `None` it is the first leg of the queue. If the leg leads through
/// the participant, counts a replan for it. `false` without a comparison if the last one is less than `LOOK_EVERY` ago.
/// Also `false` if the plan of the leg drives around the place, or after `REPLANS_MAX` replans.
pub(crate) fn obstructs(cx: &mut RunContext, participant: usize, driven: Option<Span>) -> bool {
    let leg = if driven.is_some() { cx.pipeline.leg() } else { cx.pipeline.queue.front() };
    let from = driven.unwrap_or(Span::ZERO);
    let Some(leg) = leg else { return false };
    let Some(at) = unexpected(cx, leg, participant) else { return false };
    if cx.now < cx.participant(participant).bystander.look_at {
        return false;
    }
    let is_through = leads_through(cx, leg, from, at);
    cx.roster.participants[participant].bystander.look_at = cx.now + LOOK_EVERY;
    if is_through {
        plan_around(cx, participant);
    }
    is_through
}

/// Counts a replan that a robot makes necessary.
fn plan_around(cx: &mut RunContext, participant: usize) {
    cx.roster.participants[participant].bystander.replans += 1;
}

/// Where a participant that dropped out stands by its own report, stage metres. `None` if it may be moving or reports
/// no place, if another robot shares its name, or if it takes part.
fn place(cx: &RunContext, participant: usize) -> Option<Vec2> {
    let (known, robot) = (cx.participant(participant), cx.robot(participant));
    let says_where = known.is_excluded() && known.last_seen.possible.is_empty();
    robot.reported.at.filter(|_| says_where && !robot.may_move() && !robot.namesakes.are_there())
}

/// The place from [`place`], unless the plan of `leg` drives around it. `None` also if the robot has caused too many
/// replans.
fn unexpected(cx: &RunContext, leg: &Leg, participant: usize) -> Option<Vec2> {
    let may_cost = cx.participant(participant).bystander.replans < REPLANS_MAX;
    let is_known = |at: Vec2| leg.around.iter().any(|known| known.distance(at) < SAME_M);
    place(cx, participant).filter(|&at| may_cost && !is_known(at))
}

fn leads_through(cx: &RunContext, leg: &Leg, from: Span, at: Vec2) -> bool {
    let near_m = cx.playback.contact_m() * THROUGH;
    let speed_mps = cx.playback.show.stage.limits.speed_mps;
    let passes = |one: usize| {
        let Some(path) = leg.path(one) else { return false };
        let (path, mut time) = (path.as_ref(), from.max(Span::ZERO));
        while time <= path.duration() {
            let far_m = path.at(time).position.distance(at) - near_m;
            if far_m < 0.0 {
                return true;
            }
            // The robot cannot be at `at` sooner than at full speed.
            time += STEP.max(Span::from_secs(far_m / speed_mps));
        }
        false
    };
    cx.roster.active().any(|(one, _)| passes(one))
}

//! Robots that dropped out and still report. People may put them aside, or they find their position again. A plan
//! then may not know where they stand.

use crate::leg::Leg;
use crate::run::run_context::RunContext;
use lightbots_base::{Span, Vec2};
use std::sync::Arc;

/// Largest distance between a reported place and a place that the plan drives around at which both count as one,
/// metres. This is 4 sigma of two fixes.
const SAME_M: f64 = 0.008;
/// Share of the contact distance: a path that comes closer to a robot leads through it. Plans keep the whole distance
/// and more; fixes are off by a few millimetres.
const THROUGH: f64 = 0.9;
/// Least time between two sampled places of a path: 14 mm at full speed.
const STEP: Span = Span::from_millis(50);
/// Largest number of times that all is planned again because of one robot. A robot that is somewhere else each time
/// must not hold up the show.
const REPLANS_MAX: u8 = 3;
/// Least time between two comparisons of the paths of a drive with the reports of one robot. To compare 10,000 paths
/// takes milliseconds, and a robot that stands reports every 2 s (R41).
const LOOK_EVERY: Span = Span::from_millis(500);

/// The places where robots that dropped out report to stand. Plans drive around them.
pub(crate) fn places(cx: &RunContext) -> Arc<[Vec2]> {
    (0..cx.roster.len()).filter_map(|participant| place(cx, participant)).collect()
}

/// Whether the first leg of the queue leads through a robot that dropped out. If it does, a replan is counted for
/// that robot.
pub(crate) fn obstruct_next(cx: &mut RunContext) -> bool {
    let obstructing = cx.pipeline.queue.front().and_then(|leg| {
        (0..cx.roster.len()).find(|&participant| {
            unexpected(cx, leg, participant).is_some_and(|at| leads_through(cx, leg, Span::ZERO, at))
        })
    });
    obstructing.inspect(|&participant| plan_around(cx, participant)).is_some()
}

/// Whether a leg leads through a participant that dropped out and reports. With `driven` this is the driven leg from
/// that path time on; otherwise it is the first leg of the queue. Answers `false` within `LOOK_EVERY` of the last
/// comparison.
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

/// Counts a replan because of a robot.
fn plan_around(cx: &mut RunContext, participant: usize) {
    cx.roster.participants[participant].bystander.replans += 1;
}

/// Where a participant that dropped out stands, by its own report. `None` if it may be moving, or if its name is
/// shared.
fn place(cx: &RunContext, participant: usize) -> Option<Vec2> {
    let (known, robot) = (cx.participant(participant), cx.robot(participant));
    let says_where = known.is_excluded() && known.last_seen.possible.is_empty();
    robot.reported.at.filter(|_| says_where && !robot.may_move() && !robot.namesakes.are_there())
}

/// Where a participant that dropped out stands, unless the plan of a leg drives around that place. `None` also once
/// it has caused too many replans.
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

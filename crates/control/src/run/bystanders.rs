//! Robots that dropped out and still report. People put them aside, or they find their place again: then a plan may not know
//! where they stand.

use crate::leg::Leg;
use crate::run::run_context::RunContext;
use lightbots_base::{Span, Vec2};
use std::sync::Arc;

/// A robot that stands within this of where a plan drives around it is where the plan has it, metres: 4 sigma of two fixes.
const SAME_M: f64 = 0.008;
/// Share of the contact distance within which a path leads through a robot. Plans pass at the whole distance and more; fixes
/// are off by a few millimetres.
const THROUGH: f64 = 0.9;
/// Least time between two places of a path that are looked at: 14 mm at full speed.
const STEP: Span = Span::from_millis(50);
/// How often all is planned again because of one robot. One that is somewhere else each time must not hold up the show.
const REPLANS_MAX: u8 = 3;
/// The paths of a drive are compared with the reports of one robot this often at most: 10,000 paths take milliseconds, and a
/// robot that stands reports every 2 s (R41).
const LOOK_EVERY: Span = Span::from_millis(500);

/// Where robots report to stand that dropped out: plans drive around these places.
pub(crate) fn places(cx: &RunContext) -> Arc<[Vec2]> {
    (0..cx.roster.len()).filter_map(|participant| place(cx, participant)).collect()
}

/// Whether the first leg of the queue leads through a robot that dropped out.
pub(crate) fn obstruct_next(cx: &mut RunContext) -> bool {
    let obstructing = cx.pipeline.queue.front().and_then(|leg| {
        (0..cx.roster.len()).find(|&participant| {
            unexpected(cx, leg, participant).is_some_and(|at| leads_through(cx, leg, Span::ZERO, at))
        })
    });
    obstructing.inspect(|&participant| plan_around(cx, participant)).is_some()
}

/// Whether a leg leads through a participant that reports: the one that is driven, from the path time `driven` on, or the
/// first of the queue, whose START is stated.
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

/// Notes that all is planned again because of a robot.
fn plan_around(cx: &mut RunContext, participant: usize) {
    cx.roster.participants[participant].bystander.replans += 1;
}

/// Where a participant stands that dropped out, by its own report.
fn place(cx: &RunContext, participant: usize) -> Option<Vec2> {
    let (known, robot) = (cx.participant(participant), cx.robot(participant));
    let says_where = known.is_excluded() && known.last_seen.possible.is_empty();
    robot.reported.at.filter(|_| says_where && !robot.may_move() && !robot.namesakes.are_there())
}

/// Where a participant stands that dropped out, if the plan of a leg has it elsewhere.
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
            // A robot is not there sooner.
            time += STEP.max(Span::from_secs(far_m / speed_mps));
        }
        false
    };
    cx.roster.active().any(|(one, _)| passes(one))
}

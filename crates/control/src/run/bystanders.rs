//! Robots that dropped out and still report. People put them aside, or they find their place again: no plan may expect them
//! where they stand then.

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

/// Where robots report to stand that dropped out: plans drive around these places.
pub(crate) fn places(cx: &RunContext) -> Arc<[Vec2]> {
    (0..cx.roster.len()).filter_map(|participant| place(cx, participant)).collect()
}

/// Whether the first leg of the queue leads through a robot that dropped out.
pub(crate) fn obstruct_next(cx: &mut RunContext) -> bool {
    let through = cx.pipeline.queue.front().and_then(|leg| {
        (0..cx.roster.len()).find(|&participant| leads_through(cx, leg, Span::ZERO, participant))
    });
    through.is_some_and(|participant| is_planned_around(cx, participant))
}

/// Whether the leg that is driven, from this path time on, leads through a participant that reports.
pub(crate) fn obstructs_drive(cx: &mut RunContext, participant: usize, from: Span) -> bool {
    let is_through = cx.pipeline.leg().is_some_and(|leg| leads_through(cx, leg, from, participant));
    is_through && is_planned_around(cx, participant)
}

/// Whether all is planned again because of this robot: it is, a few times.
fn is_planned_around(cx: &mut RunContext, participant: usize) -> bool {
    let times = &mut cx.roster.participants[participant].planned_around;
    *times = times.saturating_add(1);
    *times <= REPLANS_MAX
}

/// Where a participant stands that dropped out, by its own report.
fn place(cx: &RunContext, participant: usize) -> Option<Vec2> {
    let (known, robot) = (cx.participant(participant), cx.robot(participant));
    let says_where = known.is_excluded() && known.last_seen.possible.is_empty();
    robot.reported.at.filter(|_| says_where && !robot.may_move() && !robot.namesakes.are_there())
}

fn leads_through(cx: &RunContext, leg: &Leg, from: Span, participant: usize) -> bool {
    let Some(at) = place(cx, participant) else { return false };
    if leg.around.iter().any(|known| known.distance(at) < SAME_M) {
        return false;
    }
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

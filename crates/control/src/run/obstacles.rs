//! What plans drive around: robots that take no part, places where silent robots may stand, and what robots met in
//! their paths.
//!
//! A disc is the outline of a robot at a place on the floor.

use crate::frame_cursor::FrameCursor;
use crate::mutant::Mutant;
use crate::robot::KnownRobot;
use crate::run::roster::{Participant, Whereabouts};
use crate::run::run_context::RunContext;
use crate::snapshot::Age;
use crate::unsure_places::REST_CLEARANCE_M;
use lightbots_base::Vec2;

/// If two places are closer than this share of the contact distance, they cannot both hold a robot: one of them is out
/// of date. The contact distance is between the centres of two robots that touch.
const SAME_PLACE: f64 = 0.9;

/// How an inferred disc is moved out of robots that reported their places.
struct Displacement {
    /// Farthest that a disc is moved, metres, because inferred places are off by up to 20 mm.
    most_m: f64,
    /// Number of times that the disc is moved out of each robot around it in turn. At most three robots are around a
    /// disc.
    sweeps: usize,
}

/// If a disc is not moved, there is no plan. If it is moved farther, plans lead through a dead robot.
const DISPLACEMENT: Displacement = Displacement { most_m: 0.03, sweeps: 10 };

/// Discs that stand still during a drive: their centres, stage metres.
pub(crate) struct Discs {
    /// Places of robots that reported them.
    pub reported: Vec<Vec2>,
    /// Places that no robot reported.
    pub inferred: Vec<Vec2>,
}

/// The discs of everything on the floor that takes no part in the next plan. Inferred discs are first moved out of
/// robots that take part. A disc that still overlaps the start of one of these robots is out of date, and left out.
pub(crate) fn standing_discs(cx: &RunContext) -> Discs {
    let contact_m = cx.playback.contact_m();
    let near_m = contact_m * SAME_PLACE;
    let from = &cx.pipeline.planning.from;
    let starts: Vec<Vec2> = cx.roster.active().map(|(one, _)| from[one]).collect();
    let is_free = |at: &Vec2| starts.iter().all(|start| start.distance(*at) >= near_m);
    let is_forgotten = Mutant::ForgetDeadRobot.is_planted();
    let silent = cx.roster.participants.iter().filter(|known| known.is_excluded() && !is_forgotten);
    let places = silent.flat_map(|known| places_of(cx, known));
    let inferred =
        places.chain(cx.pipeline.obstacles.found.iter().copied()).map(|at| displaced(at, &starts, contact_m));
    let robots = cx.io.fleet.robots().iter().filter(|robot| is_obstacle(cx, robot));
    Discs {
        reported: robots.filter_map(|robot| robot.reported.at).filter(is_free).collect(),
        inferred: inferred.filter(is_free).collect(),
    }
}

/// Where a robot that dropped out may stand. If several robots share its name, these are the places that they have
/// reported: they have stood since STOP.
fn places_of(cx: &RunContext, known: &Participant) -> Vec<Vec2> {
    let namesakes = &cx.io.fleet.robot(known.robot).namesakes;
    let is_shared = namesakes.are_there() && !known.last_seen.possible.is_empty();
    if is_shared { namesakes.places() } else { known.last_seen.possible.clone() }
}

/// Whether plans drive around the place that a robot reported, because it stands there and takes no part.
fn is_obstacle(cx: &RunContext, robot: &KnownRobot) -> bool {
    let known = robot.participant.map(|participant| cx.participant(participant as usize));
    let is_ignored = cx.pipeline.obstacles.ignores_strangers && cx.roster.is_stranger(robot);
    match known {
        // The possible places of a silent robot count, and not the place of its last report.
        Some(_) if Mutant::ForgetDeadRobot.is_planted() => false,
        Some(known) => known.is_excluded() && !known.is_unplaced(),
        None => robot.contact.age != Age::Gone && !is_ignored,
    }
}

/// Drops obstacles, because no plan leads from where robots stand to the next frame. Returns whether anything was
/// dropped. Each call drops the first of these that is left:
/// - robots that came during the run and take no part (any client can claim to be a robot);
/// - unlikely places of silent robots;
/// - all inferred places. If TARGET-only robots take part, places of silent robots are kept: on the way to a TARGET no
///   robot brakes for what it sees (R49 of docs/protocol.md);
/// - the next frame itself, so that robots go to the one after it.
pub(crate) fn relax(cx: &mut RunContext) -> bool {
    let participants = &cx.roster.participants;
    let is_any_silent = participants.iter().any(|known| !known.last_seen.possible.is_empty());
    let drops_silent = is_any_silent && !cx.roster.has_target_robots(cx.io);
    let is_any_inferred = !cx.pipeline.obstacles.found.is_empty() || drops_silent;
    let is_unlikely = |places: &Whereabouts| places.possible.len() > places.likely.len();
    let has_unlikely = participants.iter().any(|known| is_unlikely(&known.last_seen));
    let has_strangers = cx.io.fleet.robots().iter().any(|robot| cx.roster.is_stranger(robot));
    let participants = &mut cx.roster.participants;
    if has_strangers && !std::mem::replace(&mut cx.pipeline.obstacles.ignores_strangers, true) {
        return true;
    }
    if has_unlikely {
        let keep_likely = |places: &mut Whereabouts| places.possible.clone_from(&places.likely);
        participants.iter_mut().for_each(|known| keep_likely(&mut known.last_seen));
    } else if is_any_inferred {
        cx.pipeline.obstacles.found.clear();
        if drops_silent {
            participants.iter_mut().for_each(|known| known.last_seen = Whereabouts::default());
        }
    } else {
        let after = cx.playback.after(cx.playback.next);
        let goes_on =
            |next: &FrameCursor| next.round == cx.playback.next.round && next.pass <= cx.playback.next.pass;
        let Some(next) = after.filter(goes_on) else { return false };
        cx.playback.next = next;
    }
    true
}

/// Moves the inferred place of a disc until the disc touches none of the robots at `starts`. Returns `place` unchanged
/// if it would move too far. The disc then overlaps a robot, and the caller drops it.
fn displaced(place: Vec2, starts: &[Vec2], contact_m: f64) -> Vec2 {
    let near: Vec<Vec2> =
        starts.iter().copied().filter(|start| start.distance(place) < 2.0 * contact_m).collect();
    let mut at = place;
    for _ in 0..DISPLACEMENT.sweeps {
        for start in &near {
            let missing_m = contact_m + REST_CLEARANCE_M - start.distance(at);
            if missing_m > 0.0 {
                at += (at - *start).normalized().unwrap_or(Vec2::new(1.0, 0.0)) * missing_m;
            }
        }
    }
    if at.distance(place) <= DISPLACEMENT.most_m { at } else { place }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_is_moved_out_of_a_robot_only_where_that_is_near() {
        let robot = [Vec2::ZERO];
        let moved = displaced(Vec2::new(0.04, 0.0), &robot, 0.054);
        assert!((moved.x - 0.055).abs() < 1e-9, "{moved:?}");
        let inside = Vec2::new(0.01, 0.0);
        assert_eq!(displaced(inside, &robot, 0.054), inside);
    }
}

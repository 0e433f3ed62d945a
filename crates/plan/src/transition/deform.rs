//! Deforms straight lines: displaces the paths of pairs that come too close by a few millimetres, at little or no cost
//! of time.

use super::candidate::{Aim, Candidate, slower_than};
use super::following;
use crate::cancel::Cancel;
use crate::margins::{COMFORT_M, MARGIN_M};
use crate::motion::{Displacements, turn_time, whole_millis};
use crate::{Closest, Path, Transition, TransitionProblem};
use lightbots_base::{Piece, Span, Vec2};
use std::collections::BTreeMap;

/// Number of conflicts between two polls of the cancellation.
const POLLED: usize = 1024;
/// Most rounds, each a deformation and a proof.
const ROUNDS: usize = 6;
/// Number of successive rounds without a better result after which the deformation ends.
const MOST_IN_VAIN: usize = 2;
/// Bound on the number of robots × rounds, for rounds that aim at the following distance. With that distance, a robot
/// can stop behind a robot ahead that stops dead.
const ROOM_WORK: usize = 2_000;
/// Largest factor on the duration that a deformation with this aim may need.
const fn slowest(aim: Aim) -> f64 {
    match aim {
        Aim::Comfort => 1.06,
        Aim::Room => 1.04,
    }
}

/// Factor on a displacement: at the moment at which the pair is closest, the displacement has already faded a little.
const EXTRA: f64 = 1.15;

/// Returns the better of a candidate of straight lines, `straight`, and its deformation. `start_of[goal]` is its
/// assignment. Makes at most `rounds` rounds for each aim, and none if too many pairs conflict. With an asked duration,
/// a deformation that is better at full speed is returned.
pub(super) fn deform(
    problem: &TransitionProblem,
    start_of: &[usize],
    straight: Candidate,
    rounds: usize,
    cancel: Cancel<'_>,
) -> Candidate {
    let wished = straight.transition.duration;
    if wished <= straight.transition.least {
        return deformed(problem, straight, rounds, cancel);
    }
    // The deformation is made at full speed, so that it has the least duration. Then it is driven as slowly as asked.
    let hurried = TransitionProblem { duration: None, ..problem.clone() };
    let mut quick = deformed(&hurried, Candidate::straight(&hurried, start_of, cancel), rounds, cancel);
    if !quick.improves_on(&straight) {
        return straight;
    }
    let Transition { paths, goal_of, least, .. } = &mut quick.transition;
    let factor = slower_than(*least, wished, &problem.limits);
    if factor <= 1.0 {
        return quick;
    }
    let rest = turn_time(core::f64::consts::FRAC_PI_2, &problem.limits);
    let slow = paths.iter().map(|path| slower(path, rest, factor)).collect();
    let mut candidate = Candidate::of_paths(problem, slow, std::mem::take(goal_of), factor, cancel);
    candidate.transition.least = *least;
    candidate
}

/// Returns the best deformation of a candidate at full speed: first for the comfortable clearance, then for the
/// following distance.
fn deformed(
    problem: &TransitionProblem,
    straight: Candidate,
    rounds: usize,
    cancel: Cancel<'_>,
) -> Candidate {
    let lines = straight.transition.paths.clone();
    let mut displacements: BTreeMap<usize, Displacements> = BTreeMap::new();
    let least = straight.transition.least;
    let mut best = straight;
    for aim in [Aim::Comfort, Aim::Room] {
        let mut conflicts = best.worth_deforming(aim);
        let most = if aim == Aim::Room { ROOM_WORK / lines.len().max(1) } else { ROUNDS };
        let mut in_vain = 0;
        for _ in 0..rounds.min(ROUNDS).min(most) {
            if conflicts.is_empty() || in_vain == MOST_IN_VAIN || cancel.is_wanted() {
                break;
            }
            let mut paths = lines.clone();
            for (number, found) in conflicts.iter().enumerate() {
                if number.is_multiple_of(POLLED) && cancel.is_wanted() {
                    return best;
                }
                part(problem, &lines, found, aim, &mut displacements);
            }
            for (&robot, displacement) in &displacements {
                paths[robot] = displacement.applied_to(&lines[robot]);
            }
            let mut deformed =
                Candidate::of_paths(problem, paths, best.transition.goal_of.clone(), 1.0, cancel);
            deformed.transition.least = least;
            conflicts = deformed.worth_deforming(aim);
            if !deformed.proof.faults.is_empty() && deformed.is_roomier_than(&best) {
                deformed = time_scaled(problem, deformed, aim, cancel);
            }
            if deformed.improves_on(&best) {
                (best, in_vain) = (deformed, 0);
            } else {
                in_vain += 1;
            }
        }
    }
    best
}

/// Slows all paths of a candidate so that they keep the limits of speed and acceleration. The reason: a robot at full
/// speed has no speed left for a displacement. Returns the candidate unchanged if it would have to be slower than
/// [`slowest`] allows.
fn time_scaled(problem: &TransitionProblem, deformed: Candidate, aim: Aim, cancel: Cancel<'_>) -> Candidate {
    let too_fast = deformed
        .proof
        .faults
        .iter()
        .map(|fault| time_scale(&deformed.transition.paths[fault.robot], problem));
    let factor = too_fast.fold(1.0, f64::max) * 1.000_5;
    if factor > slowest(aim) {
        return deformed;
    }
    let paths = deformed.transition.paths.iter().map(|path| slower(path, Span::ZERO, factor)).collect();
    Candidate::of_paths(problem, paths, deformed.transition.goal_of, 1.0, cancel)
}

/// Factor by which the duration of a path must be multiplied to keep the limits of speed and acceleration; at least 1.
/// It is calculated from the path's control points.
fn time_scale(path: &Path, problem: &TransitionProblem) -> f64 {
    let (speed, accel) = (problem.limits.speed_mps.max(1e-3), problem.limits.accel_mps2.max(1e-3));
    path.as_ref().timed().fold(1.0, |most, (from, _, piece)| {
        let seconds = piece.duration.as_secs().max(1e-6);
        let steps =
            [piece.c1 - from, piece.c2 - piece.c1, piece.end - piece.c2].map(|step| step * (3.0 / seconds));
        let fastest = steps.iter().map(|step| step.length()).fold(0.0, f64::max);
        let hardest = (steps[1] - steps[0]).length().max((steps[2] - steps[1]).length()) * (2.0 / seconds);
        most.max(fastest / speed).max((hardest / accel).sqrt())
    })
}

/// Returns the path with all time after `rest` multiplied by `factor`. Moments are rounded to whole milliseconds, in
/// the same way for all paths.
fn slower(path: &Path, rest: Span, factor: f64) -> Path {
    let late = |at: Span| at.min(rest) + whole_millis((at - rest).as_secs() * factor);
    let pieces = path.as_ref().timed().map(|(_, begin, piece)| {
        let duration = late(begin + piece.duration) - late(begin);
        Piece { duration, ..*piece }
    });
    Path { start: path.start, pieces: pieces.collect() }
}

/// Displaces the robots of a pair away from each other at their closest moment. Shares are proportional to the lengths
/// of their lines. Standing discs do not move.
fn part(
    problem: &TransitionProblem,
    lines: &[Path],
    found: &Closest,
    aim: Aim,
    displacements: &mut BTreeMap<usize, Displacements>,
) {
    let (i, j) = found.pair;
    let way_m = |disc: usize| lines.get(disc).map_or(0.0, |line| line.start.distance(line.as_ref().end()));
    let place = |disc: usize| match lines.get(disc) {
        Some(line) => line.as_ref().at(found.at).position,
        None => problem.standing[disc - lines.len()],
    };
    let both_m = way_m(i) + way_m(j);
    let Some(apart) = (place(i) - place(j)).normalized() else { return };
    let room_m = match aim {
        Aim::Comfort => problem.limits.contact_m() + COMFORT_M,
        Aim::Room => following::wanted_m(lines, found, &problem.limits, 1.0),
    };
    // A pair that starts or ends closer only has to keep the smaller distance.
    let ends_m = |at_end: bool| {
        let end = |disc: usize| match lines.get(disc) {
            Some(line) if at_end => line.as_ref().end(),
            Some(line) => line.start,
            None => place(disc),
        };
        end(i).distance(end(j))
    };
    let wanted_m = room_m.min(ends_m(false)).min(ends_m(true)) - found.distance_m + MARGIN_M / 10.0;
    if both_m <= 0.0 || wanted_m <= 0.0 {
        return;
    }
    let mut push = |disc: usize, direction: Vec2| {
        let share = way_m(disc) / both_m;
        if share > 0.0 {
            displacements.entry(disc).or_default().push(found.at, direction * (wanted_m * share * EXTRA));
        }
    };
    push(i, apart);
    push(j, -apart);
}

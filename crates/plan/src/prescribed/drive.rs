//! Gives each robot its way, which is its whole path in a prescribed drive, and checks the drive with the proof.

use std::collections::BTreeMap;

use lightbots_base::{Piece, Span, Vec2};

use super::timing::{TimedDrive, timed};
use super::way::PrescribedWay;
use super::{Prescribed, Stagger};
use crate::cancel::Cancel;
use crate::margins::COMFORT_M;
use crate::motion::delayed;
use crate::problem::ASKED_SLACK_S;
use crate::proof::{Fault, FaultKind, Proof, ProofInput, prove_unless};
use crate::{Closest, Infeasible, Path, Transition, TransitionProblem};

/// Greatest distance of a robot from the beginning of its way, metres. Robots come to rest within this distance of
/// their places.
const NEAR_START_M: f64 = 0.006;
/// Greatest distance of a pixel from the end of its way, metres. It must exceed the rounding of files, which is a tenth
/// of a millimetre.
const NEAR_GOAL_M: f64 = 0.001;
/// Shares of the prescribed delay of starts that are tried, one after the other.
const DELAY_SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];

/// Plans the prescribed drive. `Err(None)` if robots or pixels are not where the ways begin and end, or a pixel is
/// pinned to another robot. `Err(Some)`, with the reason, if the drive applies but must not be driven.
pub(crate) fn attempt(
    problem: &TransitionProblem,
    prescribed: &Prescribed,
    cancel: Cancel<'_>,
) -> Result<Transition, Option<Infeasible>> {
    let start_of = starts_of(problem, &prescribed.ways).ok_or(None)?;
    let ends = prescribed.ways.iter().map(PrescribedWay::end);
    if ends.zip(&problem.goals).any(|(end, goal)| end.is_none_or(|end| end.distance(*goal) > NEAR_GOAL_M)) {
        return Err(None);
    }
    let ways: Vec<PrescribedWay> =
        prescribed.ways.iter().zip(&start_of).zip(&problem.goals).map(joined(problem)).collect();
    let TimedDrive { paths: ways, least } = timed(&ways, &problem.limits, problem.easing, problem.duration);
    let asked = problem.duration.filter(|asked| (least - *asked).as_secs() > ASKED_SLACK_S);
    if let Some(asked) = asked {
        let message = format!(
            "the {} takes at least {:.2} s, and {:.2} s are asked; give it more time, or ask for none",
            prescribed.name,
            least.as_secs() + ASKED_SLACK_S,
            asked.as_secs()
        );
        return Err(Some(Infeasible { goals: Vec::new(), starts: Vec::new(), message }));
    }
    let (paths, goal_of) = of_robots(problem, ways, &start_of);
    let input = ProofInput { gap_m: problem.limits.contact_m() + COMFORT_M, ..problem.to_prove(&paths) };
    let proof = prove_unless(&input, cancel);
    if !proof.holds() {
        return Err(Some(refusal(problem, prescribed.name, &goal_of, &proof)));
    }
    let duration = Path::longest(&paths);
    let longest_m =
        problem.goals.iter().zip(&start_of).map(|(goal, &start)| goal.distance(problem.starts[start]));
    let lower_bound_s = longest_m.fold(0.0, f64::max) / problem.limits.speed_mps.max(1e-3);
    let closest = proof.closest;
    Ok(Transition { goal_of, paths, duration, least: least.max(Span::ZERO), lower_bound_s, closest })
}

/// Returns `[goal]`: the index of the robot at the beginning of the way to that goal. `None` if a robot is missing or
/// has another way, or if a goal is pinned to another robot.
fn starts_of(problem: &TransitionProblem, ways: &[PrescribedWay]) -> Option<Vec<usize>> {
    let cell = |at: Vec2| ((at.x / NEAR_START_M).floor() as i64, (at.y / NEAR_START_M).floor() as i64);
    let mut robots: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    for (robot, &at) in problem.starts.iter().enumerate() {
        robots.entry(cell(at)).or_default().push(robot);
    }
    let nearest = |at: Vec2| {
        let (x, y) = cell(at);
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
        let near = around.filter_map(|cell| robots.get(&cell)).flatten().copied();
        let gap = |robot: &usize| problem.starts[*robot].distance(at);
        near.filter(|robot| gap(robot) <= NEAR_START_M).min_by(|a, b| gap(a).total_cmp(&gap(b)))
    };
    let mut is_taken = vec![false; problem.starts.len()];
    let mut found = Vec::with_capacity(ways.len());
    for (goal, way) in ways.iter().enumerate() {
        let robot = nearest(way.start()?)?;
        let is_bound_elsewhere = problem.pinned.get(goal).copied().flatten().is_some_and(|pin| pin != robot);
        if is_bound_elsewhere || std::mem::replace(&mut is_taken[robot], true) {
            return None;
        }
        found.push(robot);
    }
    Some(found)
}

/// Returns a function that displaces a way, so that it begins where its robot stands and ends at its pixel. Its
/// arguments are the way, the index of the robot and the goal.
fn joined(problem: &TransitionProblem) -> impl Fn(((&PrescribedWay, &usize), &Vec2)) -> PrescribedWay {
    |((way, &start), &goal)| {
        let start = problem.starts[start];
        match way {
            PrescribedWay::Timed(path) => PrescribedWay::Timed(path_between(path, start, goal)),
            PrescribedWay::Parts(parts) => {
                let last = parts.len() - 1;
                let joined = parts.iter().cloned().enumerate().map(|(index, mut part)| {
                    let (from, to) = ((index == 0).then_some(start), (index == last).then_some(goal));
                    part.shape = part.shape.between(from, to);
                    part
                });
                PrescribedWay::Parts(joined.collect())
            }
        }
    }
}

/// Moves the beginning of a path to `start` and its end to `goal`. Only the first and the last moving piece change
/// their shapes; rests before and after them move along. The velocities at both ends stay the same.
fn path_between(path: &Path, start: Vec2, goal: Vec2) -> Path {
    let (first, last) = (start - path.start, goal - path.as_ref().end());
    let moves = |(from, _, piece): &(Vec2, Span, &Piece)| !piece.is_rest(*from);
    let moving: Vec<bool> = path.as_ref().timed().map(|piece| moves(&piece)).collect();
    let begins = moving.iter().position(|moves| *moves).unwrap_or(moving.len());
    let ends = moving.iter().rposition(|moves| *moves).unwrap_or(0);
    let mut joined = Path { start, pieces: path.pieces.clone() };
    for (index, piece) in joined.pieces.iter_mut().enumerate() {
        let offset = |is_first: bool, is_last: bool| {
            if is_first {
                first
            } else if is_last {
                last
            } else {
                Vec2::ZERO
            }
        };
        piece.c1 += offset(index <= begins, index > ends);
        piece.c2 += offset(index < begins, index >= ends);
        piece.end += offset(index < begins, index >= ends);
    }
    joined
}

/// Returns the paths and the goals of all robots: `ways[goal]` for the robot `start_of[goal]`; robots without a goal
/// stay. All paths last as long as the longest way.
fn of_robots(
    problem: &TransitionProblem,
    ways: Vec<Path>,
    start_of: &[usize],
) -> (Vec<Path>, Vec<Option<usize>>) {
    let whole = Path::longest(&ways);
    let mut goal_of = vec![None; problem.starts.len()];
    let resting = |&at: &Vec2| Path { start: at, pieces: vec![Piece::rest(at, whole)] };
    let mut paths: Vec<Path> = problem.starts.iter().map(resting).collect();
    for (goal, (mut path, &robot)) in ways.into_iter().zip(start_of).enumerate() {
        let left = whole - path.as_ref().duration();
        if left > Span::ZERO {
            path.pieces.push(Piece::rest(path.as_ref().end(), left));
        }
        goal_of[robot] = Some(goal);
        paths[robot] = path;
    }
    if whole == Span::ZERO {
        paths.iter_mut().for_each(|path| path.pieces.clear());
    }
    (paths, goal_of)
}

/// Returns why a prescribed drive must not be driven, and what would help.
fn refusal(problem: &TransitionProblem, name: &str, goal_of: &[Option<usize>], proof: &Proof) -> Infeasible {
    let goals = |robots: &[usize]| {
        robots.iter().filter_map(|&robot| goal_of.get(robot).copied().flatten()).collect::<Vec<_>>()
    };
    let nearest = proof.conflicts.iter().min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    let (robots, message) = match (nearest, proof.faults.first()) {
        (Some(found), _) => (vec![found.pair.0, found.pair.1], too_close(problem, name, found)),
        (None, Some(fault)) => (vec![fault.robot], faulty(name, fault)),
        (None, None) => (Vec::new(), format!("the {name} was not proven in time")),
    };
    let starts = robots.iter().copied().filter(|&robot| robot < problem.starts.len()).collect();
    Infeasible { goals: goals(&robots), starts, message }
}

fn too_close(problem: &TransitionProblem, name: &str, found: &Closest) -> String {
    format!(
        "in the {name}, two robots would come within {:.0} mm near ({:.2}, {:.2}) m after {:.1} s, and {:.0} mm are \
         needed; leave more room between pixels, or change the {name}",
        found.distance_m * 1e3,
        found.place.x,
        found.place.y,
        found.at.as_secs(),
        (problem.limits.contact_m() + COMFORT_M) * 1e3
    )
}

fn faulty(name: &str, fault: &Fault) -> String {
    let (what, remedy) = match fault.kind {
        FaultKind::Floor => ("leave the floor", "move the picture, or make the motion smaller"),
        FaultKind::Obstacle => ("meet a no-go area", "lead the motion around it"),
        FaultKind::Turn => ("turn faster than it can", "give the curve fewer corners, or more time"),
        FaultKind::Malformed => ("have times that do not increase", "correct the trajectory"),
        FaultKind::Jump => {
            ("jump to another speed", "let the trajectory begin and end at rest, without steps")
        }
        FaultKind::Speed | FaultKind::Acceleration | FaultKind::Wheel => {
            ("be faster than it can", "give it more time")
        }
    };
    format!("in the {name}, a robot would {what} after {:.1} s; {remedy}", fault.at.as_secs())
}

/// Delays the starts of an ordinary drive, `transition`, so that robots start one after the other. Takes the largest of
/// [`DELAY_SHARES`] of the prescribed delay with which the proof accepts the paths and no path has more than
/// [`Path::MOST_PIECES`]. `None` if there is no such share.
pub(crate) fn staggered(
    problem: &TransitionProblem,
    transition: &Transition,
    stagger: Stagger,
    cancel: Cancel<'_>,
) -> Option<Transition> {
    let along = |path: &Path| path.start.dot(stagger.direction);
    let first_m = transition.paths.iter().map(along).fold(f64::INFINITY, f64::min);
    let last_m = transition.paths.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    DELAY_SHARES.into_iter().find_map(|share| {
        let delay = |path: &Path| {
            let place = (along(path) - first_m) / (last_m - first_m).max(1e-9);
            Span::from_millis((stagger.delay_s * share * place * 1e3).round() as i64)
        };
        let delays: Vec<Span> = transition.paths.iter().map(delay).collect();
        let paths = delayed(&transition.paths, &delays);
        let proof = prove_unless(&problem.to_prove(&paths), cancel);
        let duration = Path::longest(&paths);
        let is_short = paths.iter().all(|path| path.pieces.len() <= Path::MOST_PIECES);
        (proof.holds() && is_short).then(|| Transition {
            least: transition.least + (duration - transition.duration),
            duration,
            closest: proof.closest,
            paths,
            ..transition.clone()
        })
    })
}

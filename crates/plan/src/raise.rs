//! Raises the stop-safety of a transition by delays: a robot that follows closely falls back, and one that crosses
//! just behind another crosses later.

mod delays;
#[cfg(test)]
mod tests;

use crate::cancel::{Cancel, Cancelled, unless};
use crate::order::{PlanQuality, choose, percent};
use crate::proof::stop_safe::{STEP, StopAssumptions, StopSafety, measured};
use crate::proof::{Proof, prove_unless};
use crate::{Infeasible, Path, Transition, TransitionProblem, transition_unless};
use lightbots_base::{Piece, Span};

/// Largest share of the planned duration that delays may cost.
const SHARE: f64 = 0.05;

/// Measures the stop-safety of a transition, and raises it for at most 5 % of its duration, unless `problem` asks for
/// a duration. The order on candidate plans decides. The transition stays proven.
pub fn raise(problem: &TransitionProblem, transition: &mut Transition) -> StopSafety {
    raised(problem, transition, Cancel::NEVER)
}

/// [`raise`], cancelled as soon as `is_wanted` says so; the transition stays proven.
pub fn raise_unless(
    problem: &TransitionProblem,
    transition: &mut Transition,
    is_wanted: &dyn Fn() -> bool,
) -> Result<StopSafety, Cancelled> {
    unless(is_wanted, |cancel| raised(problem, transition, cancel))
}

/// The transition of a problem with its stop-safety raised: one link of the chain that plans shows and runs. A plan that
/// is cancelled while it is raised is returned as it was proven.
pub fn planned_unless(
    problem: &TransitionProblem,
    is_wanted: &dyn Fn() -> bool,
) -> Result<Result<Transition, Infeasible>, Cancelled> {
    let mut found = transition_unless(problem, is_wanted)?;
    if let Ok(transition) = &mut found {
        // The transition stays proven also where the planner is cancelled.
        let _ = raise_unless(problem, transition, is_wanted);
    }
    Ok(found)
}

pub(crate) fn raised(
    problem: &TransitionProblem,
    transition: &mut Transition,
    cancel: Cancel<'_>,
) -> StopSafety {
    let measure = |paths: &[Path]| measured(paths, &problem.limits, &StopAssumptions::default(), cancel);
    let before = measure(&transition.paths);
    let is_long = before.pace > STEP;
    if before.unsafe_moments.is_empty() || problem.duration.is_some() || is_long || cancel.is_wanted() {
        return before;
    }
    let most = Span((transition.duration.0 as f64 * SHARE) as i64);
    let delays = delays::delays(&transition.paths, &before, &problem.limits, most, cancel);
    let paths = delayed(&transition.paths, &delays);
    if delays.iter().all(|delay| *delay == Span::ZERO)
        || paths.iter().any(|path| path.pieces.len() > Path::MOST_PIECES)
        || cancel.is_wanted()
    {
        return before;
    }
    let after = measure(&paths);
    let quality = |paths: &[Path]| PlanQuality { contacts: 0, duration: Path::longest(paths) };
    let shares = [before.share(), after.share()];
    let chosen = choose(&[quality(&transition.paths), quality(&paths)], |index| percent(shares[index]));
    if chosen.is_none_or(|chosen| chosen.index == 0) {
        return before;
    }
    let proof = Some(prove_unless(&problem.to_prove(&paths), cancel)).filter(Proof::holds);
    let Some(proof) = proof.filter(|_| !cancel.is_wanted()) else { return before };
    transition.duration = paths.first().map_or(transition.duration, |path| path.as_ref().duration());
    transition.closest = proof.closest;
    transition.paths = paths;
    after
}

/// The paths begun later by these delays; all end together.
fn delayed(paths: &[Path], delays: &[Span]) -> Vec<Path> {
    let driving = paths.iter().zip(delays).filter(|(path, _)| !path.as_ref().rests());
    let latest = driving.map(|(path, delay)| ends(path) + *delay);
    let before = Path::longest(paths);
    let duration = latest.max().unwrap_or(Span::ZERO).max(before);
    let later = |(path, delay): (&Path, &Span)| {
        let mut later = Path { start: path.start, pieces: Vec::with_capacity(path.pieces.len() + 2) };
        add_rest(&mut later, *delay);
        path.pieces.iter().for_each(|piece| add(&mut later, *piece));
        let over = later.as_ref().duration() - duration;
        if over > Span::ZERO {
            shorten(&mut later, over);
        } else {
            add_rest(&mut later, Span(-over.0));
        }
        later
    };
    paths.iter().zip(delays).map(later).collect()
}

/// Moment after which a path rests.
fn ends(path: &Path) -> Span {
    let moving = path.as_ref().timed().filter(|(from, _, piece)| !piece.is_rest(*from));
    moving.map(|(_, begin, piece)| begin + piece.duration).last().unwrap_or(Span::ZERO)
}

fn add(path: &mut Path, piece: Piece) {
    let at = path.as_ref().end();
    if piece.is_rest(at) { add_rest(path, piece.duration) } else { path.pieces.push(piece) }
}

fn add_rest(path: &mut Path, duration: Span) {
    if duration <= Span::ZERO {
        return;
    }
    let at = path.as_ref().end();
    let before = path.pieces.len().checked_sub(2).map_or(path.start, |index| path.pieces[index].end);
    match path.pieces.last_mut() {
        Some(last) if last.is_rest(before) => last.duration += duration,
        _ => path.pieces.push(Piece::rest(at, duration)),
    }
}

/// Shortens the rest at the end of a path.
fn shorten(path: &mut Path, by: Span) {
    if let Some(last) = path.pieces.last_mut() {
        last.duration -= by;
        if last.duration <= Span::ZERO {
            path.pieces.pop();
        }
    }
}

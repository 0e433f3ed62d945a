//! Timed stop-and-go paths. In each step, all robots that move leave and arrive together, after a rest in which they
//! turn. They all have the same progress, so the motion of one relative to another is the straight line that the search
//! has checked.

use lightbots_base::{Piece, Span, Vec2};
use lightbots_show::Easing;

use super::{Profile, quarter_turn};
use crate::instance::Instance;
use crate::{Path, Repaired};

/// Factor on the durations of turns and the lengths of moves, which leaves a small margin to the limits of robots.
const EASE: f64 = 1.002;

/// Turns by at least this angle need the whole [`SETTLING_S`], radians; smaller turns need proportionally less.
const SETTLING_RAD: f64 = 0.2;
/// Additional time of a turn, seconds, because a robot's controller slows down near its new direction. Without this
/// time, a robot would be 7 mm off its line.
const SETTLING_S: f64 = 0.18;

/// The paths through `waypoints[step][robot]`, stage metres. They last `wished` or longer. `None` if a path has more
/// than [`Path::MOST_PIECES`] with either easing.
pub(crate) fn timed_paths(
    instance: &Instance,
    waypoints: &[Vec<Vec2>],
    wished: Option<Span>,
) -> Option<Repaired> {
    // Ramps and a cruise are faster than one cubic, but take more pieces.
    [Easing::Swift, Easing::Gentle].into_iter().find_map(|easing| eased(instance, waypoints, wished, easing))
}

fn eased(
    instance: &Instance,
    waypoints: &[Vec<Vec2>],
    wished: Option<Span>,
    easing: Easing,
) -> Option<Repaired> {
    let steps = timed(instance, waypoints, easing);
    let whole: i64 = steps.iter().map(|step| step.rest.0 + step.drive.duration().0).sum();
    let first = quarter_turn(&instance.limits);
    let wished = wished.map_or(0, |wished| (wished - first).0);
    let slower = (wished as f64 / whole.max(1) as f64).max(1.0);
    let steps: Vec<Step> = steps.iter().map(|step| step.slower(slower)).collect();
    let paths: Vec<Path> =
        (0..instance.robots()).map(|robot| path(robot, waypoints, first, &steps)).collect();
    let is_short = paths.iter().all(|path| path.pieces.len() <= Path::MOST_PIECES);
    is_short.then_some(Repaired { paths, least: first + Span(whole) })
}

/// One step: a rest in which robots turn, then a drive.
struct Step {
    rest: Span,
    drive: Profile,
}

impl Step {
    fn slower(&self, times: f64) -> Self {
        let stretched = |span: Span| Span((span.0 as f64 * times).ceil() as i64);
        Self { rest: stretched(self.rest), drive: self.drive.stretched(stretched(self.drive.duration())) }
    }
}

/// Finds the shortest legal rest and drive of each step.
fn timed(instance: &Instance, waypoints: &[Vec<Vec2>], easing: Easing) -> Vec<Step> {
    let limits = &instance.limits;
    let mut headings: Vec<Option<Vec2>> = vec![None; instance.robots()];
    let mut stood_s = vec![quarter_turn(limits).as_secs(); instance.robots()];
    let one = |pair: &[Vec<Vec2>]| {
        let (mut rest_s, mut longest_m) = (0.0_f64, 0.0_f64);
        for (robot, (from, to)) in pair[0].iter().zip(&pair[1]).enumerate() {
            let Some(line) = (*to - *from).normalized() else { continue };
            let turn = headings[robot].map_or(core::f64::consts::FRAC_PI_2, |before| {
                Vec2::new(before.dot(line).abs(), before.cross(line).abs()).angle()
            });
            let turned_s = turn / limits.turn_radps * EASE + SETTLING_S * (turn / SETTLING_RAD).min(1.0);
            rest_s = rest_s.max(turned_s - stood_s[robot]);
            longest_m = longest_m.max(from.distance(*to));
            headings[robot] = Some(line);
        }
        let rest = Span((rest_s * 1e6).ceil() as i64);
        let drive = Profile::quickest(longest_m * EASE, easing, limits).without_rest();
        let lasts_s = (rest + drive.duration()).as_secs();
        for (robot, (from, to)) in pair[0].iter().zip(&pair[1]).enumerate() {
            stood_s[robot] = if from == to { stood_s[robot] + lasts_s } else { 0.0 };
        }
        Step { rest, drive }
    };
    waypoints.windows(2).map(one).collect()
}

/// Returns a robot's path. It begins with the rest `first` for the first turn.
fn path(robot: usize, waypoints: &[Vec<Vec2>], first: Span, steps: &[Step]) -> Path {
    let start = waypoints[0][robot];
    let mut pieces = Vec::new();
    let mut rested = first;
    for (pair, step) in waypoints.windows(2).zip(steps) {
        let (from, to) = (pair[0][robot], pair[1][robot]);
        rested += step.rest;
        if from == to {
            rested += step.drive.duration();
            continue;
        }
        if rested > Span::ZERO {
            pieces.push(Piece::rest(from, rested));
        }
        pieces.extend(step.drive.path(from, to).pieces);
        rested = Span::ZERO;
    }
    if rested > Span::ZERO {
        pieces.push(Piece::rest(waypoints[waypoints.len() - 1][robot], rested));
    }
    Path { start, pieces }
}

//! Scales problems with robots of other sizes to robots of the Elisa-3's size, for which all distances were measured.

use lightbots_base::{Limits, Piece, Vec2};
use lightbots_show::Obstacle;

use crate::Repaired;
use crate::margins::{MARGIN_M, ROOMY_M};
use crate::{Path, TransitionProblem};

/// A scale that differs from 1 by less than this is not tried.
const ALIKE: f64 = 1e-9;

/// Factor by which lengths of the problem are multiplied, so that its robots get the size of the Elisa-3.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scale(f64);

impl Scale {
    /// Scales to try for robots of these limits, in order; none for robots of the Elisa-3's size. Gaps between rims do
    /// not scale with the robots. In the first scale, robots with a gap of [`ROOMY_M`] or [`MARGIN_M`] in the scaled
    /// problem have at least that gap in the original problem. In the second scale, this holds for [`MARGIN_M`] only.
    pub fn of(limits: &Limits) -> Vec<Self> {
        let usual = Limits::ELISA_3;
        let pairs = |margin_m: f64| (usual.contact_m() + margin_m) / (limits.contact_m() + margin_m);
        let walls = (usual.radius_m + MARGIN_M) / (limits.radius_m + MARGIN_M);
        let least = pairs(MARGIN_M).min(walls);
        let is_scale = |scale: &f64| scale.is_finite() && *scale > 0.0 && (scale - 1.0).abs() >= ALIKE;
        let mut scales: Vec<f64> = [least.min(pairs(ROOMY_M)), least].into_iter().filter(is_scale).collect();
        scales.dedup();
        scales.into_iter().map(Self).collect()
    }

    /// Returns the problem scaled to robots of the Elisa-3's size.
    pub fn problem(self, problem: &TransitionProblem) -> TransitionProblem {
        let places = |places: &[Vec2]| places.iter().map(|&place| place * self.0).collect();
        let radius_m = Limits::ELISA_3.radius_m;
        let inner = (problem.half_floor - Vec2::new(1.0, 1.0) * problem.limits.radius_m) * self.0;
        TransitionProblem {
            starts: places(&problem.starts),
            goals: places(&problem.goals),
            standing: places(&problem.standing),
            obstacles: problem.obstacles.iter().map(|thing| self.obstacle(thing)).collect(),
            half_floor: inner + Vec2::new(1.0, 1.0) * radius_m,
            limits: self.limits(&problem.limits),
            ..problem.clone()
        }
    }

    fn obstacle(self, thing: &Obstacle) -> Obstacle {
        match *thing {
            Obstacle::Disc { at, radius_m } => {
                Obstacle::Disc { at: at * self.0, radius_m: radius_m * self.0 }
            }
            Obstacle::Rect { min, max } => Obstacle::Rect { min: min * self.0, max: max * self.0 },
        }
    }

    fn limits(self, limits: &Limits) -> Limits {
        Limits {
            radius_m: Limits::ELISA_3.radius_m,
            speed_mps: limits.speed_mps * self.0,
            accel_mps2: limits.accel_mps2 * self.0,
            wheel_radius_m: limits.wheel_radius_m * self.0,
            track_m: limits.track_m * self.0,
            ..*limits
        }
    }

    /// Scales the paths of a scaled problem back to `problem`. `goal_of[start]` is the assignment.
    pub fn repaired(
        self,
        problem: &TransitionProblem,
        goal_of: &[Option<usize>],
        found: Repaired,
    ) -> Repaired {
        let ends =
            problem.starts.iter().zip(goal_of).map(|(&start, goal)| (start, goal.map(|g| problem.goals[g])));
        let paths = ends.zip(&found.paths).map(|((start, end), path)| self.path(start, end, path)).collect();
        Repaired { paths, least: found.least }
    }

    /// Scales a path back. The result begins and ends exactly at the given start and end, without rounding errors.
    fn path(self, start: Vec2, end: Option<Vec2>, path: &Path) -> Path {
        let last = path.as_ref().end();
        let place = |at: Vec2| match end {
            _ if at == path.start => start,
            Some(end) if at == last => end,
            _ => at / self.0,
        };
        let pieces = path.pieces.iter().map(|piece| Piece {
            duration: piece.duration,
            c1: place(piece.c1),
            c2: place(piece.c2),
            end: place(piece.end),
        });
        Path { start, pieces: pieces.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::repair;

    /// `count` robots on a ring that drive to the opposite side.
    fn ring(count: usize, radius_m: f64, half: f64, limits: Limits) -> TransitionProblem {
        let place = |i: usize| Vec2::unit(i as f64 / count as f64 * core::f64::consts::TAU) * radius_m;
        TransitionProblem {
            starts: (0..count).map(place).collect(),
            goals: (0..count).map(|i| place(i) * -1.0).collect(),
            ..TransitionProblem::on_floor(Vec2::new(half, half), limits)
        }
    }

    /// Solves the problem with goal i for robot i. Returns its duration as a multiple of that of a single robot on the
    /// longest line.
    fn ratio(problem: &TransitionProblem) -> f64 {
        let goal_of: Vec<Option<usize>> = (0..problem.starts.len()).map(Some).collect();
        let found = repair(problem, &goal_of).expect("a way");
        let proof = crate::proof::prove(&problem.to_prove(&found.paths));
        assert!(proof.holds(), "{:?} {:?}", proof.conflicts, proof.faults);
        assert!(proof.closest.unwrap().distance_m - problem.limits.contact_m() > 0.007);
        let Limits { speed_mps, accel_mps2, turn_radps, .. } = problem.limits;
        let far_m =
            problem.starts.iter().zip(&problem.goals).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        let alone_s = far_m / speed_mps + core::f64::consts::FRAC_PI_2 / turn_radps + speed_mps / accel_mps2;
        found.least.as_secs() / alone_s
    }

    #[test]
    fn the_usual_robots_have_no_scale() {
        assert!(Scale::of(&Limits::ELISA_3).is_empty());
        assert!(Scale::of(&Limits { speed_mps: 0.1, ..Limits::ELISA_3 }).is_empty());
    }

    #[test]
    fn robots_of_any_size_and_speed_cross_a_ring() {
        let usual = Limits::ELISA_3;
        let large = Limits {
            radius_m: 0.1,
            speed_mps: 0.5,
            accel_mps2: 0.5,
            turn_radps: 2.0,
            wheel_radps: 40.0,
            wheel_radius_m: 0.03,
            track_m: 0.15,
        };
        let small = Limits {
            radius_m: 0.01,
            speed_mps: 0.1,
            accel_mps2: 0.3,
            turn_radps: 3.0,
            wheel_radps: 40.0,
            wheel_radius_m: 0.003,
            track_m: 0.015,
        };
        for (ring_m, half, limits) in [
            (1.5, 3.0, large),
            (0.2, 0.5, small),
            (1.0, 1.5, Limits { turn_radps: 1.0, ..usual }),
            (1.0, 1.5, Limits { accel_mps2: 0.1, ..usual }),
            (1.0, 1.5, Limits { speed_mps: 0.1, ..usual }),
        ] {
            let ratio = ratio(&ring(12, ring_m, half, limits));
            assert!(ratio < 1.2, "{limits:?}: {ratio}");
        }
    }
}

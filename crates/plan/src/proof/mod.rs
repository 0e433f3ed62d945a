//! The proof: whether timed paths keep everybody apart and legal, at every moment of continuous time.
//!
//! **Invariant:** it shares nothing with the planner but the type of a path. It trusts no assignment, no profile and
//! no repair: only the pieces count.

mod curve;
mod timeline;

use crate::{Closest, Path};
use lightbots_base::{Limits, Span, Vec2};
use lightbots_show::Obstacle;
use timeline::Stretch;

/// What is to be judged.
#[derive(Clone, Copy, Debug)]
pub struct ProofInput<'a> {
    /// The path of each robot.
    pub paths: &'a [Path],
    /// Discs of a robot's size that do not move, stage metres.
    pub standing: &'a [Vec2],
    /// Things on the floor.
    pub obstacles: &'a [Obstacle],
    /// Half the floor's width and depth, metres.
    pub half_floor: Vec2,
    /// What the robots can do.
    pub limits: &'a Limits,
    /// The least distance wanted between two centres, metres. A pair that begins or ends closer than that must only
    /// keep the smaller of those two distances.
    pub gap_m: f64,
}

/// The verdict.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Proof {
    /// Pairs that come closer than wanted, by their indices (robots, then standing discs counted on), each at its
    /// closest.
    pub conflicts: Vec<Closest>,
    /// The closest pair of all; `None` with fewer than two discs.
    pub closest: Option<Closest>,
}

impl Proof {
    /// Whether the paths may be driven.
    pub fn holds(&self) -> bool {
        self.conflicts.is_empty()
    }
}

/// Distances may fall short by this, metres: what rounding costs.
const SLACK_M: f64 = 1e-6;

/// Judges paths.
pub fn prove(input: &ProofInput<'_>) -> Proof {
    let horizon_us = input.paths.iter().map(|path| path.as_ref().duration().0).max().unwrap_or(0);
    let mut lists: Vec<Vec<Stretch>> = Vec::new();
    for path in input.paths {
        let mut list = Vec::new();
        timeline::stretches(path, horizon_us, &mut list);
        lists.push(list);
    }
    for &at in input.standing {
        lists.push(vec![Stretch { begin_us: 0, end_us: horizon_us.max(1), curve: [at; 4] }]);
    }
    let mut proof = Proof::default();
    for i in 0..input.paths.len() {
        for j in i + 1..lists.len() {
            let best = proof.closest.map_or(f64::INFINITY, |closest| closest.distance_m);
            let enough = best.max(input.gap_m);
            let Some((distance_m, at_us, place)) =
                timeline::closest(&lists[i], &lists[j], 0, horizon_us.max(1), enough)
            else {
                continue;
            };
            let found = Closest { distance_m, at: Span(at_us), pair: (i, j), place };
            let ends = |list: &[Stretch]| (list[0].curve[0], list[list.len() - 1].curve[3]);
            let ((a0, a1), (b0, b1)) = (ends(&lists[i]), ends(&lists[j]));
            let need = input.gap_m.min(a0.distance(b0)).min(a1.distance(b1)) - SLACK_M;
            if distance_m < need {
                proof.conflicts.push(found);
            }
            if distance_m < best {
                proof.closest = Some(found);
            }
        }
    }
    proof
}

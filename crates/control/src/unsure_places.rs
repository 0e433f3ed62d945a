//! Adds discs around inferred places, so that plans keep away from them by as much as these places may be wrong. A
//! place is inferred if no robot reported it as its own.

use lightbots_base::Vec2;
use lightbots_plan::TransitionProblem;

/// Assumed error of an inferred place, metres. Measured: 5 mm if other robots see a failed robot. With less, robots
/// that pass an obstacle at 6 mm by plan touch it. With more, there is no plan through gaps that are wide enough.
pub(crate) const OFF_M: f64 = 0.008;
/// Number of discs on a circle around an inferred place. Together they cover the disc at the place, grown by at least
/// 6.8 mm.
const RING: u32 = 6;
/// Discs whose centres are closer than this count as one, metres. The possible places of a silent robot are 10 mm
/// apart.
const SAME_M: f64 = 0.004;
/// Least clearance between a standing disc and a robot at the start or end of its drive, metres. With less there is no
/// plan.
pub(crate) const REST_CLEARANCE_M: f64 = 0.001;
/// Largest number of inferred places for which discs are added. It bounds the time: each of up to six discs for a place
/// is compared with all starts and goals, and planned around.
const PLACES_MAX: usize = 256;

/// Returns the problem with added standing discs around the inferred places, stage metres. A disc with less clearance
/// than [`REST_CLEARANCE_M`] to a robot's start or goal is left out. Robots that stopped at an obstacle must be able to
/// leave. `None` if there is no disc to add, or more than [`PLACES_MAX`] places.
pub(crate) fn kept_away_from(problem: &TransitionProblem, inferred: &[Vec2]) -> Option<TransitionProblem> {
    if inferred.len() > PLACES_MAX {
        return None;
    }
    let contact_m = problem.limits.contact_m();
    let is_free = |at: Vec2| {
        !problem
            .starts
            .iter()
            .chain(&problem.goals)
            .any(|robot| robot.distance(at) < contact_m + REST_CLEARANCE_M)
    };
    let mut discs: Vec<Vec2> = Vec::new();
    for at in inferred.iter().flat_map(|&place| ring(place)) {
        if is_free(at) && !discs.iter().any(|disc| disc.distance(at) < SAME_M) {
            discs.push(at);
        }
    }
    (!discs.is_empty()).then(|| {
        let standing = problem.standing.iter().copied().chain(discs).collect();
        TransitionProblem { standing, ..problem.clone() }
    })
}

fn ring(place: Vec2) -> impl Iterator<Item = Vec2> {
    let angle = |number| core::f64::consts::TAU / f64::from(RING) * f64::from(number);
    (0..RING).map(move |number| place + Vec2::unit(angle(number)) * OFF_M)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_show::Stage;

    fn problem(start: Vec2) -> TransitionProblem {
        let far = Vec2::new(1.0, 1.0);
        TransitionProblem {
            starts: vec![start],
            goals: vec![far],
            ..TransitionProblem::on_stage(&Stage::default())
        }
    }

    #[test]
    fn whatever_stands_within_the_error_of_its_place_is_kept_clear() {
        let wide = kept_away_from(&problem(Vec2::new(-1.0, 0.0)), &[Vec2::ZERO]).expect("there are discs");
        let contact_m = wide.limits.contact_m();
        for degrees in 0..360 {
            let from_m = contact_m + 0.0065;
            let at = Vec2::unit(f64::from(degrees).to_radians()) * from_m;
            assert!(wide.standing.iter().any(|disc| disc.distance(at) < contact_m), "{degrees}");
        }
        assert!(wide.standing.iter().all(|disc| disc.length() < OFF_M + 1e-9));
    }

    #[test]
    fn a_robot_beside_an_obstacle_can_start() {
        let contact_m = problem(Vec2::ZERO).limits.contact_m();
        let start = Vec2::new(contact_m + 0.003, 0.0);
        let wide = kept_away_from(&problem(start), &[Vec2::ZERO]).expect("the far side has discs");
        assert!(wide.standing.iter().all(|disc| disc.distance(start) >= contact_m));
        assert!((2..6).contains(&wide.standing.len()), "{:?}", wide.standing);
    }

    #[test]
    fn without_inferred_places_nothing_changes() {
        assert!(kept_away_from(&problem(Vec2::ZERO), &[]).is_none());
    }
}

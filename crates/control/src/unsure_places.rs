//! Discs around inferred places, so that plans keep away from places that may be off.

use lightbots_base::Vec2;
use lightbots_plan::TransitionProblem;

/// How far a place may be off that other robots have seen or that was calculated, metres. Measured: 5 mm where others
/// measure a failed robot. Below, robots pass what they see at 6 mm by plan and touch it. Above, there is no plan
/// through gaps that are wide enough.
pub(crate) const OFF_M: f64 = 0.008;
/// Number of discs on a circle around an inferred place: together they cover the disc grown by 6.8 mm at the least.
const RING: u32 = 6;
/// Discs that are closer together than this count as one, metres: places of a silent robot are 10 mm apart.
const SAME_M: f64 = 0.004;
/// Least clearance between a disc that does not move and where a robot starts or ends, metres. With less there is no
/// plan.
pub(crate) const REST_CLEARANCE_M: f64 = 0.001;
/// Largest number of inferred places for which discs are added: each of up to six discs for a place is compared with all
/// starts and goals, and planned around.
const PLACES_MAX: usize = 256;

/// The problem with the discs around inferred places as well. A disc in which a robot starts or ends is left out, because
/// robots that stopped at an obstacle have to get away from it. `None` without any such disc, and with more than
/// [`PLACES_MAX`] places.
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

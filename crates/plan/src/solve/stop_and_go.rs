//! The last resort: stop-and-go over a roadmap. The search checks exact distances between moving robots, so its result
//! needs no deformation. It is complete on the nodes of the roadmap, except that its work is bounded.

use lightbots_base::{Span, Vec2};

use crate::Repaired;
use crate::instance::Instance;
use crate::mapf::lacam::search;
use crate::mapf::roadmap_rule::roadmap_pibt;
use crate::mapf::shortening::shorten;
use crate::motion::stop_and_go::timed_paths;
use crate::roads::graph::NONE;
use crate::roads::roadmap::Roadmap;
use crate::roads::visibility::VisibilityGraph;

/// Most checks of two robots' moves, of all stop-and-go rows together: some seconds for a fleet without a solution.
pub(super) const MOST_LOOKS: usize = 120_000_000;

/// Finds stop-and-go trajectories over a roadmap, which is given by its pitch and the distance of its nodes from the
/// floor's edge, metres. They last `asked` or longer. Returns `None` if there are none. Subtracts from `looks` the
/// number of checks of two robots' moves.
pub(super) fn stop_and_go(
    instance: &Instance,
    visibility: &VisibilityGraph,
    (pitch_m, off_edge_m): (f64, f64),
    asked: Option<Span>,
    looks: &mut usize,
) -> Option<Repaired> {
    let roads = Roadmap::new(instance, visibility, pitch_m, off_edge_m.min(instance.off_edge_m))?;
    let goals: Vec<u32> = roads.ends.iter().map(|end| end.unwrap_or(NONE)).collect();
    let mut pibt = roadmap_pibt(instance, &roads, *looks);
    let steps = search(&mut pibt, &roads.starts, &goals);
    *looks = pibt.looks_left();
    let steps = shorten(&pibt.rule, &roads, steps?);
    let place = |node: &u32| roads.places[*node as usize];
    let waypoints: Vec<Vec<Vec2>> = steps.iter().map(|step| step.iter().map(place).collect()).collect();
    timed_paths(instance, &waypoints, asked)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TransitionProblem;
    use crate::margins::EDGE_M;
    use crate::motion::quarter_turn;
    use crate::proof::prove;
    use crate::seeded::Seeded;
    use lightbots_base::Limits;

    /// `side` × `side` robots on a square grid. Their goals are the same places in random order. The floor is 1.5 times
    /// as wide as the grid.
    fn shuffled(side: usize, apart_m: f64) -> TransitionProblem {
        let at = |i: usize| (i as f64 - (side as f64 - 1.0) / 2.0) * apart_m;
        let starts: Vec<Vec2> = (0..side * side).map(|i| Vec2::new(at(i % side), at(i / side))).collect();
        let (mut goals, mut seeded) = (starts.clone(), Seeded::new(3));
        (1..goals.len()).rev().for_each(|last| goals.swap(last, seeded.below(last + 1)));
        let half = side as f64 * apart_m * 0.75;
        TransitionProblem {
            starts,
            goals,
            ..TransitionProblem::on_floor(Vec2::new(half, half), Limits::ELISA_3)
        }
    }

    /// The first pitch that leads to trajectories.
    fn any_pitch(instance: &Instance, asked: Option<Span>) -> Option<Repaired> {
        let (visibility, mut looks) = (VisibilityGraph::new(instance), MOST_LOOKS);
        [(0.072, EDGE_M), (0.05, EDGE_M), (0.036, 0.0)]
            .into_iter()
            .find_map(|roadmap| stop_and_go(instance, &visibility, roadmap, asked, &mut looks))
    }

    fn scene_of(problem: &TransitionProblem) -> Instance<'static> {
        Instance::new(problem, &(0..problem.starts.len()).map(Some).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn a_crowd_is_sorted_from_stop_to_stop_alone() {
        for (side, apart_m) in [(3, 0.08), (5, 0.1), (6, 0.09)] {
            let problem = shuffled(side, apart_m);
            let instance = scene_of(&problem);
            let found = any_pitch(&instance, None).expect("a way");
            let proof = prove(&problem.to_prove(&found.paths));
            assert!(proof.holds(), "{side}: {:?} {:?}", proof.conflicts, proof.faults);
            for (path, goal) in found.paths.iter().zip(&problem.goals) {
                assert_eq!((path.as_ref().end(), path.as_ref().duration()), (*goal, found.least));
            }
        }
    }

    #[test]
    fn stops_are_as_slow_as_is_wished_for() {
        let problem = shuffled(2, 0.1);
        let instance = scene_of(&problem);
        let quick = any_pitch(&instance, None).unwrap();
        assert_eq!(any_pitch(&instance, Some(quick.least)).unwrap(), quick);
        let slow = any_pitch(&instance, Some(quick.least + quick.least)).unwrap();
        let late = slow.paths[0].as_ref().duration() - quick.least - quick.least;
        assert!(late >= Span::ZERO && late < quarter_turn(&instance.limits) / 100, "{late:?}");
        assert!(slow.least == quick.least && prove(&problem.to_prove(&slow.paths)).holds());
    }

    #[test]
    fn what_there_is_no_room_for_is_not_found() {
        // Two robots in a corridor one robot wide.
        let (a, b) = (Vec2::new(-0.2, 0.0), Vec2::new(0.2, 0.0));
        let floor = TransitionProblem::on_floor(Vec2::new(0.3, 0.05), Limits::ELISA_3);
        let instance = scene_of(&TransitionProblem { starts: vec![a, b], goals: vec![b, a], ..floor });
        assert_eq!(any_pitch(&instance, None), None);
    }
}

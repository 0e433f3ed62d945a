//! First guess from a multi-agent path finding over a lattice, in which no two robots meet.

use lightbots_base::Vec2;

use crate::instance::Instance;
use crate::mapf::lacam::search;
use crate::mapf::lattice_rule::lattice_pibt;
use crate::mapf::node_assignment::assign_nodes;
use crate::roads::graph::NONE;
use crate::roads::lattice::Lattice;
use crate::spline::set::{MOST_SPANS, SplineSet};

/// Makes splines from a multi-agent path finding over the lattice. Their speed is the speed limit or, if that is less,
/// about the greatest at which the corners of lattice paths are legal. `None` if starts or ends cannot be assigned to
/// different nodes, or the lattice is too large for the search. `None` also if the search finds no solution or is
/// cancelled.
pub(crate) fn from_lattice(instance: &Instance, lattice: &Lattice) -> Option<SplineSet> {
    let starts = assign_nodes(instance, lattice, &instance.starts)?;
    let bound: Vec<usize> = (0..instance.robots()).filter(|&robot| instance.ends[robot].is_some()).collect();
    let ends: Vec<Vec2> = bound.iter().filter_map(|&robot| instance.ends[robot]).collect();
    let assigned = assign_nodes(instance, lattice, &ends)?;
    let mut goals = vec![NONE; instance.robots()];
    for (&robot, &node) in bound.iter().zip(&assigned) {
        goals[robot] = node;
    }
    let steps = search(&mut lattice_pibt(lattice, &goals, instance.cancel)?, &starts, &goals)?;
    let pitch = lattice.pitch_m;
    let legs = |robot: usize, node: u32, place: Vec2| (robot, lattice.places[node as usize].distance(place));
    let farthest =
        |legs: &mut dyn Iterator<Item = (usize, f64)>| legs.fold(0.0_f64, |far, leg| far.max(leg.1));
    let before =
        farthest(&mut (0..instance.robots()).map(|robot| legs(robot, starts[robot], instance.starts[robot])));
    let after = farthest(&mut bound.iter().zip(&ends).map(|(&robot, &end)| legs(robot, goals[robot], end)));
    let (before, after) = ((before / pitch).ceil() as usize, (after / pitch).ceil() as usize);
    let middle = steps.len() - 1;
    let whole = before + middle + after;
    let place = |robot: usize, moment: f64| {
        let at = |step: usize| lattice.places[steps[step][robot] as usize];
        let start = instance.starts[robot];
        let end = instance.ends[robot].unwrap_or(at(middle));
        let share = |from: usize, length: usize| (moment - from as f64) / length as f64;
        if moment < before as f64 {
            start.lerp(at(0), share(0, before))
        } else if moment < (before + middle) as f64 {
            let step = moment as usize - before;
            at(step).lerp(at(step + 1), moment.fract())
        } else if moment < whole as f64 {
            at(middle).lerp(end, share(before + middle, after))
        } else {
            end
        }
    };
    let spans = whole.clamp(4, MOST_SPANS);
    let step_s = (pitch / instance.limits.speed_mps).max((pitch / instance.limits.accel_mps2).sqrt());
    let span_s = step_s * whole.max(1) as f64 / spans as f64;
    Some(SplineSet::new(instance, spans, span_s, |robot, step| {
        place(robot, step as f64 * whole as f64 / spans as f64)
    }))
}

//! A first guess for crowds: over the lattice, where nobody meets anybody.

use lightbots_base::Vec2;

use crate::instance::Scene;
use crate::mapf::lacam::search;
use crate::mapf::lattice_pibt::Stepper;
use crate::mapf::node_assignment::dock;
use crate::roads::lattice::{Lattice, NONE};
use crate::spline::set::{MOST_SPANS, Weave};

/// A weave of steps over the lattice, at a pace in which its corners are about legal; `None` where no order was found.
pub(crate) fn ordered(scene: &Scene, lattice: &Lattice) -> Option<Weave> {
    let starts = dock(scene, lattice, &scene.starts)?;
    let bound: Vec<usize> = (0..scene.robots()).filter(|&robot| scene.ends[robot].is_some()).collect();
    let ends: Vec<Vec2> = bound.iter().filter_map(|&robot| scene.ends[robot]).collect();
    let docks = dock(scene, lattice, &ends)?;
    let mut goals = vec![NONE; scene.robots()];
    for (&robot, &node) in bound.iter().zip(&docks) {
        goals[robot] = node;
    }
    let steps = search(&mut Stepper::new(lattice, &goals, scene.cancel)?, &starts, &goals)?;
    let pitch = lattice.pitch_m;
    let legs = |robot: usize, node: u32, place: Vec2| (robot, lattice.places[node as usize].distance(place));
    let farthest =
        |legs: &mut dyn Iterator<Item = (usize, f64)>| legs.fold(0.0_f64, |far, leg| far.max(leg.1));
    let before =
        farthest(&mut (0..scene.robots()).map(|robot| legs(robot, starts[robot], scene.starts[robot])));
    let after = farthest(&mut bound.iter().zip(&ends).map(|(&robot, &end)| legs(robot, goals[robot], end)));
    let (before, after) = ((before / pitch).ceil() as usize, (after / pitch).ceil() as usize);
    let middle = steps.len() - 1;
    let whole = before + middle + after;
    let place = |robot: usize, moment: f64| {
        let at = |step: usize| lattice.places[steps[step][robot] as usize];
        let start = scene.starts[robot];
        let end = scene.ends[robot].unwrap_or(at(middle));
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
    let step_s = (pitch / scene.limits.speed_mps).max((pitch / scene.limits.accel_mps2).sqrt());
    let span_s = step_s * whole.max(1) as f64 / spans as f64;
    Some(Weave::new(scene, spans, span_s, |robot, step| {
        place(robot, step as f64 * whole as f64 / spans as f64)
    }))
}

//! Drives through intermediate pictures, in which robots do not stop.

use std::collections::BTreeMap;

use lightbots_base::Vec2;

use super::picture::PlacesById;
use super::shape::{Shape, ShapeCurve};
use super::way::{PrescribedWay, WayPart};
use crate::assignment::Choice;

/// Returns the way to each pixel of the picture `after`, by pixel id. `through`: places of the intermediate pictures,
/// in order. `None` if two pictures have different numbers of places.
pub(super) fn ways(
    through: &[Vec<Vec2>],
    before: &PlacesById,
    after: &PlacesById,
) -> Option<BTreeMap<u32, PrescribedWay>> {
    let starts: Vec<Vec2> = before.values().copied().collect();
    let goals: Vec<Vec2> = after.values().copied().collect();
    let mut lines: Vec<Vec<Vec2>> = starts.iter().map(|&at| vec![at]).collect();
    // Sum of the longest lines up to each picture, metres. All robots reach a picture together, at the share of their
    // ways that this sum has in the sum of all longest lines.
    let mut longest_m = vec![0.0];
    for picture in through.iter().map(Vec::as_slice).chain([&goals[..]]) {
        let here: Vec<Vec2> = lines.iter().map(|line| line[line.len() - 1]).collect();
        if picture.len() != here.len() {
            return None;
        }
        let start_of = Choice::new(&here, picture, &[])?.least_squares().solve(0.0)?;
        let mut sorted = Vec::with_capacity(lines.len());
        for (&start, &at) in start_of.iter().zip(picture) {
            let mut line = std::mem::take(&mut lines[start]);
            line.push(at);
            sorted.push(line);
        }
        // The lines are in the order of the picture just reached. In the end they are in the order of the pixels.
        lines = sorted;
        let steps = lines.iter().map(|line| line[line.len() - 2].distance(line[line.len() - 1]));
        longest_m.push(longest_m[longest_m.len() - 1] + steps.fold(1e-3, f64::max));
    }
    let all_m = longest_m[longest_m.len() - 1];
    let shares: Vec<f64> = longest_m.iter().map(|at_m| at_m / all_m).collect();
    let way = |line: &Vec<Vec2>| {
        let kind = ShapeCurve::Through { places: line.clone().into(), shares: shares.clone().into() };
        PrescribedWay::Parts(vec![WayPart { during: (0.0, 1.0), shape: Shape::from(kind) }])
    };
    Some(after.keys().copied().zip(lines.iter().map(way)).collect())
}

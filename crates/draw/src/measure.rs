//! Measures how well places cover a drawing. The figures can be compared between methods of placing.

use lightbots_base::Vec2;

use crate::buckets::{Buckets, nearest_distances};
use crate::drawing::DrawingPart;
use crate::ground::{Ground, Quality};
use crate::pins::{self, CORNER_RAD};

/// Figures of places on a part. Distances are divided by an ideal spacing. For areas, that is the spacing of a
/// hexagonal grid with this number of places. For lines, it is the length of the lines divided by the number of places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Standard deviation of the places' distances to their nearest neighbours, divided by the mean of these distances.
    pub variation: f64,
    /// Distance of the closest pair of places; infinite for a single place. It sets the size of the picture on the
    /// floor.
    pub closest: f64,
    /// Largest distance of a point of the drawing from its nearest place.
    pub farthest_point: f64,
    /// Largest distance of a place from the drawing.
    pub farthest_place: f64,
    /// Share of the drawing that is within half a spacing of a place.
    pub covered: f64,
    /// Share of the corners (turns over 35°) that have a place within a quarter of a spacing; 1 if there are no
    /// corners.
    pub corners: f64,
}

/// Returns the figures of places on a part. `None` if there are no places or nothing is drawn.
pub fn figures(part: &DrawingPart, places: &[Vec2]) -> Option<Figures> {
    let ground = Ground::new(part, places.len(), Quality::Full, &|_| true);
    let (drawn, spacing): (Vec<(Vec2, f64)>, f64) = if ground.samples.is_empty() {
        let points = ground.lines.points().iter().map(|at| (*at, 1.0)).collect();
        (points, ground.lines.length() / places.len().max(1) as f64)
    } else {
        (ground.samples.iter().map(|s| (s.at, s.mass)).collect(), ground.spacing(places.len()))
    };
    if places.is_empty() || drawn.is_empty() {
        return None;
    }
    let nearest = nearest_distances(places, spacing);
    let mean = nearest.iter().sum::<f64>() / nearest.len() as f64;
    let variance = nearest.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / nearest.len() as f64;
    let to_places = Buckets::new(places, spacing);
    let distance =
        |buckets: &Buckets<'_>, at: Vec2| buckets.nearest(at).map_or(0.0, |(_, square)| square.sqrt());
    let gaps: Vec<(f64, f64)> = drawn.iter().map(|(at, mass)| (distance(&to_places, *at), *mass)).collect();
    let points: Vec<Vec2> = drawn.iter().map(|(at, _)| *at).collect();
    let to_drawing = Buckets::new(&points, ground.pitch.max(0.05 * spacing));
    let mass: f64 = gaps.iter().map(|(_, mass)| mass).sum();
    let near: f64 = gaps.iter().filter(|(gap, _)| *gap <= spacing / 2.0).map(|(_, mass)| mass).sum();
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max) / spacing;
    Some(Figures {
        variation: if mean.is_finite() && mean > 0.0 { variance.sqrt() / mean } else { 0.0 },
        closest: nearest.iter().copied().fold(f64::INFINITY, f64::min) / spacing,
        farthest_point: greatest(&mut gaps.iter().map(|(gap, _)| *gap)),
        farthest_place: greatest(&mut places.iter().map(|at| distance(&to_drawing, *at))),
        covered: near / mass,
        corners: corners(&ground, &to_places, spacing),
    })
}

fn corners(ground: &Ground, places: &Buckets<'_>, spacing: f64) -> f64 {
    let track = if ground.samples.is_empty() { &ground.lines } else { &ground.outline };
    let least = CORNER_RAD / core::f64::consts::PI;
    let pins = pins::find(track, ground.size);
    let corners: Vec<Vec2> =
        pins.iter().filter(|pin| pin.rank < 1.0 && pin.rank > 0.9 * least).map(|p| p.at).collect();
    if corners.is_empty() {
        return 1.0;
    }
    let near = |at: &&Vec2| places.nearest(**at).is_some_and(|(_, square)| square.sqrt() <= spacing / 4.0);
    corners.iter().filter(near).count() as f64 / corners.len() as f64
}

//! Shapes whose places depend on the number of robots: grids and random places.

use lightbots_base::Vec2;

use super::kinds::{ShapeKind, ShapeSettings};
use crate::coverage::Sample;
use crate::seeds::seeds;

/// Number of samples along each side of the field from which random places are drawn.
const FIELD: usize = 160;

/// Returns `count` places of a grid, or random places, about one unit apart from their neighbours. `None` for other
/// kinds of shapes.
pub fn exact_places(settings: &ShapeSettings, count: usize, seed: u64) -> Option<Vec<Vec2>> {
    match settings.kind {
        ShapeKind::Grid => Some(rows(count, settings.aspect, 1.0, 0.0)),
        ShapeKind::Hexagons => Some(rows(count, settings.aspect, 3.0_f64.sqrt() / 2.0, 0.5)),
        ShapeKind::Random => Some(random(count, settings.aspect, seed)),
        _ => None,
    }
}

/// Returns `count` places in rows of equal length, from the top downwards, whose width over height is about `aspect`.
/// `height`: distance between rows. Every second row is shifted to the right by `shift`. The last row may be shorter;
/// it is centred.
fn rows(count: usize, aspect: f64, height: f64, shift: f64) -> Vec<Vec2> {
    let columns = ((count as f64 * aspect * height).sqrt().round() as usize).clamp(1, count.max(1));
    let rows = count.div_ceil(columns);
    let place = |index: usize| {
        let (row, column) = (index / columns, index % columns);
        let here = if row + 1 == rows { count - row * columns } else { columns };
        // A centred last row of a hexagonal grid fits between its neighbours only if it moves by whole steps.
        let missing = (columns - here) as f64 / 2.0;
        let centred = if shift > 0.0 { missing.floor() } else { missing };
        let offset = if row % 2 == 1 { shift } else { 0.0 };
        Vec2::new(column as f64 + centred + offset, -(row as f64) * height)
    };
    (0..count).map(place).collect()
}

fn random(count: usize, aspect: f64, seed: u64) -> Vec<Vec2> {
    let size = Vec2::new((count as f64 * aspect).sqrt(), (count as f64 / aspect).sqrt());
    let samples: Vec<Sample> = (0..FIELD * FIELD)
        .map(|index| {
            let share = |part: usize| (part as f64 + 0.5) / FIELD as f64;
            let at = Vec2::new(size.x * share(index % FIELD), size.y * share(index / FIELD));
            Sample { at, mass: 1.0 }
        })
        .collect();
    seeds(&samples, &[], count, 1.0, seed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buckets::nearest_distances;

    #[test]
    fn neighbours_of_grids_are_one_unit_apart() {
        for kind in [ShapeKind::Grid, ShapeKind::Hexagons] {
            for count in [2, 7, 30, 100] {
                let places = exact_places(&ShapeSettings::new(kind), count, 1).unwrap();
                let closest = nearest_distances(&places, 1.0).into_iter().fold(f64::MAX, f64::min);
                assert!((closest - 1.0).abs() < 1e-9, "{kind:?} {count}: {closest}");
            }
        }
    }

    #[test]
    fn chance_keeps_places_apart_and_follows_its_seed() {
        let settings = ShapeSettings::new(ShapeKind::Random);
        let places = exact_places(&settings, 80, 3).unwrap();
        assert!(nearest_distances(&places, 1.0).into_iter().fold(f64::MAX, f64::min) > 0.55);
        assert_eq!(Some(places.clone()), exact_places(&settings, 80, 3));
        assert_ne!(Some(places), exact_places(&settings, 80, 4));
    }
}

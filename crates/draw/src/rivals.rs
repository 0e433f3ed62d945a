//! Simple methods of placing robots, for comparison with the method of this crate: random, on a grid, farthest point.

use lightbots_base::Vec2;

use crate::buckets::Buckets;
use crate::drawing::DrawingPart;
use crate::geometry::bounds;
use crate::ground::{Ground, Quality};
use crate::seeds::unit;

/// Number of offsets of the grid that are tried along each axis.
const OFFSETS: usize = 4;

/// Number of bisection steps in the search for the grid's pitch.
const HALVINGS: usize = 30;

/// Returns the name of each method, and the `count` places on a part that it finds. For a part of lines alone there is
/// no grid. Empty if the part draws nothing.
pub fn rivals(part: &DrawingPart, count: usize, seed: u64) -> Vec<(&'static str, Vec<Vec2>)> {
    let ground = Ground::new(part, count, Quality::Full, &|_| true);
    let mut state = seed;
    if ground.samples.is_empty() {
        let points = ground.lines.points();
        return if points.is_empty() {
            Vec::new()
        } else {
            vec![
                ("random", random(points, count, &mut state)),
                ("farthest point", farthest(points, count, &mut state)),
            ]
        };
    }
    vec![
        ("random", random(&ground.inside, count, &mut state)),
        ("grid", grid(&ground, count)),
        ("farthest point", farthest(&ground.inside, count, &mut state)),
    ]
}

fn pick(points: &[Vec2], state: &mut u64) -> Vec2 {
    points[((unit(state) * points.len() as f64) as usize).min(points.len() - 1)]
}

/// Picks each place at random from `points`, independent of the others.
fn random(points: &[Vec2], count: usize, state: &mut u64) -> Vec<Vec2> {
    (0..count).map(|_| pick(points, state)).collect()
}

/// Picks each next place from `points` as far as possible from all places picked before (Gonzalez, Clustering to
/// Minimize the Maximum Intercluster Distance, 1985).
fn farthest(points: &[Vec2], count: usize, state: &mut u64) -> Vec<Vec2> {
    let mut places = vec![pick(points, state)];
    let mut gaps = vec![f64::INFINITY; points.len()];
    while places.len() < count {
        let last = places[places.len() - 1];
        let mut best = 0;
        for (index, at) in points.iter().enumerate() {
            gaps[index] = gaps[index].min((*at - last).length_squared());
            if gaps[index] > gaps[best] {
                best = index;
            }
        }
        places.push(points[best]);
    }
    places
}

/// Returns `count` nodes of a square grid: the grid with the largest pitch that has at least `count` nodes inside, at
/// the best offset tried. Surplus nodes at the end of the list are left out.
fn grid(ground: &Ground, count: usize) -> Vec<Vec2> {
    let inside = Buckets::new(&ground.inside, ground.pitch);
    let (low, high) = bounds(&ground.inside).unwrap_or_default();
    let nodes = |pitch: f64| {
        let offsets =
            (0..OFFSETS * OFFSETS).map(|index| Vec2::new((index % OFFSETS) as f64, (index / OFFSETS) as f64));
        let each = offsets.map(|offset| {
            let first = low + offset * (pitch / OFFSETS as f64);
            let steps = |length: f64| (length.max(0.0) / pitch) as usize;
            let (columns, rows) = (steps(high.x - first.x), steps(high.y - first.y));
            let all = (0..=rows).flat_map(|row| (0..=columns).map(move |column| (column, row)));
            let at = all.map(|(column, row)| first + Vec2::new(column as f64, row as f64) * pitch);
            at.filter(|at| inside.nearest(*at).is_some_and(|(_, square)| square.sqrt() <= ground.pitch))
                .collect()
        });
        each.max_by_key(Vec::len).unwrap_or_default()
    };
    let (mut fits, mut too_wide) = (0.2 * ground.spacing(count), 2.0 * ground.spacing(count));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (fits + too_wide);
        if nodes(middle).len() >= count { fits = middle } else { too_wide = middle }
    }
    let mut places: Vec<Vec2> = nodes(fits);
    places.truncate(count);
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Area, FillRule};
    use crate::measure::figures;
    use lightbots_base::Rgb;

    #[test]
    fn each_way_gives_as_many_places_inside_and_looks_as_published() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Vec2::new(x, y)).to_vec();
        let area = Area { rings: vec![square], rule: FillRule::NonZero, ink: Rgb::BLACK.into(), weight: 1.0 };
        let part = DrawingPart { areas: vec![area], ..DrawingPart::default() };
        for (name, places) in rivals(&part, 100, 1) {
            assert_eq!(places.len(), 100, "{name}");
            let figures = figures(&part, &places).unwrap();
            let (least, most) = match name {
                "random" => (0.4, 0.7),
                "grid" => (0.0, 0.02),
                _ => (0.02, 0.2),
            };
            assert!((least..most).contains(&figures.variation), "{name}: {figures:?}");
            assert!(figures.farthest_place < 0.1, "{name}: {figures:?}");
        }
    }
}

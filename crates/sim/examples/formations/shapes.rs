//! Formations: places of robots around the origin, whose nearest two are one spacing apart.

use std::f64::consts::PI;

use lightbots_base::Vec2;

/// The shape of a formation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Square lattice, about as wide as deep.
    Grid,
    /// Triangular lattice with six neighbours per robot, cut to a disc.
    Hexagon,
    /// Sunflower: Vogel's spiral, in which distances to neighbours vary.
    Disc,
    /// One circle.
    Ring,
    /// Rows two spacings apart, about twice as wide as deep.
    Rows,
}

impl Shape {
    /// All shapes, in the order in which cases are numbered.
    pub const ALL: [Self; 5] = [Self::Grid, Self::Hexagon, Self::Disc, Self::Ring, Self::Rows];

    /// Its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Hexagon => "hexagon",
            Self::Disc => "disc",
            Self::Ring => "ring",
            Self::Rows => "rows",
        }
    }

    /// The places of `count` robots, metres, with the middle of their bounding box at the origin. The nearest two
    /// places are `spacing_m` apart.
    pub fn places(self, count: usize, spacing_m: f64) -> Vec<Vec2> {
        let places = match self {
            Self::Grid => lattice(count, ((count as f64).sqrt().ceil()) as usize, 1.0),
            Self::Hexagon => hexagon(count),
            Self::Disc => sunflower(count),
            Self::Ring => ring(count),
            // Four times as many columns as rows, which are twice as far apart.
            Self::Rows => lattice(count, ((4 * count) as f64).sqrt().ceil() as usize, 2.0),
        };
        centred(&places, spacing_m)
    }
}

/// A lattice with a column spacing of 1 and a row spacing of `row_step`. The last row may be shorter.
fn lattice(count: usize, columns: usize, row_step: f64) -> Vec<Vec2> {
    (0..count).map(|nth| Vec2::new((nth % columns) as f64, (nth / columns) as f64 * row_step)).collect()
}

/// The `count` places of a triangular lattice that are nearest to one of its places.
fn hexagon(count: usize) -> Vec<Vec2> {
    let half = (count as f64).sqrt() as i32 + 2;
    let mut spots: Vec<(i32, i32)> =
        (-half..=half).flat_map(|row| (-half..=half).map(move |column| (row, column))).collect();
    // The key is the squared distance in whole numbers, so that equally distant places have the same order on every
    // machine.
    spots.sort_by_key(|&(row, column)| (row * row + row * column + column * column, row, column));
    let row_step = 3.0_f64.sqrt() / 2.0;
    let place = |&(row, column): &(i32, i32)| {
        Vec2::new(f64::from(column) + 0.5 * f64::from(row), f64::from(row) * row_step)
    };
    spots[..count].iter().map(place).collect()
}

/// Vogel's spiral, scaled so that the nearest two places are 1 apart.
fn sunflower(count: usize) -> Vec<Vec2> {
    let golden_angle = PI * (3.0 - 5.0_f64.sqrt());
    let place = |nth: usize| Vec2::unit(golden_angle * nth as f64) * (nth as f64 + 0.5).sqrt();
    let places: Vec<Vec2> = (0..count).map(place).collect();
    let nearest = nearest(&places);
    places.into_iter().map(|place| place / nearest).collect()
}

/// A circle whose neighbours are 1 apart.
fn ring(count: usize) -> Vec<Vec2> {
    let radius = 0.5 / libm::sin(PI / count as f64);
    (0..count).map(|nth| Vec2::unit(2.0 * PI * nth as f64 / count as f64) * radius).collect()
}

/// The least distance between two places.
pub fn nearest(places: &[Vec2]) -> f64 {
    let pairs = places.iter().enumerate().flat_map(|(nth, a)| places[..nth].iter().map(|b| a.distance(*b)));
    pairs.fold(f64::INFINITY, f64::min)
}

fn centred(places: &[Vec2], scale: f64) -> Vec<Vec2> {
    let (low, high) = bounds(places);
    places.iter().map(|place| (*place - (low + high) / 2.0) * scale).collect()
}

/// The lower and upper corner of the bounding box.
pub fn bounds(places: &[Vec2]) -> (Vec2, Vec2) {
    let most = Vec2::new(f64::INFINITY, f64::INFINITY);
    places.iter().fold((most, -most), |(low, high), place| {
        (
            Vec2::new(low.x.min(place.x), low.y.min(place.y)),
            Vec2::new(high.x.max(place.x), high.y.max(place.y)),
        )
    })
}

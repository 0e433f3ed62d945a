//! A show of a thousand robots on a floor of twelve metres.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Show};

use super::color::{BLUE, CYAN, GOLD, GREEN, ORANGE, RED, ROSE, VIOLET, WHITE, gradient, rainbow};
use super::draw::{frame, shaded, show as on_floor};
use super::galaxy::{arm, sunflower};
use super::heart::outline;
use super::stroke::{along, ring};
use super::timeline::with_layers;

/// Number of robots of the show.
const ROBOTS: usize = 1_000;
/// Radius of the pictures, metres.
const RADIUS_M: f64 = 5.6;

/// Layers over each picture.
const LIGHT: &str = r##"
{"name": "Northern lights", "kind": "plasma", "frames": ["1", "1"], "settings": {"palette": ["#04122b", "#00c878", "#5cffb0", "#7a2bd6"],
    "size_m": 5, "speed_hz": 0.12}},
{"name": "Petals", "kind": "chase", "frames": ["2", "2"], "settings": {"along": "distance", "size_m": 3, "palette": ["#505050", "#ffffff"],
    "speed_hz": 0.3, "width": 0.8, "blend": "multiply", "opacity": [[0, 0], [2, 1]]}},
{"name": "Stars", "kind": "twinkle", "frames": ["3", "3"], "settings": {"palette": ["#000000", "#ffffff"], "speed_hz": 0.5,
    "density": 0.35, "width": 0.4, "blend": "screen", "opacity": [[0, 0], [2, 1]]}},
{"name": "Heartbeat", "kind": "pulse", "frames": ["4", "4"], "settings": {"palette": ["#505050", "#ffffff"], "speed_hz": 1.1,
    "width": 0.2, "blend": "multiply", "opacity": [[0, 0], [2, 1]]}},
{"name": "Ripple", "kind": "wave", "frames": ["5", "5"], "settings": {"along": "distance", "size_m": 2.8, "palette": ["#303030", "#ffffff"],
    "speed_hz": 0.5, "blend": "multiply", "opacity": [[0, 0], [2, 1]]}}
"##;

pub fn show() -> Show {
    let frames = vec![field(), flower(), spiral(), filled_heart(), ripples()];
    with_layers(on_floor("A thousand", 12.0, frames), LIGHT)
}

fn field() -> Frame {
    let places = (0..ROBOTS).map(|nth| {
        let (column, row) = (nth % 40, nth / 40);
        Vec2::new(column as f64 * 0.28 - 5.46, 5.4 - row as f64 * 0.28)
    });
    frame("Field", 4.0, shaded(places, |at| gradient(&[BLUE, CYAN, GREEN, GOLD], (at.x + at.y + 6.0) / 16.0)))
}

fn flower() -> Frame {
    let petal = |at: Vec2| gradient(&[ORANGE, GOLD, WHITE, ROSE, VIOLET], at.length() / RADIUS_M);
    frame("Sunflower", 3.0, shaded(sunflower(ROBOTS, RADIUS_M), petal))
}

fn spiral() -> Frame {
    let places = (0..5).flat_map(|nth| along(&arm(f64::from(nth) / 5.0, RADIUS_M, 1.4), ROBOTS / 5));
    frame(
        "Galaxy",
        3.0,
        shaded(places, |at| gradient(&[WHITE, GOLD, ROSE, VIOLET, BLUE, CYAN], at.length() / RADIUS_M)),
    )
}

/// A frame of a triangular lattice inside a heart. The lattice becomes finer until it has enough places.
fn filled_heart() -> Frame {
    let line: Vec<Vec2> = outline(Vec2::ZERO, RADIUS_M).into_iter().step_by(6).collect();
    let inside = (0..60).map(|finer| lattice(0.29 - 0.0005 * f64::from(finer), &line));
    let mut places = inside.into_iter().find(|places| places.len() >= ROBOTS).unwrap_or_default();
    // The surplus places are the lowest ones, so the tip becomes a little blunter.
    places.truncate(ROBOTS);
    let blood =
        |at: Vec2| -> Rgb { gradient(&[RED, ROSE, ORANGE, GOLD], at.distance(Vec2::new(-1.5, 2.0)) / 8.0) };
    frame("Heart", 3.0, shaded(places, blood))
}

/// Places of a triangular lattice inside the closed line, from the top row to the bottom row. `step_m`: distance
/// between neighbours.
fn lattice(step_m: f64, line: &[Vec2]) -> Vec<Vec2> {
    let (row_m, rows) = (step_m * 0.866, (2.0 * RADIUS_M / (step_m * 0.866)) as i32);
    let columns = (2.0 * RADIUS_M / step_m) as i32 / 2;
    let all = (0..=rows).flat_map(|row| {
        let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
        (-columns..=columns).map(move |column| {
            Vec2::new((f64::from(column) + shift) * step_m, RADIUS_M - f64::from(row) * row_m)
        })
    });
    all.filter(|at| is_inside(*at, line)).collect()
}

/// Whether a place is inside a closed line: a ray to the right crosses the line an odd number of times.
fn is_inside(at: Vec2, line: &[Vec2]) -> bool {
    let crosses = |pair: &&[Vec2]| {
        let (a, b) = (pair[0], pair[1]);
        (a.y > at.y) != (b.y > at.y) && at.x < a.x + (b.x - a.x) * (at.y - a.y) / (b.y - a.y)
    };
    line.windows(2).filter(crosses).count() % 2 == 1
}

fn ripples() -> Frame {
    // A ring's share of the robots is proportional to its length: 1 + 2 + … + 16 = 136 shares.
    let mut left = ROBOTS;
    let mut dots = Vec::new();
    for nth in (1..=16).rev() {
        let count = if nth == 1 { left } else { (ROBOTS * nth + 68) / 136 };
        left -= count;
        let places = ring(Vec2::ZERO, 0.35 * nth as f64, count, 0.25);
        dots.extend(shaded(places, |at| rainbow(nth as f64 / 16.0 + at.angle() / std::f64::consts::TAU)));
    }
    frame("Ripples", 4.0, dots)
}

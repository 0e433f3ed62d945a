//! Line drawings of a voyage: a ship leaves a lighthouse, meets a whale and a fish, and drops its anchor.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Frame, Show, close_pairs};

use super::color::{BLUE, CYAN, GOLD, GREEN, ORANGE, RED, ROSE, VIOLET, WHITE};
use super::draw::{frame, lit, shaded, show as on_floor};
use super::stroke::{Stroke, along, trace};
use super::timeline::with_layers;

/// Number of robots of the show.
const ROBOTS: usize = 200;
/// Height of the sea's first row, y in metres.
const SEA_M: f64 = -1.75;
/// Distance from the first to the last light of a row of the sea, metres.
const SEA_WIDTH_M: f64 = 4.3;
/// Most lights in a row of the sea.
const SEA_ROW: usize = 50;
/// Least distance between two lights of a drawing, metres.
const GAP_M: f64 = 0.084;
/// Fewest robots that draw the sea.
const SEA_LEAST: usize = 40;

/// Layers: the beam of the lighthouse, water, and glitter on the anchor.
const LIGHT: &str = r##"
{"name": "Lighthouse", "kind": "chase", "frames": ["1", "1"], "settings": {"along": "angle", "place": [0.6, 0.98],
    "palette": ["#303030", "#ffffff"], "speed_hz": 0.35, "width": 0.4, "blend": "multiply"}},
{"name": "Water", "kind": "wave", "settings": {"palette": ["#2040a0", "#ffffff"], "size_m": 1.4, "speed_hz": 0.4,
    "blend": "multiply", "masks": [{"shape": "rectangle", "center": [0, -1.9], "size_m": [5, 0.7], "angle": 0, "feather_m": 0.1}]}},
{"name": "Glitter", "kind": "sparkle", "frames": ["5", "5"], "settings": {"palette": ["#000000", "#ffffff"], "speed_hz": 5,
    "density": 0.08, "blend": "screen"}}
"##;

pub fn show() -> Show {
    let frames = vec![
        picture("Lighthouse", &lighthouse(), |at| match at {
            at if at.x < 0.1 || at.x > 1.1 => GOLD,
            at if at.y > 0.75 => WHITE,
            at if (at.y * 2.2).rem_euclid(2.0) < 1.0 => RED,
            _ => WHITE,
        }),
        picture("Ship", &ship(), |at| match at.y {
            y if y < -0.6 => ORANGE,
            y if y > 1.55 => RED,
            _ => WHITE,
        }),
        picture("Whale", &whale(), |at| if at.y > 0.55 && at.x < 0.2 { CYAN } else { BLUE }),
        picture("Fish", &fish(), |at| if at.x > 0.95 { ROSE } else { GOLD }),
        picture("Anchor", &anchor(), |at| if at.y > 1.0 { GOLD } else { GREEN }),
    ];
    with_layers(on_floor("Voyage", 5.0, frames), LIGHT)
}

/// A frame of a drawing above the sea. As many robots draw it as fit at least `GAP_M` apart, and the others show the
/// sea.
fn picture(name: &str, strokes: &[Stroke], shade: impl Fn(Vec2) -> Rgb) -> Frame {
    let mut counts = (SEA_LEAST..ROBOTS).map(|sea| trace(strokes, ROBOTS - sea));
    let drawn = counts.find(|places| close_pairs(places, GAP_M, 1).is_empty());
    let mut dots = shaded(drawn.unwrap_or_default(), shade);
    dots.extend(lit(sea(ROBOTS - dots.len()), VIOLET.mixed(BLUE, 0.7)));
    frame(name, 3.0, dots)
}

/// `count` places on waves in rows of equal length, with at most [`SEA_ROW`] places each.
fn sea(count: usize) -> Vec<Vec2> {
    let lines = count.div_ceil(SEA_ROW);
    let place = |line: usize, column: usize, columns: usize| {
        let x = (column as f64 / (columns - 1) as f64 - 0.5) * SEA_WIDTH_M;
        Vec2::new(x, SEA_M - 0.14 * line as f64 + 0.05 * Vec2::unit(x * 5.0).y)
    };
    let row = |line: usize| {
        let columns = count * (line + 1) / lines - count * line / lines;
        (0..columns).map(move |column| place(line, column, columns))
    };
    (0..lines).flat_map(row).collect()
}

/// A part of an ellipse. Angles are in turns, counter-clockwise from +x.
fn arc(centre: Vec2, radii: Vec2, from: f64, to: f64) -> Stroke {
    (0..=60)
        .map(|part| {
            let angle = std::f64::consts::TAU * (from + (to - from) * f64::from(part) / 60.0);
            let on_circle = Vec2::unit(angle);
            centre + Vec2::new(on_circle.x * radii.x, on_circle.y * radii.y)
        })
        .collect()
}

fn line(points: &[(f64, f64)]) -> Stroke {
    points.iter().map(|&(x, y)| Vec2::new(x, y)).collect()
}

fn lighthouse() -> Vec<Stroke> {
    vec![
        line(&[(0.25, -1.4), (0.4, 0.75), (0.8, 0.75), (0.95, -1.4), (0.25, -1.4)]),
        line(&[(0.4, 0.75), (0.4, 1.2), (0.6, 1.45), (0.8, 1.2), (0.8, 0.75)]),
        line(&[(0.3, -0.7), (0.9, -0.7)]),
        line(&[(0.35, 0.05), (0.85, 0.05)]),
        line(&[(0.15, 1.0), (-1.9, 1.45)]),
        line(&[(0.15, 0.9), (-1.9, 0.55)]),
        line(&[(1.05, 1.0), (2.1, 1.25)]),
        line(&[(1.05, 0.9), (2.1, 0.65)]),
    ]
}

fn ship() -> Vec<Stroke> {
    let sail = |mast: f64, top: f64, out: f64| {
        let mut edge = arc(Vec2::new(mast, -0.4), Vec2::new(out, top + 0.4), 0.25, 0.0);
        edge.push(Vec2::new(mast, -0.4));
        edge
    };
    vec![
        line(&[(-1.6, -0.65), (-1.15, -1.35), (1.1, -1.35), (1.75, -0.65), (-1.6, -0.65)]),
        line(&[(0.0, -0.65), (0.0, 1.9)]),
        sail(0.14, 1.45, 1.2),
        sail(-0.14, 1.15, -1.0),
        line(&[(0.0, 1.9), (-0.5, 1.77), (0.0, 1.63)]),
    ]
}

fn whale() -> Vec<Stroke> {
    let mut back = arc(Vec2::new(-0.3, -0.75), Vec2::new(1.35, 0.95), 0.5, 0.06);
    back.extend(line(&[(1.35, -0.3), (1.7, 0.3)]));
    let mut belly = arc(Vec2::new(-0.3, -0.75), Vec2::new(1.35, 0.6), 0.5, 0.96);
    belly.extend(line(&[(1.5, -0.6), (1.85, 0.3)]));
    vec![
        back,
        belly,
        line(&[(1.7, 0.3), (1.2, 0.8), (1.8, 0.65), (2.3, 1.0), (1.85, 0.3)]),
        arc(Vec2::new(-0.95, 0.55), Vec2::new(0.35, 0.75), 0.0, 0.25),
        arc(Vec2::new(-0.25, 0.55), Vec2::new(0.35, 0.75), 0.5, 0.25),
        arc(Vec2::new(-1.05, -0.6), Vec2::new(0.07, 0.07), 0.0, 1.0),
        arc(Vec2::new(-0.6, -0.85), Vec2::new(0.6, 0.25), 0.55, 0.8),
    ]
}

fn fish() -> Vec<Stroke> {
    vec![
        arc(Vec2::new(-0.3, -0.7), Vec2::new(1.4, 1.35), 0.399, 0.101),
        arc(Vec2::new(-0.3, 0.9), Vec2::new(1.4, 1.35), 0.601, 0.899),
        line(&[(0.83, 0.1), (1.7, 0.85), (1.5, 0.1), (1.7, -0.65), (0.83, 0.1)]),
        arc(Vec2::new(-0.9, 0.25), Vec2::new(0.09, 0.09), 0.0, 1.0),
        arc(Vec2::new(-1.0, 0.1), Vec2::new(0.5, 0.6), -0.11, 0.11),
        line(&[(-0.3, 0.85), (0.1, 1.15), (0.45, 0.7)]),
    ]
}

fn anchor() -> Vec<Stroke> {
    vec![
        arc(Vec2::new(0.0, 1.55), Vec2::new(0.28, 0.28), -0.25, 0.75),
        line(&[(0.0, 1.27), (0.0, -1.3)]),
        line(&[(-0.7, 0.85), (0.7, 0.85)]),
        arc(Vec2::new(0.0, -0.2), Vec2::new(1.35, 1.1), 0.52, 0.98),
        line(&[(-1.6, -0.55), (-1.36, -0.05), (-1.0, -0.45)]),
        line(&[(1.6, -0.55), (1.36, -0.05), (1.0, -0.45)]),
        along(&line(&[(0.28, 1.6), (1.0, 1.75), (1.7, 1.55), (2.2, 1.85)]), 30),
    ]
}

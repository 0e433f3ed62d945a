//! Measures placing methods on simple shapes: `cargo run --release -p lightbots-draw --example figures [FILE.svg]`.
#![allow(clippy::print_stdout)]

use std::fmt::Write;
use std::time::Instant;

use lightbots_base::{Rgb, Vec2};
use lightbots_draw::{
    Area, Drawing, DrawingPart, FillRule, PictureFloor, PlaceSettings, Quality, Style, figures, place,
};

fn ring(points: impl Iterator<Item = (f64, f64)>) -> Vec<Vec2> {
    points.map(|(x, y)| Vec2::new(x, y)).collect()
}

fn circle(r: f64) -> Vec<Vec2> {
    ring((0..180).map(|i| f64::from(i) * std::f64::consts::PI / 90.0).map(|a| (r * a.cos(), r * a.sin())))
}

fn shapes() -> Vec<(&'static str, Vec<Vec<Vec2>>)> {
    let turn =
        |i: i32, n: i32| f64::from(i) * std::f64::consts::TAU / f64::from(n) + std::f64::consts::FRAC_PI_2;
    let star = ring((0..10).map(|i| {
        let r = if i % 2 == 0 { 0.5 } else { 0.2 };
        (r * turn(i, 10).cos(), r * turn(i, 10).sin())
    }));
    let heart = ring((0..180).map(|i| turn(i, 180)).map(|a| {
        let y = 13.0 * a.cos() - 5.0 * (2.0 * a).cos() - 2.0 * (3.0 * a).cos() - (4.0 * a).cos();
        (0.03 * 16.0 * a.sin().powi(3), 0.03 * y)
    }));
    let h = [
        (0., 0.),
        (0.2, 0.),
        (0.2, 0.4),
        (0.5, 0.4),
        (0.5, 0.),
        (0.7, 0.),
        (0.7, 1.),
        (0.5, 1.),
        (0.5, 0.6),
        (0.2, 0.6),
        (0.2, 1.),
        (0., 1.),
    ];
    let a = [(0., 0.), (0.2, 0.), (0.28, 0.25), (0.52, 0.25), (0.6, 0.), (0.8, 0.), (0.5, 1.), (0.3, 1.)];
    let a_hole = [(0.33, 0.42), (0.4, 0.7), (0.47, 0.42)];
    vec![
        ("star", vec![star]),
        ("heart", vec![heart]),
        ("ring", vec![circle(0.5), circle(0.28)]),
        ("disc", vec![circle(0.5)]),
        ("H", vec![ring(h.into_iter())]),
        ("A", vec![ring(a.into_iter()), ring(a_hole.into_iter())]),
    ]
}

fn main() {
    let mut svg = String::new();
    let counts = [12, 30, 100, 500, 2000];
    for (row, (name, rings)) in shapes().into_iter().enumerate() {
        let area = Area { rings, rule: FillRule::EvenOdd, ink: Rgb::new(255, 160, 0).into(), weight: 1.0 };
        let part = DrawingPart { name: name.into(), areas: vec![area], ..DrawingPart::default() };
        let drawing = Drawing { parts: vec![part.clone()] };
        for (column, robots) in counts.into_iter().enumerate() {
            for (half, style) in [Style::Filled, Style::Both].into_iter().enumerate() {
                let settings = PlaceSettings {
                    robots,
                    style,
                    spacing_m: 0.06,
                    size_m: Some(4.0),
                    quality: Quality::Full,
                    ..PlaceSettings::default()
                };
                let began = Instant::now();
                let placed = place(&drawing, &PictureFloor::new(20.0, 20.0, 0.0), &settings);
                let took = began.elapsed().as_secs_f64() * 1e3;
                let Ok(placed) = placed else {
                    println!("{name} {robots} {style:?}: {placed:?}");
                    continue;
                };
                let places: Vec<Vec2> = placed.lights.iter().map(|light| light.at).collect();
                let (low, high) = drawing.bounds().unwrap_or_default();
                let scale = placed.size_m / (high.x - low.x).max(high.y - low.y);
                let back: Vec<Vec2> =
                    places.iter().map(|at| *at * (1.0 / scale) + low.lerp(high, 0.5)).collect();
                if let Some(f) = figures(&part, &back) {
                    println!(
                        "{name:6} {robots:5} {style:?}: CV {:.3} dmin {:.2} Hd {:.2} out {:.2} cov {:.2} cor {:.2} ncc {:.3} sym {:.2} {took:.0} ms",
                        f.variation,
                        f.closest,
                        f.farthest_point,
                        f.farthest_place,
                        f.covered,
                        f.corners,
                        placed.readability.correlation,
                        placed.readability.symmetry
                    );
                }
                let origin = Vec2::new((2 * column + half) as f64 * 120.0 + 60.0, row as f64 * 120.0 + 60.0);
                for at in places {
                    let at = origin + Vec2::new(at.x, -at.y) * (100.0 / placed.size_m);
                    let _ = write!(svg, "<circle cx='{:.1}' cy='{:.1}' r='1.8' fill='#fa0'/>", at.x, at.y);
                }
            }
        }
    }
    if let Some(file) = std::env::args().nth(1) {
        let page = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='1200' height='720'><rect width='1200' height='720' fill='#111'/>{svg}</svg>"
        );
        if let Err(error) = std::fs::write(file, page) {
            println!("{error}");
        }
    }
}

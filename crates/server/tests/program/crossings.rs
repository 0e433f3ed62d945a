//! Shows as the original saves them: the same robot shows pixel 7 in every frame, and straight lines collide.

use serde_json::{Value, json};

use crate::child::run;
use crate::shows;

type Place = (f64, f64);

/// Writes a file of frames in the original's format. Places are in metres.
fn file(frames: &[Vec<Place>]) -> String {
    let pixel = |(id, (x, y)): (usize, &Place)| json!({"pixelId": id, "color": {"R": 1.0, "G": 0.647, "B": 0.0}, "physicalLocation": {"X": x, "Y": y}});
    let frame = |(number, places): (usize, &Vec<Place>)| {
        let pixels: Vec<Value> = places.iter().enumerate().map(pixel).collect();
        json!({"name": number.to_string(), "airTime": 0.2, "pixels": pixels})
    };
    let frames: Vec<Value> = frames.iter().enumerate().map(frame).collect();
    shows::file("crossing.json", Value::from(frames).to_string())
}

fn reversed(mut places: Vec<Place>) -> Vec<Place> {
    places.reverse();
    places
}

fn crossing_shows() -> Vec<(&'static str, Vec<Vec<Place>>)> {
    let line = |count: u32, step_m: f64, y: f64| -> Vec<Place> {
        (0..count).map(|i| ((f64::from(i) - f64::from(count - 1) / 2.0) * step_m, y)).collect()
    };
    let ring: Vec<Place> = (0..16)
        .map(|i| (f64::from(i) / 16.0 * std::f64::consts::TAU).sin_cos())
        .map(|(y, x)| (0.7 * x, 0.7 * y))
        .collect();
    let mirrored = ring.iter().map(|&(x, y)| (-x, -y)).collect();
    let column = |x: f64| (0..6).map(move |i| (x, f64::from(i) * 0.1 - 0.25));
    let halves = |x: f64| column(-x).chain(column(x)).collect::<Vec<_>>();
    let grid: Vec<Place> =
        (0..25).map(|i| (f64::from(i % 5) * 0.16 - 0.32, f64::from(i / 5) * 0.16 - 0.32)).collect();
    let shuffled = (0..25).map(|i| grid[(i * 7 + 3) % 25]).collect();
    vec![
        ("two change places", vec![line(2, 0.8, 0.0), reversed(line(2, 0.8, 0.0))]),
        ("a line turns round", vec![line(7, 0.12, 0.2), reversed(line(7, 0.12, 0.2))]),
        ("lines pass through each other", vec![halves(0.6), halves(-0.6), halves(0.6)]),
        ("a ring through its centre", vec![ring, mirrored]),
        ("a shuffled grid", vec![grid, shuffled]),
    ]
}

#[test]
fn shows_whose_straight_lines_collide_are_rehearsed_without_contact() {
    for (name, frames) in crossing_shows() {
        let path = file(&frames);
        let robots = frames[0].len();
        for faults in ["loss=1%".to_owned(), format!("original={robots}")] {
            let arguments = ["rehearse", &path, "--identity", "fixed", "--faults", &faults, "--json"];
            let (code, out, err) = run(&arguments);
            let report: Value = serde_json::from_str(&out).unwrap_or_else(|_| panic!("{name}: {out} {err}"));
            assert_eq!((code, report["ok"].as_bool()), (0, Some(true)), "{name}, {faults}: {out}");
            assert_eq!(report["contacts"], 0, "{name}, {faults}");
            assert_eq!(report["frames_played"], frames.len(), "{name}, {faults}");
            assert!(report["closest_m"].as_f64().unwrap() >= 0.054, "{name}, {faults}");
        }
    }
}

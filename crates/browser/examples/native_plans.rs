//! Plans one transition for several fleets in native code and writes the requests, for a comparison with WebAssembly.
//!
//! `native_plans FOLDER` writes `FOLDER/N.json`, a `PlanningRequest` for N robots. For each it prints a line of JSON:
//! the number of robots and the median duration of the same call, milliseconds.

#![allow(clippy::print_stdout, reason = "it prints its table")]

use std::path::Path;
use std::time::Instant;

use lightbots_base::random::split_mix;

/// Numbers of robots.
const FLEETS: [usize; 4] = [30, 100, 1_000, 10_000];
/// Side of the cells that contain one pixel each, metres: about 30 robots on 9 m².
const CELL_M: f64 = 0.55;
/// Largest distance of a pixel from the middle of its cell in x and y, metres. Pixels are at least 76.4 mm apart.
const OFF_M: f64 = 0.23;

fn main() {
    let folder = std::env::args().nth(1).expect("the folder for the requests");
    for robots in FLEETS {
        let request = request(robots);
        let path = Path::new(&folder).join(format!("{robots}.json"));
        std::fs::write(path, &request).expect("the folder can be written");
        let rounds = (3_000 / robots).clamp(3, 41);
        let mut times: Vec<f64> = (0..rounds).map(|_| timed(&request)).collect();
        times.sort_by(f64::total_cmp);
        println!("{{\"robots\": {robots}, \"native_ms\": {}}}", times[rounds / 2]);
    }
}

fn timed(request: &str) -> f64 {
    let began = Instant::now();
    let answer = lightbots_browser::plan(request);
    let took_ms = began.elapsed().as_secs_f64() * 1e3;
    assert!(answer.contains(r#""ok":true"#), "the show can be played");
    took_ms
}

/// A request with two random frames. Robots start on the pixels of the first frame.
fn request(robots: usize) -> String {
    let columns = (robots as f64).sqrt().ceil() as usize;
    let side_m = columns as f64 * CELL_M;
    let mut dice = robots as u64;
    let mut places = || -> Vec<[f64; 2]> {
        let cell = |index: usize| index as f64 * CELL_M + CELL_M / 2.0 - side_m / 2.0;
        let place = |robot: usize, dice: &mut u64| {
            [cell(robot % columns) + offset_m(dice), cell(robot / columns) + offset_m(dice)]
        };
        (0..robots).map(|robot| place(robot, &mut dice)).collect()
    };
    let (first, second) = (places(), places());
    let frames = [&first, &second].map(|places| frame(places)).join(",");
    let stage = format!(r#"{{"width_m": {side_m}, "depth_m": {side_m}}}"#);
    format!(
        r#"{{"quality": "quick", "show": {{"lightbots": 1, "stage": {stage}, "starts": {first:?}, "frames": [{frames}]}}}}"#
    )
}

fn frame(places: &[[f64; 2]]) -> String {
    let pixel = |(id, place): (usize, &[f64; 2])| {
        format!(r##"{{"id": {id}, "place": {place:?}, "color": "#ffa500"}}"##)
    };
    let pixels: Vec<String> = places.iter().enumerate().map(pixel).collect();
    format!(r#"{{"name": "Random", "air_time_s": 1, "pixels": [{}]}}"#, pixels.join(","))
}

/// A random number from -OFF_M to OFF_M.
fn offset_m(dice: &mut u64) -> f64 {
    let share = (split_mix(dice) >> 11) as f64 / (1u64 << 53) as f64;
    (share * 2.0 - 1.0) * OFF_M
}

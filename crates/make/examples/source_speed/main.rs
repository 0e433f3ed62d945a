//! Measures how long frames take to make natively, one at a time: `cargo xtask bench make`.
#![allow(clippy::print_stdout)]

#[path = "../sheet/pictures.rs"]
mod pictures;
#[path = "../sheet/sources.rs"]
mod sources;

use std::error::Error;
use std::time::Instant;

use lightbots_draw::{PictureFloor, Quality};
use lightbots_make::make_frame;
use lightbots_show::Frame;

use crate::sources::Source;

/// Names of the measured sources: a word, a drawing, a silhouette without background, a picture in tones, and a shape.
const MEASURED: [&str; 5] = ["HELLO", "cat", "mug", "hills", "star"];

fn main() -> Result<(), Box<dyn Error>> {
    for source in sources::all()?.iter().filter(|source| MEASURED.contains(&source.name)) {
        for robots in [30, 100, 1_000, 10_000] {
            let rounds = if robots > 1_000 { 1 } else { 5 };
            let full = median_ms(source, robots, Quality::Full, rounds)?;
            let preview = median_ms(source, robots, Quality::Quick, rounds)?;
            println!(
                "{{\"source\":\"{}\",\"robots\":{robots},\"full_ms\":{full:.2},\"preview_ms\":{preview:.2}}}",
                source.name
            );
        }
    }
    Ok(())
}

/// Median duration of `rounds` rounds, decoding included, milliseconds.
fn median_ms(source: &Source, robots: usize, quality: Quality, rounds: usize) -> Result<f64, String> {
    let frame = Frame { sources: vec![source.recipe.source()], ..Frame::default() };
    let side_m = (robots as f64).sqrt().mul_add(0.4, 1.0);
    let floor = PictureFloor::new(side_m, side_m, 0.05);
    let mut times = Vec::new();
    for _ in 0..rounds {
        let before = Instant::now();
        make_frame(&frame, source.asset.as_deref(), &floor, robots, quality, &[])
            .map_err(|error| format!("{} with {robots} robots: {}", source.name, error.message))?;
        times.push(before.elapsed().as_secs_f64() * 1_000.0);
    }
    times.sort_by(f64::total_cmp);
    Ok(times[times.len() / 2])
}

//! Measures how many robots letters and digits need. Each is placed, viewed from five slightly wrong positions, and
//! read by templates: `cargo run --release -p lightbots-draw --example letters`.
#![allow(clippy::print_stdout)]

use lightbots_base::{Vec2, random::split_mix};
use lightbots_draw::text::{self, Font, TextSettings};
use lightbots_draw::{DOUBTFUL, PictureFloor, PlaceSettings, READABLE, SignReader, Style, place};

/// The signs that are measured.
const SIGNS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
/// Numbers of robots with which each sign is shown.
const COUNTS: [usize; 8] = [6, 8, 10, 12, 16, 20, 30, 60];

fn main() {
    let reader = SignReader::default();
    for font in ["lato", "league-spartan", "quicksand", "hershey-sans"] {
        let Some(face) = Font::built_in(font) else { continue };
        println!("{font}: share of 36 signs read, with a correlation of at least {DOUBTFUL} / {READABLE}");
        for robots in COUNTS {
            let reads: Vec<(char, Seen)> =
                SIGNS.chars().filter_map(|sign| Some((sign, seen(&reader, &face, sign, robots)?))).collect();
            let share = |least: f64| {
                let read = reads.iter().filter(|(_, seen)| seen.right >= 4 && seen.mean >= least).count();
                100 * read / reads.len().max(1)
            };
            let wrong: String = reads
                .iter()
                .filter(|(_, seen)| seen.right < 4 || seen.mean < DOUBTFUL)
                .map(|(sign, seen)| format!(" {sign}>{}({:.2})", seen.as_what, seen.mean))
                .collect();
            println!(
                "  {robots:3} robots: {:3} / {:3} %  not read:{wrong}",
                share(DOUBTFUL),
                share(READABLE)
            );
        }
    }
}

struct Seen {
    right: usize,
    mean: f64,
    as_what: char,
}

fn seen(reader: &SignReader, font: &Font, sign: char, robots: usize) -> Option<Seen> {
    let words = sign.to_string();
    let drawing = text::draw(&TextSettings::new(&words, font)).ok()?.drawing;
    let settings = PlaceSettings { robots, style: Style::Auto, ..PlaceSettings::default() };
    let placed = place(&drawing, &PictureFloor::new(1_000.0, 1_000.0, 0.0), &settings).ok()?;
    let (low, high) = drawing.bounds()?;
    let height = placed.size_m * (high.y - low.y) / (high.x - low.x).max(high.y - low.y);
    let places: Vec<Vec2> = placed.lights.iter().map(|light| light.at).collect();
    let mut state = 1;
    let mut even = || split_mix(&mut state) as f64 / u64::MAX as f64 - 0.5;
    let views: Vec<_> = (0..5)
        .filter_map(|_| {
            let across = Vec2::unit(even() * 8_f64.to_radians());
            let view: Vec<Vec2> = places
                .iter()
                .map(|at| across * at.x + across.left() * at.y + Vec2::new(even(), even()) * (0.04 * height))
                .collect();
            reader.read(&view, height, sign)
        })
        .collect();
    let right = views.iter().filter(|read| read.sign == sign).count();
    let as_what = views.iter().find(|read| read.sign != sign).map_or(sign, |read| read.sign);
    let mean = views.iter().map(|read| read.correlation).sum::<f64>() / views.len().max(1) as f64;
    Some(Seen { right, mean, as_what })
}

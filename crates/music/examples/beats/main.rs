//! Makes twenty pieces of music, finds their beats, and compares them with the true ones:
//! `cargo run --release -p lightbots-music --example beats -- [--write FOLDER]`. The pieces are written to FOLDER as
//! WAV files.

mod pieces;
mod score;
mod synth;

use lightbots_music::{Sound, find_beats};
use pieces::Piece;
use std::time::Instant;

#[expect(clippy::print_stdout, reason = "it prints a table")]
fn main() {
    let folder = std::env::args().skip_while(|arg| arg != "--write").nth(1);
    if let Some(folder) = &folder {
        // This piece is for making a show, as in docs/music.md.
        write(folder, &pieces::lasting(120.0, "two minutes 120", |_| 120.0, 301, pieces::house));
    }
    println!("{:<14} {:>6} {:>6} {:>8} {:>8} {:>6}", "piece", "bpm", "F", "buttons", "early ms", "s");
    for (title, pieces) in [("first ten", pieces::first_ten()), ("ten others", pieces::ten_others())] {
        let mut sums = [0.0; 3];
        for piece in &pieces {
            if let Some(folder) = &folder {
                write(folder, piece);
            }
            let began = Instant::now();
            let sound = Sound::new(&piece.samples, synth::RATE_HZ).expect("pieces are long enough");
            let found = find_beats(&sound).expect("pieces have beats");
            let took_s = began.elapsed().as_secs_f64();
            let f = score::agreement(&found.times_s, &piece.beats_s);
            let best = score::with_buttons(&found.times_s, &piece.beats_s);
            let early_ms = -1000.0 * score::offset_s(&found.times_s, &piece.beats_s);
            println!("{:<14} {:6.1} {f:6.3} {best:8.3} {early_ms:8.1} {took_s:6.2}", piece.name, found.bpm);
            for (sum, value) in sums.iter_mut().zip([f, best, took_s]) {
                *sum += value / pieces.len() as f64;
            }
        }
        println!("{title:<14} {:6} {:6.3} {:8.3} {:8} {:6.2}", "", sums[0], sums[1], "", sums[2]);
    }
}

fn write(folder: &str, piece: &Piece) {
    let spec = hound::WavSpec {
        channels: 1,
        sample_rate: synth::RATE_HZ as u32,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let path = std::path::Path::new(folder).join(format!("{}.wav", piece.name.replace(' ', "-")));
    let loudest = piece.samples.iter().fold(1e-9_f32, |a, b| a.max(b.abs()));
    std::fs::create_dir_all(folder).expect("the folder can be made");
    let mut writer = hound::WavWriter::create(path, spec).expect("the folder can be written");
    for sample in &piece.samples {
        writer.write_sample((sample / loudest * 32_000.0) as i16).expect("the file can be written");
    }
    writer.finalize().expect("the file can be written");
}

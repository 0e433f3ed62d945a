//! Beats of pieces whose true beats are known.

#[path = "../examples/beats/pieces.rs"]
mod pieces;
#[path = "../examples/beats/score.rs"]
mod score;
#[path = "../examples/beats/synth.rs"]
mod synth;

use lightbots_music::{Sound, find_beats, steady};
use pieces::Piece;

fn found(piece: &Piece) -> Vec<f64> {
    let sound = Sound::new(&piece.samples, synth::RATE_HZ).expect("pieces are long enough");
    find_beats(&sound).expect("pieces have beats").times_s
}

/// Mean F score, and mean F score after the best of the buttons.
fn scores(pieces: &[Piece]) -> [f64; 2] {
    let mut sums = [0.0; 2];
    for piece in pieces {
        let beats = found(piece);
        sums[0] += score::agreement(&beats, &piece.beats_s) / pieces.len() as f64;
        sums[1] += score::with_buttons(&beats, &piece.beats_s) / pieces.len() as f64;
    }
    sums
}

#[test]
fn the_first_ten_are_found_without_help() {
    let [f, _] = scores(&pieces::first_ten());
    assert!(f >= 0.99, "{f}");
}

#[test]
fn the_others_are_found_with_at_most_one_press() {
    let [f, with_buttons] = scores(&pieces::ten_others());
    assert!(f >= 0.85 && with_buttons >= 0.98, "{f} {with_buttons}");
}

#[test]
fn found_beats_are_neither_early_nor_late() {
    for piece in &pieces::first_ten() {
        let offset_s = score::offset_s(&found(piece), &piece.beats_s);
        assert!(offset_s.abs() < 0.005, "{}: {offset_s} s", piece.name);
    }
}

#[test]
fn the_same_music_at_another_rate_has_the_same_beats() {
    let piece = &pieces::first_ten()[1];
    let doubled: Vec<f32> =
        piece.samples.windows(2).flat_map(|pair| [pair[0], f32::midpoint(pair[0], pair[1])]).collect();
    let sound = Sound::new(&doubled, 2.0 * synth::RATE_HZ).expect("the piece is long enough");
    let beats = find_beats(&sound).expect("the piece has beats").times_s;
    assert!(score::agreement(&beats, &piece.beats_s) > 0.98);
}

#[test]
fn a_steady_piece_is_steady_and_one_that_grows_faster_is_not() {
    let pieces = pieces::first_ten();
    let even = steady(&found(&pieces[1])).expect("120 beats a minute are steady");
    assert!((even.bpm - 120.0).abs() < 0.05, "{even:?}");
    assert!((even.offset_s - 0.4).abs() < 0.01, "{even:?}");
    assert_eq!(steady(&found(&pieces[4])), None);
}

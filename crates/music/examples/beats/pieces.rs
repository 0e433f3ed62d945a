//! Twenty pieces of music whose beats are known. The tracker was developed with ten of them, and the others were made
//! later.

use crate::synth::{Noise, RATE_HZ, Tape};

/// A piece of music and its true beats.
pub struct Piece {
    pub name: String,
    pub samples: Vec<f32>,
    /// Times of the beats, seconds.
    pub beats_s: Vec<f64>,
}

/// Duration of a piece, seconds.
const LASTS_S: f64 = 50.0;

/// Time before the first beat, seconds.
const LEAD_S: f64 = 0.4;

/// Duration of a fade-in, seconds.
const FADE_S: f64 = 20.0;

/// Root notes of a usual progression of four chords, Hz.
const ROOTS_HZ: [f64; 4] = [55.0, 43.65, 65.41, 49.0];

/// A function that plays one beat. It gets the tape, the number of the beat, its time and its duration, both in
/// seconds.
pub type Player = fn(&mut Tape, usize, f64, f64);

/// The ten pieces with which the tracker was developed.
pub fn first_ten() -> Vec<Piece> {
    vec![
        piece("steady 90", steady_tempo(90.0), 1, band),
        piece("steady 120", steady_tempo(120.0), 2, band),
        piece("steady 140", steady_tempo(140.0), 3, band),
        piece("swing 130", steady_tempo(130.0), 4, swing),
        piece("100 to 120", |t| 100.0 + 20.0 * t / LASTS_S, 5, band),
        piece("waltz 150", steady_tempo(150.0), 6, waltz),
        piano("piano 76", 76.0, 7),
        piece("off-beat 110", steady_tempo(110.0), 8, offbeat),
        faded(piece("fade-in 128", steady_tempo(128.0), 9, band)),
        piece("fast hats 85", steady_tempo(85.0), 10, fast_hats),
    ]
}

/// Ten pieces with other tempi, seeds and styles, made after the tracker was finished.
pub fn ten_others() -> Vec<Piece> {
    vec![
        piece("house 124", steady_tempo(124.0), 201, house),
        piece("half-time 146", steady_tempo(146.0), 202, half_time),
        piece("band 96", steady_tempo(96.0), 203, band),
        piece("strings 84", steady_tempo(84.0), 204, strings),
        piece("swing 112", steady_tempo(112.0), 205, swing),
        piece("92 to 106", |t| 92.0 + 14.0 * t / LASTS_S, 206, house),
        piece("waltz 138", steady_tempo(138.0), 207, waltz),
        piano("piano 104", 104.0, 208),
        piece("off-beat 98", steady_tempo(98.0), 209, offbeat),
        piece("bossa 72", steady_tempo(72.0), 210, bossa),
    ]
}

fn steady_tempo(bpm: f64) -> impl Fn(f64) -> f64 {
    move |_| bpm
}

/// Times of the beats at a tempo that may change, until `lasts_s`, seconds. `bpm` gives the tempo at a time.
fn beats_of(bpm: impl Fn(f64) -> f64, lasts_s: f64) -> Vec<f64> {
    let mut beats = vec![LEAD_S];
    loop {
        let last = beats[beats.len() - 1];
        let next = last + 60.0 / bpm(last);
        if next > lasts_s - 1.0 {
            return beats;
        }
        beats.push(next);
    }
}

fn piece(name: &str, bpm: impl Fn(f64) -> f64, seed: u64, play: Player) -> Piece {
    lasting(LASTS_S, name, bpm, seed, play)
}

/// A piece of `lasts_s` seconds.
pub fn lasting(lasts_s: f64, name: &str, bpm: impl Fn(f64) -> f64, seed: u64, play: Player) -> Piece {
    let beats_s = beats_of(bpm, lasts_s);
    let mut tape = Tape::new(lasts_s, seed);
    tape.hiss(0.002);
    for (i, at_s) in beats_s.iter().enumerate() {
        let next_s = beats_s.get(i + 1).copied().unwrap_or_else(|| 2.0 * at_s - beats_s[i - 1]);
        play(&mut tape, i, *at_s, next_s - at_s);
    }
    Piece { name: name.to_owned(), samples: tape.samples, beats_s }
}

fn root(bar: usize) -> f64 {
    ROOTS_HZ[bar % 4]
}

/// A style with drums, bass and chords, as in most songs.
fn band(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    let bar = beat / 4;
    match beat % 4 {
        0 => {
            tape.kick(at_s, 1.0);
            tape.pad(at_s, 4.0 * beat_s, 4.0 * root(bar), 1.0);
        }
        2 => tape.kick(at_s, 0.9),
        _ => tape.snare(at_s, 0.9),
    }
    tape.hat(at_s, 0.8);
    tape.hat(at_s + beat_s / 2.0, 0.6);
    tape.bass(at_s, 0.45 * beat_s, root(bar), 0.8);
    if beat % 4 == 3 {
        tape.kick(at_s + beat_s / 2.0, 0.7);
        tape.bass(at_s + beat_s / 2.0, 0.4 * beat_s, root(bar + 1), 0.6);
    }
}

/// A style with long and short eighths.
fn swing(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    tape.hat(at_s, 0.9);
    if beat % 2 == 1 {
        tape.hat(at_s + beat_s * 2.0 / 3.0, 0.7);
        tape.snare(at_s, 0.3);
    }
    tape.kick(at_s, 0.35);
    let step = [1.0, 1.26, 1.5, 1.335][beat % 4];
    tape.bass(at_s, 0.8 * beat_s, root(beat / 4) * step, 0.9);
    if beat % 8 == 3 {
        tape.stab(at_s + beat_s * 2.0 / 3.0, 4.0 * root(beat / 4), 0.6);
    }
}

/// A style with one heavy and two light beats.
fn waltz(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    let bar = beat / 3;
    if beat.is_multiple_of(3) {
        tape.kick(at_s, 1.0);
        tape.bass(at_s, 0.8 * beat_s, root(bar), 0.9);
        tape.pad(at_s, 3.0 * beat_s, 4.0 * root(bar), 0.8);
    } else {
        tape.hat(at_s, 0.9);
        tape.stab(at_s, 4.0 * root(bar), 0.5);
    }
}

/// A style with chords between soft beats.
fn offbeat(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    tape.stab(at_s + beat_s / 2.0, 4.0 * root(beat / 4), 1.0);
    tape.hat(at_s + beat_s / 2.0, 0.8);
    tape.kick(at_s, if beat % 4 == 2 { 0.8 } else { 0.35 });
    if beat % 4 != 1 {
        tape.bass(at_s, 0.4 * beat_s, root(beat / 4), 0.7);
    }
}

/// A style with four cymbals per beat.
fn fast_hats(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    for i in 0..4 {
        tape.hat(at_s + f64::from(i) * beat_s / 4.0, if i % 2 == 0 { 0.9 } else { 0.7 });
    }
    if beat.is_multiple_of(2) {
        tape.kick(at_s, 1.0)
    } else {
        tape.snare(at_s, 0.9)
    }
    tape.bass(at_s, 0.7 * beat_s, root(beat / 4), 0.7);
}

/// A style with a bass drum at each beat and cymbals between.
pub fn house(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    tape.kick(at_s, 1.0);
    tape.hat(at_s + beat_s / 2.0, 1.0);
    if beat % 2 == 1 {
        tape.snare(at_s, 0.7);
    }
    for part in [0.25, 0.5, 0.75] {
        tape.bass(at_s + part * beat_s, 0.2 * beat_s, root(beat / 8), 0.5);
    }
    if beat.is_multiple_of(16) {
        tape.pad(at_s, 16.0 * beat_s, 4.0 * root(beat / 16), 1.0);
    }
}

/// A style with the snare drum only at the third beat.
fn half_time(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    match beat % 4 {
        0 => tape.kick(at_s, 1.0),
        2 => tape.snare(at_s, 1.0),
        _ => {}
    }
    tape.hat(at_s, 0.7);
    tape.bass(at_s, 0.9 * beat_s, root(beat / 4), 0.7);
    if beat % 8 == 5 {
        tape.kick(at_s + beat_s / 2.0, 0.8);
    }
}

/// A style with bowed chords and no drums.
fn strings(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    let root_hz = root(beat / 4);
    if beat.is_multiple_of(2) {
        tape.pad(at_s - 0.05, 2.0 * beat_s, 4.0 * root_hz, 2.0);
    }
    let step = [1.0, 1.26, 1.5, 2.0][beat % 4];
    tape.bass(at_s, 0.95 * beat_s, 4.0 * root_hz * step, 0.6);
    if beat.is_multiple_of(4) {
        tape.bass(at_s, 3.8 * beat_s, root_hz, 0.7);
    }
}

/// A style with syncopated chords over a soft bass drum.
fn bossa(tape: &mut Tape, beat: usize, at_s: f64, beat_s: f64) {
    tape.kick(at_s, 0.6);
    tape.kick(at_s + 0.75 * beat_s, 0.35);
    let parts: &[f64] = if beat.is_multiple_of(2) { &[0.0, 0.5] } else { &[0.25, 0.75] };
    for part in parts {
        tape.stab(at_s + part * beat_s, 4.0 * root(beat / 4), 0.6);
    }
    for i in 0..4 {
        tape.hat(at_s + f64::from(i) * beat_s / 4.0, 0.4);
    }
    tape.bass(at_s, 0.6 * beat_s, root(beat / 4), 0.7);
}

/// A piece for piano alone: only some beats have a note, with inexact timing, in noise.
fn piano(name: &str, bpm: f64, seed: u64) -> Piece {
    let mut hand = Noise(seed);
    let beats_s = beats_of(|_| bpm, LASTS_S);
    let mut tape = Tape::new(LASTS_S, seed + 1000);
    tape.hiss(0.004);
    for (i, beat_s) in beats_s.iter().enumerate() {
        let at_s = beat_s + 0.012 * hand.normal();
        let bar = i / 4;
        if i.is_multiple_of(4) || (i % 4 == 2 && hand.even() < 0.8) {
            tape.piano(at_s, 2.0 * root(bar), 0.9);
            tape.piano(at_s + 0.004 * hand.normal(), 4.0 * root(bar), 0.6);
        }
        if hand.even() < 0.6 {
            let step = [1.0, 1.122, 1.26, 1.5, 1.682][(hand.even() * 5.0) as usize % 5];
            tape.piano(at_s, 8.0 * root(bar) * step, 0.7);
        }
        if hand.even() < 0.2 {
            tape.piano(at_s + 30.0 / bpm + 0.012 * hand.normal(), 8.0 * root(bar), 0.5);
        }
    }
    Piece { name: name.to_owned(), samples: tape.samples, beats_s }
}

/// The piece with a slow fade-in.
fn faded(mut piece: Piece) -> Piece {
    for (i, sample) in piece.samples.iter_mut().enumerate() {
        *sample *= (i as f64 / RATE_HZ / FADE_S).clamp(0.02, 1.0) as f32;
    }
    piece
}

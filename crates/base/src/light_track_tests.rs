extern crate std;

use std::vec::Vec;

use super::*;
use crate::random::split_mix;

const GREY: fn(u8) -> Rgb = |code| Rgb::new(code, code, code);

impl LightTrack<'_> {
    /// The colour that a cursor must return, found by walking all records from the start. After the end it is the last
    /// colour. An invalid repeat is skipped.
    fn at(&self, elapsed: Span) -> Rgb {
        let mut left_us = u64::try_from(elapsed.0).unwrap_or(0);
        let mut colour = self.start;
        for index in 0..self.records.len() {
            if let Some((block, times)) = self.repeated(index) {
                let once_us = duration_us(block);
                let all_us = once_us.saturating_mul(u64::from(times));
                if left_us < all_us {
                    return walked(block, colour, left_us % once_us).unwrap_or(colour);
                }
                left_us -= all_us;
                continue;
            }
            let record = &self.records[index..=index];
            if let Some(found) = walked(record, colour, left_us) {
                return found;
            }
            left_us -= duration_us(record);
            colour = self.records[index].end(colour);
        }
        colour
    }
}

/// The colour `left_us` microseconds after the beginning of `records`, which begin with `colour`; `None` after their
/// end.
fn walked(records: &[LightRecord], mut colour: Rgb, mut left_us: u64) -> Option<Rgb> {
    for &record in records {
        let whole_us = record.duration_us();
        if left_us < whole_us {
            return Some(record.within(colour, left_us as f64 / whole_us as f64));
        }
        left_us -= whole_us;
        colour = record.end(colour);
    }
    None
}

fn encoded(track: LightTrack<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    track.encode(|byte| bytes.push(byte));
    bytes
}

fn example() -> [LightRecord; 5] {
    [
        LightRecord::Line { ticks: 10, to: GREY(100) },
        LightRecord::Step { ticks: 5, to: GREY(20) },
        LightRecord::Repeat { records: 2, times: 3 },
        LightRecord::Line { ticks: 70, to: GREY(0) },
        LightRecord::Step { ticks: TICKS_MAX, to: GREY(255) },
    ]
}

#[test]
fn lines_steps_and_repeats_are_played() {
    let records = example();
    let track = LightTrack { start: GREY(0), records: &records };
    let at = |ticks: i64| track.at(TICK * ticks).r;
    assert_eq!([at(-9), at(0), at(5), at(10), at(14)], [0, 0, 50, 100, 100]);
    // Each repetition begins with the colour with which the one before it ended: 20.
    assert_eq!([at(15), at(20), at(25), at(30), at(59)], [20, 60, 100, 20, 100]);
    assert_eq!([at(60), at(95), at(130)], [20, 10, 0]);
    assert_eq!([at(129 + i64::from(TICKS_MAX)), at(130 + i64::from(TICKS_MAX))], [0, 255]);
    assert_eq!(track.duration(), TICK * (130 + i64::from(TICKS_MAX)));
}

#[test]
fn a_cursor_finds_what_the_track_says_at_any_steps() {
    let records = example();
    let track = LightTrack { start: GREY(9), records: &records };
    let end_us = 1_400_000;
    let mut state = 3;
    for step_us in [1_000, 16_000, 130_000, end_us as u64] {
        let (mut cursor, mut at_us) = (crate::LightCursor::default(), 0);
        for _ in 0..400 {
            assert_eq!(cursor.at(track, Span(at_us)), track.at(Span(at_us)), "{at_us} by {step_us}");
            let back = split_mix(&mut state).is_multiple_of(20);
            let change = (split_mix(&mut state) % step_us) as i64;
            at_us = if back { (at_us - change).max(0) } else { at_us + change };
            at_us = if at_us > end_us { 0 } else { at_us };
        }
    }
    let mut cursor = crate::LightCursor::default();
    assert_eq!(cursor.at(track, Span(i64::MAX)), GREY(255));
    assert!(cursor.is_at_end(track));
}

#[test]
fn millions_of_repeats_are_passed_at_once() {
    let records = [
        LightRecord::Step { ticks: 1, to: GREY(1) },
        LightRecord::Line { ticks: 1, to: GREY(101) },
        LightRecord::Repeat { records: 2, times: TICKS_MAX },
    ];
    let track = LightTrack { start: GREY(0), records: &records };
    let late = TICK * (2 * i64::from(TICKS_MAX) - 1) + Span(5_000);
    let mut cursor = crate::LightCursor::default();
    assert_eq!((cursor.at(track, late), track.at(late)), (GREY(51), GREY(51)));
}

#[test]
fn bytes_are_those_of_the_description() {
    let records = example();
    let bytes = encoded(LightTrack { start: Rgb::new(1, 2, 3), records: &records });
    let wanted = [
        1, 2, 3, 20, 100, 100, 100, 11, 20, 20, 20, 1, 2, 3, 0x8c, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0x7f, 255,
        255, 255,
    ];
    assert_eq!(bytes, wanted);
}

#[test]
fn every_truncation_is_refused_or_a_shorter_track() {
    let records = example();
    let bytes = encoded(LightTrack { start: GREY(7), records: &records });
    let whole = [3, 7, 11, 14, 19, 26];
    for length in 0..=bytes.len() {
        let mut room = [LightRecord::Repeat { records: 1, times: 1 }; 5];
        let read = decode_light_track(&bytes[..length], &mut room);
        assert_eq!(read.is_ok(), whole.contains(&length), "{length}: {read:?}");
    }
}

#[test]
fn wrong_bytes_are_named() {
    let read = |bytes: &[u8]| {
        let mut room = [LightRecord::Repeat { records: 1, times: 1 }; 2];
        decode_light_track(bytes, &mut room).map(|track| track.records.len())
    };
    assert_eq!(read(&[0, 0]), Err(LightTrackError::Truncated));
    assert_eq!(read(&[0, 0, 0, 0, 1, 1, 1]), Err(LightTrackError::Zero));
    assert_eq!(read(&[0, 0, 0, 0x82, 0, 1, 1, 1]), Err(LightTrackError::LongVarint));
    assert_eq!(read(&[0, 0, 0, 0x82, 0x80, 0x80, 0x80, 1]), Err(LightTrackError::LongVarint));
    assert_eq!(read(&[0, 0, 0, 1, 1, 1]), Err(LightTrackError::BadRepeat));
    assert_eq!(read(&[0, 0, 0, 4, 1, 1, 1, 1, 1, 0]), Err(LightTrackError::Zero));
    assert_eq!(read(&[0, 0, 0, 4, 1, 1, 1, 1, 1, 1, 1, 1, 1]), Err(LightTrackError::BadRepeat));
    assert_eq!(read(&[0, 0, 0, 4, 1, 1, 1, 4, 1, 1, 1, 4, 1, 1, 1]), Err(LightTrackError::TooMany));
}

#[test]
fn mutated_bytes_are_refused_or_what_encoding_writes() {
    let records = example();
    let bytes = encoded(LightTrack { start: GREY(7), records: &records });
    let (mut state, mut accepted) = (5, 0);
    for _ in 0..20_000 {
        let mut mutated = bytes.clone();
        for _ in 0..1 + split_mix(&mut state) % 3 {
            let position = split_mix(&mut state) as usize % mutated.len();
            match split_mix(&mut state) % 3 {
                0 => mutated[position] = split_mix(&mut state) as u8,
                1 => mutated.insert(position, split_mix(&mut state) as u8),
                _ => drop(mutated.remove(position)),
            }
        }
        let mut room = [LightRecord::Repeat { records: 1, times: 1 }; 30];
        let Ok(track) = decode_light_track(&mutated, &mut room) else { continue };
        assert_eq!(encoded(track), mutated);
        let end = track.duration();
        let last = track.at(end);
        assert_eq!(track.at(Span(i64::MAX)), last);
        assert_eq!((track.at(Span(i64::MIN)), track.at(Span::ZERO)), (track.start, track.start));
        accepted += 1;
    }
    assert!((2_000..19_000).contains(&accepted), "{accepted} of 20000 were accepted");
}

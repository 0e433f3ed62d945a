//! Light tracks: a robot's colour over time as records.
//!
//! A track is a start colour and records. A line leads from the colour before it to its own while its duration passes, drawn
//! in sRGB codes; a step holds the colour before it and ends with its own. A repeat runs the records before it again.

use crate::{Rgb, Span};

/// Unit of durations: 10 ms. Samples of effects are as far apart, and shows are exact to 25 ms (design).
pub const TICK: Span = Span::from_millis(10);
/// Most ticks of a record, and most repeats: as many as four bytes of a varint hold beside the bit of the kind.
pub const TICKS_MAX: u32 = (1 << 27) - 1;
/// Bytes of the start colour.
const START_BYTES: usize = 3;
/// Most bytes of a varint here: 28 bits.
const VARINT_BYTES_MAX: usize = 4;

/// A record of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LightRecord {
    /// From the colour before to another in a straight line of sRGB codes.
    Line {
        /// Duration in `TICK`s, 1 to `TICKS_MAX`.
        ticks: u32,
        /// The colour at its end.
        to: Rgb,
    },
    /// The colour before, and at the end another.
    Step {
        /// Duration in `TICK`s, 1 to `TICKS_MAX`.
        ticks: u32,
        /// The colour at its end.
        to: Rgb,
    },
    /// The records before it again. None of these is a repeat.
    Repeat {
        /// Number of records, 1 to `TICKS_MAX`.
        records: u32,
        /// How often they run again, 1 to `TICKS_MAX`.
        times: u32,
    },
}

/// What is wrong with the bytes of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightTrackError {
    /// The bytes end within the start colour or a record.
    Truncated,
    /// A varint has more than four bytes, or one that it does not need.
    LongVarint,
    /// A duration, a number of records or of repeats is 0.
    Zero,
    /// A repeat has too few records before it, or a repeat among them.
    BadRepeat,
    /// There are more records than there is room for.
    TooMany,
}

/// A track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightTrack<'a> {
    /// The colour at the start.
    pub start: Rgb,
    /// The records in order.
    pub records: &'a [LightRecord],
}

impl LightRecord {
    /// Microseconds that the record lasts; 0 for a repeat.
    pub(crate) fn duration_us(self) -> u64 {
        match self {
            Self::Line { ticks, .. } | Self::Step { ticks, .. } => u64::from(ticks) * TICK.0 as u64,
            Self::Repeat { .. } => 0,
        }
    }

    /// The colour a share of the way through the record, before its end; `before` is the colour that it began with.
    pub(crate) fn within(self, before: Rgb, share: f64) -> Rgb {
        match self {
            Self::Line { to, .. } => before.mixed(to, share),
            Self::Step { .. } | Self::Repeat { .. } => before,
        }
    }

    /// The colour at its end.
    pub(crate) fn end(self, before: Rgb) -> Rgb {
        match self {
            Self::Line { to, .. } | Self::Step { to, .. } => to,
            Self::Repeat { .. } => before,
        }
    }
}

impl LightTrack<'_> {
    /// How long the track lasts.
    pub fn duration(&self) -> Span {
        let total_us = (0..self.records.len()).fold(0u64, |sum_us, index| {
            let own_us = match self.repeated(index) {
                Some((block, times)) => duration_us(block).saturating_mul(u64::from(times)),
                None => self.records[index].duration_us(),
            };
            sum_us.saturating_add(own_us)
        });
        Span(i64::try_from(total_us).unwrap_or(i64::MAX))
    }

    /// The records that the record at `index` repeats, and how often.
    fn repeated(&self, index: usize) -> Option<(&[LightRecord], u32)> {
        let LightRecord::Repeat { records, times } = self.records[index] else { return None };
        let first = index.checked_sub(records as usize)?;
        Some((&self.records[first..index], times))
    }

    /// Writes the track as bytes: three of the start colour, then the records. A line or step is the varint of
    /// 2·ticks + kind (a step is 1) and three bytes of its colour. A repeat is the byte 1, which stands for a step of no
    /// duration, and the varints of its numbers.
    pub fn encode(&self, mut write: impl FnMut(u8)) {
        colour_bytes(self.start).into_iter().for_each(&mut write);
        for &record in self.records {
            match record {
                LightRecord::Line { ticks, to } => {
                    varint(2 * ticks, &mut write);
                    colour_bytes(to).into_iter().for_each(&mut write);
                }
                LightRecord::Step { ticks, to } => {
                    varint(2 * ticks + 1, &mut write);
                    colour_bytes(to).into_iter().for_each(&mut write);
                }
                LightRecord::Repeat { records, times } => {
                    write(1);
                    varint(records, &mut write);
                    varint(times, &mut write);
                }
            }
        }
    }
}

/// Reads a track's bytes. Records go to `room` in order.
///
/// # Errors
/// [`LightTrackError`]; `room` then holds the records before the wrong one. Bytes are either refused or exactly what
/// [`LightTrack::encode`] writes.
pub fn decode_light_track<'a>(
    bytes: &[u8],
    room: &'a mut [LightRecord],
) -> Result<LightTrack<'a>, LightTrackError> {
    let (start, mut rest) = bytes.split_first_chunk::<START_BYTES>().ok_or(LightTrackError::Truncated)?;
    let mut count = 0;
    let mut since_repeat = 0;
    while !rest.is_empty() {
        let record = read_record(&mut rest)?;
        match record {
            LightRecord::Repeat { records, .. } if records > since_repeat => {
                return Err(LightTrackError::BadRepeat);
            }
            LightRecord::Repeat { .. } => since_repeat = 0,
            _ => since_repeat += 1,
        }
        *room.get_mut(count).ok_or(LightTrackError::TooMany)? = record;
        count += 1;
    }
    Ok(LightTrack { start: colour(*start), records: &room[..count] })
}

fn read_record(rest: &mut &[u8]) -> Result<LightRecord, LightTrackError> {
    let head = read_varint(rest)?;
    if head == 1 {
        let (records, times) = (read_varint(rest)?, read_varint(rest)?);
        if records == 0 || times == 0 {
            return Err(LightTrackError::Zero);
        }
        if records > TICKS_MAX || times > TICKS_MAX {
            return Err(LightTrackError::LongVarint);
        }
        return Ok(LightRecord::Repeat { records, times });
    }
    let ticks = head / 2;
    if ticks == 0 {
        return Err(LightTrackError::Zero);
    }
    let (bytes, after) = rest.split_first_chunk::<3>().ok_or(LightTrackError::Truncated)?;
    *rest = after;
    let to = colour(*bytes);
    Ok(if head % 2 == 1 { LightRecord::Step { ticks, to } } else { LightRecord::Line { ticks, to } })
}

fn read_varint(rest: &mut &[u8]) -> Result<u32, LightTrackError> {
    let mut value = 0;
    for position in 0..VARINT_BYTES_MAX {
        let (&byte, after) = rest.split_first().ok_or(LightTrackError::Truncated)?;
        *rest = after;
        value |= u32::from(byte & 0x7f) << (7 * position);
        if byte < 0x80 {
            let is_needed = byte > 0 || position == 0;
            return if is_needed { Ok(value) } else { Err(LightTrackError::LongVarint) };
        }
    }
    Err(LightTrackError::LongVarint)
}

/// Seven bits a byte, the lowest first; the eighth says that more follow (LEB128).
fn varint(mut value: u32, write: &mut impl FnMut(u8)) {
    while value >= 0x80 {
        write(value as u8 | 0x80);
        value >>= 7;
    }
    write(value as u8);
}

fn colour_bytes(colour: Rgb) -> [u8; 3] {
    [colour.r, colour.g, colour.b]
}

fn colour([r, g, b]: [u8; 3]) -> Rgb {
    Rgb::new(r, g, b)
}

fn duration_us(records: &[LightRecord]) -> u64 {
    records.iter().fold(0, |sum_us, record| sum_us.saturating_add(record.duration_us()))
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;
    use crate::random::split_mix;

    const GREY: fn(u8) -> Rgb = |code| Rgb::new(code, code, code);

    impl LightTrack<'_> {
        /// What a cursor has to give, walked from the start: the colour some time after it. After the end, the last colour
        /// stays. A repeat that is not valid counts as none.
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

    /// The colour within records that begin with `colour`; `None` after their end.
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
        // Each repeat begins with the colour at its end: 20.
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
            1, 2, 3, 20, 100, 100, 100, 11, 20, 20, 20, 1, 2, 3, 0x8c, 1, 0, 0, 0, 0xff, 0xff, 0xff, 0x7f,
            255, 255, 255,
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
}

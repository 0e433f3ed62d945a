//! Light tracks: a robot's colour over time, as records.
//!
//! A track is a start colour and a list of records. A line fades from the colour before it to its own colour, linearly
//! in sRGB codes. A step keeps the colour before it and switches to its own colour at its end. A repeat runs the
//! records before it again.

use crate::{Rgb, Span};

/// Unit of durations: 10 ms, the interval at which effects are sampled. Lights may be wrong for 25 ms at most (design).
pub const TICK: Span = Span::from_millis(10);
/// Largest number of ticks in a record, and largest number in a repeat. A varint of four bytes has 28 bits, one of
/// which is the kind of the record.
pub const TICKS_MAX: u32 = (1 << 27) - 1;
/// Length of the start colour, bytes.
const START_BYTES: usize = 3;
/// Longest varint in a track, bytes. It holds 28 bits.
const VARINT_BYTES_MAX: usize = 4;

/// A record of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LightRecord {
    /// A fade from the colour before the record to `to`, linear in sRGB codes.
    Line {
        /// Duration in `TICK`s, 1 to `TICKS_MAX`.
        ticks: u32,
        /// The colour at its end.
        to: Rgb,
    },
    /// Keeps the colour before the record for the whole duration, then switches to `to`.
    Step {
        /// Duration in `TICK`s, 1 to `TICKS_MAX`.
        ticks: u32,
        /// The colour at its end.
        to: Rgb,
    },
    /// Runs the last `records` records before it again, `times` times. None of them is a repeat.
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
    /// A varint has more than four bytes, or a last byte that it does not need. Also if a number in a repeat is above
    /// `TICKS_MAX`.
    LongVarint,
    /// A duration, a number of records or a number of repetitions is 0.
    Zero,
    /// A repeat has fewer records before it than it repeats, or there is a repeat among them.
    BadRepeat,
    /// The buffer has no room for all records.
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
    /// Microseconds that the record itself lasts; 0 for a repeat.
    pub(crate) fn duration_us(self) -> u64 {
        match self {
            Self::Line { ticks, .. } | Self::Step { ticks, .. } => u64::from(ticks) * TICK.0 as u64,
            Self::Repeat { .. } => 0,
        }
    }

    /// The colour at `share` of the record's duration, 0 to less than 1. `before` is the colour with which the record
    /// begins.
    pub(crate) fn within(self, before: Rgb, share: f64) -> Rgb {
        match self {
            Self::Line { to, .. } => before.mixed(to, share),
            Self::Step { .. } | Self::Repeat { .. } => before,
        }
    }

    /// The colour at the record's end. `before`: the colour with which the record begins.
    pub(crate) fn end(self, before: Rgb) -> Rgb {
        match self {
            Self::Line { to, .. } | Self::Step { to, .. } => to,
            Self::Repeat { .. } => before,
        }
    }
}

impl LightTrack<'_> {
    /// Duration of the whole track, with repetitions. Saturates at the longest span.
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

    /// The records that the record at `index` repeats, and how often. `None` if it is no repeat, or repeats more
    /// records than precede it.
    fn repeated(&self, index: usize) -> Option<(&[LightRecord], u32)> {
        let LightRecord::Repeat { records, times } = self.records[index] else { return None };
        let first = index.checked_sub(records as usize)?;
        Some((&self.records[first..index], times))
    }

    /// Encodes the track: the three bytes of the start colour, then the records. A line or step is the varint of
    /// 2·ticks + kind (0 for a line, 1 for a step) and three bytes of colour. A repeat is the byte 1, as for a step of
    /// 0 ticks, then the varints of `records` and `times`. Numbers must be in their legal ranges, which is not checked.
    pub fn encode(&self, mut write: impl FnMut(u8)) {
        colour_bytes(self.start).into_iter().for_each(&mut write);
        for &record in self.records {
            match record {
                LightRecord::Line { ticks, to } => {
                    varint((2 * ticks).into(), &mut write);
                    colour_bytes(to).into_iter().for_each(&mut write);
                }
                LightRecord::Step { ticks, to } => {
                    varint((2 * ticks + 1).into(), &mut write);
                    colour_bytes(to).into_iter().for_each(&mut write);
                }
                LightRecord::Repeat { records, times } => {
                    write(1);
                    varint(records.into(), &mut write);
                    varint(times.into(), &mut write);
                }
            }
        }
    }
}

/// Decodes the bytes of a track. The records are written to `room` in order.
///
/// # Errors
/// [`LightTrackError`]; `room` then holds the records before the invalid one. Bytes that are accepted are exactly those
/// that [`LightTrack::encode`] writes for the track.
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

/// Writes a number as a varint (LEB128): seven bits per byte, the lowest first. The eighth bit of a byte says that more
/// follow.
pub fn varint(mut value: u64, write: &mut impl FnMut(u8)) {
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
#[path = "light_track_tests.rs"]
mod tests;

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

//! `LIGHT`: a stretch of a robot's light, sent ahead of time. `R55` is a rule of docs/protocol.md.

use core::fmt::{self, Write};

use lightbots_base::{Instant, LightRecord, LightTrack, Rgb, Span, decode_light_track};

use crate::base64_text::{Base64Writer, decode};
use crate::fields::Fields;
use crate::number::{instant, span, write_digits};
use crate::text_buffer::TextBuffer;

/// Largest number of records of a stretch of light (R55). A `LIGHT` with more is invalid. With a larger value, each
/// robot needs more memory.
pub const MAX_LIGHT_RECORDS: usize = 192;
/// Largest number of bytes of a track: the start colour, and for each record four bytes of duration and three of
/// colour.
const MAX_TRACK_BYTES: usize = 3 + 7 * MAX_LIGHT_RECORDS;

/// The records of a stretch of light.
pub type LightRecords = heapless::Vec<LightRecord, MAX_LIGHT_RECORDS>;

/// The moment from which the time of a stretch of light counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum LightAnchor {
    /// `S12`: the START of the route with this number. The time of the stretch is then the path time of that route.
    Start(u32),
    /// `A9000000`: this moment of the show clock, microseconds. The time of the stretch stands during later holds.
    Moment(Instant),
    /// `F9000000`: this moment of the show clock, microseconds. The time of the stretch goes on during holds.
    Free(Instant),
}

/// A stretch of light: `LIGHT n anchor skip over track`.
#[derive(Clone, Debug, PartialEq)]
pub struct LightStretch {
    /// Number chosen by the controller, never 0; a robot repeats it in its reports.
    pub number: u32,
    /// Moment from which the time of the stretch counts.
    pub anchor: LightAnchor,
    /// Time of the stretch at which its track begins, counted from the anchor.
    pub skip: Span,
    /// How long the light blends from the colour that was shown before to the colours of the track, counted from the
    /// beginning of the track.
    pub over: Span,
    /// Colour at the beginning of the track.
    pub start: Rgb,
    /// Records of the track in order.
    pub records: LightRecords,
}

impl LightStretch {
    /// Returns the colours of the stretch over the time since its track began.
    pub fn track(&self) -> LightTrack<'_> {
        LightTrack { start: self.start, records: &self.records }
    }
}

pub(crate) fn encode_light(stretch: &LightStretch, out: &mut TextBuffer<'_>) -> fmt::Result {
    out.write_str("LIGHT ")?;
    write_digits(out, u64::from(stretch.number), 1)?;
    let (letter, from) = match stretch.anchor {
        LightAnchor::Start(seq) => (" S", u64::from(seq)),
        LightAnchor::Moment(at) => (" A", at.0),
        LightAnchor::Free(at) => (" F", at.0),
    };
    out.write_str(letter)?;
    write_digits(out, from, 1)?;
    for time in [stretch.skip, stretch.over] {
        out.write_str(" ")?;
        write_digits(out, time.0.max(0).unsigned_abs(), 1)?;
    }
    out.write_str(" ")?;
    let mut writer = Base64Writer::new(out);
    stretch.track().encode(|byte| writer.push(byte));
    writer.finish()
}

pub(crate) fn decode_light(fields: &mut Fields<'_>) -> Option<LightStretch> {
    let number = fields.next().and_then(|field| field.parse().ok()).filter(|&number| number != 0);
    let anchor = fields.next().and_then(anchor);
    let skip = fields.next().and_then(span);
    let over = fields.next().and_then(span);
    let text = fields.next()?;
    let mut bytes = [0; MAX_TRACK_BYTES];
    let bytes = decode(text, &mut bytes)?;
    let mut records = LightRecords::new();
    // Cannot fail: this is the capacity of the vector.
    let _ = records.resize(MAX_LIGHT_RECORDS, LightRecord::Repeat { records: 1, times: 1 });
    let track = decode_light_track(bytes, &mut records).ok()?;
    let (start, count) = (track.start, track.records.len());
    records.truncate(count);
    Some(LightStretch { number: number?, anchor: anchor?, skip: skip?, over: over?, start, records })
}

fn anchor(field: &str) -> Option<LightAnchor> {
    let (letter, from) = field.split_at_checked(1)?;
    match letter {
        "S" => from.parse().ok().filter(|&seq| seq != 0).map(LightAnchor::Start),
        "A" => instant(from).map(LightAnchor::Moment),
        "F" => instant(from).map(LightAnchor::Free),
        _ => None,
    }
}

//! `LIVE` and `RELEASE`: colours from a lighting desk or another program, for many robots in one message (R60, R61 of
//! docs/protocol.md).

use core::fmt::{self, Write};

use lightbots_base::Rgb;

use crate::base64_text::{Base64Writer, decode};
use crate::fields::Fields;
use crate::number::write_digits;
use crate::text_buffer::TextBuffer;

/// Largest number of colours in one `LIVE` (R60): the robots of one universe of DMX512, whose 512 channels hold 170
/// colours.
pub const MAX_LIVE_COLOURS: usize = 170;
/// Bytes of a colour: R, G, B.
const COLOUR_BYTES: usize = 3;

/// `LIVE n first colours`: colours for robots in consecutive slots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LiveColours {
    /// Number of the moment of live light, never 0. Messages of one moment have the same number (R60). Numbers rise,
    /// and wrap around after the largest one.
    pub number: u32,
    /// Slot of the first colour.
    pub first: u16,
    /// Colours for the slots from `first` on, in order; at least one.
    pub colours: heapless::Vec<Rgb, MAX_LIVE_COLOURS>,
}

impl LiveColours {
    /// Returns the colour for the robot in a slot. `None` if the message has no colour for that slot.
    pub fn of(&self, slot: u16) -> Option<Rgb> {
        self.colours.get(usize::from(slot.checked_sub(self.first)?)).copied()
    }
}

/// `RELEASE n first count`: robots in consecutive slots show their own light again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LiveRelease {
    /// Number of the moment, from the same sequence as [`LiveColours::number`].
    pub number: u32,
    /// The first slot.
    pub first: u16,
    /// Number of slots, at least one.
    pub count: u16,
}

impl LiveRelease {
    /// Whether the release applies to the robot in a slot.
    pub fn covers(&self, slot: u16) -> bool {
        slot.checked_sub(self.first).is_some_and(|place| place < self.count)
    }
}

pub(crate) fn encode_live(live: &LiveColours, out: &mut TextBuffer<'_>) -> fmt::Result {
    out.write_str("LIVE ")?;
    write_digits(out, u64::from(live.number), 1)?;
    out.write_str(" ")?;
    write_digits(out, u64::from(live.first), 1)?;
    out.write_str(" ")?;
    let mut writer = Base64Writer::new(out);
    for colour in &live.colours {
        [colour.r, colour.g, colour.b].into_iter().for_each(|byte| writer.push(byte));
    }
    writer.finish()
}

pub(crate) fn decode_live(fields: &mut Fields<'_>) -> Option<LiveColours> {
    let (number, first) = (live_number(fields)?, slot(fields)?);
    let mut bytes = [0; COLOUR_BYTES * MAX_LIVE_COLOURS];
    let bytes = decode(fields.next()?, &mut bytes)?;
    if bytes.is_empty() || !bytes.len().is_multiple_of(COLOUR_BYTES) {
        return None;
    }
    let colours = bytes.chunks_exact(COLOUR_BYTES).map(|bytes| Rgb::new(bytes[0], bytes[1], bytes[2]));
    Some(LiveColours { number, first, colours: colours.collect() })
}

pub(crate) fn decode_release(fields: &mut Fields<'_>) -> Option<LiveRelease> {
    let (number, first) = (live_number(fields)?, slot(fields)?);
    let count = slot(fields).filter(|&count| count != 0)?;
    Some(LiveRelease { number, first, count })
}

/// Reads a slot: the number by which messages of live light address a robot (R59).
pub(crate) fn slot(fields: &mut Fields<'_>) -> Option<u16> {
    fields.next()?.parse().ok()
}

fn live_number(fields: &mut Fields<'_>) -> Option<u32> {
    fields.next()?.parse().ok().filter(|&number| number != 0)
}

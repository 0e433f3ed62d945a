//! Reads and writes reports and time questions as bytes. `R4` and the like are rules of docs/protocol.md.

use core::fmt::{self, Write};

use lightbots_base::{RobotId, Vec2};

use crate::fields::{Fields, cut};
use crate::number::{DOUBLE_MAX, instant, number, write_digits, write_double, write_int};
use crate::text_buffer::TextBuffer;
use crate::{Abilities, Blocked, Details, Firmware, Report, RobotState, TimeQuestion};

/// Longest report or time question that a controller reads, bytes (R4).
const MAX_REPORT: usize = 1024;

impl Report {
    /// Reads a report: a name and two numbers, then fields `key=value`. `None` if the name or a number is missing or
    /// invalid, or if the payload is not UTF-8 or longer than 1,024 bytes. A field with an invalid value counts as not
    /// sent. Unknown fields are skipped.
    pub fn decode(payload: &[u8]) -> Option<Self> {
        let mut fields = Fields::new(text(payload)?);
        let id = RobotId::new(fields.next()?)?;
        let at = Vec2::new(number(fields.next()?)?, number(fields.next()?)?);
        let mut details = None;
        for field in fields {
            if let (key, Some(value)) = cut(field, b'=') {
                read_detail(&mut details, key, value);
            }
        }
        let is_place = at.x.abs() <= DOUBLE_MAX && at.y.abs() <= DOUBLE_MAX;
        Some(Self { id, at: is_place.then_some(at), details })
    }

    /// Appends the report: `<uuid> <x> <y>` and the details, if there are any.
    pub fn encode(&self, out: &mut dyn Write) -> fmt::Result {
        let at = self.at.unwrap_or(Vec2::new(f64::NAN, f64::NAN));
        let mut buffer = TextBuffer::new(out);
        buffer.bytes(self.id.as_bytes())?;
        buffer.write_str(" ")?;
        write_double(&mut buffer, at.x)?;
        buffer.write_str(" ")?;
        write_double(&mut buffer, at.y)?;
        self.details.as_ref().map_or(Ok(()), |details| write_details(details, &mut buffer))?;
        buffer.finish()
    }
}

impl TimeQuestion {
    /// Reads a question; `None` if the name or the moment is missing or invalid. Fields after these two are ignored.
    pub fn decode(payload: &[u8]) -> Option<Self> {
        let mut fields = Fields::new(text(payload)?);
        Some(Self { id: RobotId::new(fields.next()?)?, asked: instant(fields.next()?)? })
    }

    /// Appends `<uuid> <now>`.
    pub fn encode(&self, out: &mut dyn Write) -> fmt::Result {
        let mut buffer = TextBuffer::new(out);
        buffer.bytes(self.id.as_bytes())?;
        buffer.write_str(" ")?;
        write_digits(&mut buffer, self.asked.0.min(i64::MAX.unsigned_abs()), 1)?;
        buffer.finish()
    }
}

impl RobotState {
    /// Each state and its word on the wire (R12).
    const WORDS: [(Self, &'static str); 7] = [
        (Self::Idle, "idle"),
        (Self::Ready, "ready"),
        (Self::Driving, "driving"),
        (Self::Held, "held"),
        (Self::Lost, "lost"),
        (Self::Cut, "cut"),
        (Self::Faulty, "faulty"),
    ];

    /// Returns the word of the state on the wire.
    pub fn word(self) -> &'static str {
        Self::WORDS.iter().find(|(state, _)| *state == self).map_or("idle", |(_, word)| word)
    }

    /// Returns the state that has this word; `None` if no state has it.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::WORDS.iter().find(|(_, known)| *known == word).map(|(state, _)| *state)
    }
}

fn text(payload: &[u8]) -> Option<&str> {
    core::str::from_utf8(payload.get(..payload.len().min(MAX_REPORT + 1))?)
        .ok()
        .filter(|text| text.len() <= MAX_REPORT)
}

/// Stores one `key=value` field. A known key creates the details if there are none, even if the value is invalid. Of
/// two fields with one key, the later one counts.
fn read_detail(details: &mut Option<Details>, key: &str, value: &str) {
    match key {
        "h" => known(details).heading = finite(value),
        "bat" => known(details).battery = value.parse().ok().filter(|&percent| percent <= 100),
        "state" => known(details).state = RobotState::from_word(value).unwrap_or_default(),
        "route" => known(details).route = value.parse().unwrap_or(0),
        "light" => known(details).light = value.parse().unwrap_or(0),
        "slot" => known(details).slot = value.parse().ok(),
        "starts" => known(details).starts = instant(value),
        "off" => known(details).off_m = finite(value).filter(|&off| off >= 0.0),
        "err" => known(details).err_m = finite(value).filter(|&err| err >= 0.0),
        "clock" => known(details).clock_us = value.parse().ok(),
        "fw" => known(details).firmware = firmware(value),
        "can" => known(details).abilities = Abilities::from_words(value),
        "unknown" => known(details).unknown = value.parse().unwrap_or(0),
        "blocked" => known(details).blocked = blocked(value),
        "sim" => known(details).simulated = value == "1",
        "brakes" => known(details).brakes = value.parse().unwrap_or(0),
        "near" => known(details).near_m = finite(value).filter(|&near| near >= 0.0),
        _ => {}
    }
}

fn known(details: &mut Option<Details>) -> &mut Details {
    details.get_or_insert_default()
}

fn finite(value: &str) -> Option<f64> {
    number(value).filter(|value| value.abs() <= DOUBLE_MAX)
}

/// Reads `gap@towards`; `None` if a number is invalid or the gap is negative.
fn blocked(value: &str) -> Option<Blocked> {
    let (gap, towards) = value.split_once('@')?;
    let gap_m = finite(gap).filter(|&gap| gap >= 0.0)?;
    Some(Blocked { gap_m, towards: finite(towards)? })
}

fn firmware(value: &str) -> Firmware {
    let mut name = Firmware::new();
    if value.bytes().all(|byte| byte.is_ascii_graphic()) {
        // A name that does not fit is dropped: the failed push leaves it empty.
        let _ = name.push_str(value);
    }
    name
}

fn write_details(details: &Details, out: &mut TextBuffer<'_>) -> fmt::Result {
    out.write_str(" state=")?;
    out.write_str(details.state.word())?;
    if let Some(heading) = details.heading {
        out.write_str(" h=")?;
        write_double(out, heading)?;
    }
    if let Some(off_m) = details.off_m {
        out.write_str(" off=")?;
        write_double(out, off_m)?;
    }
    let whole = [
        (" route=", Some(u64::from(details.route)).filter(|&seq| seq != 0)),
        (" starts=", details.starts.map(|at| at.0)),
        (" clock=", details.clock_us.map(u64::from)),
        (" bat=", details.battery.map(u64::from)),
        (" light=", Some(u64::from(details.light)).filter(|&number| number != 0)),
        (" slot=", details.slot.map(u64::from)),
        (" unknown=", Some(u64::from(details.unknown)).filter(|&count| count != 0)),
    ];
    for (key, value) in whole.into_iter().filter_map(|(key, value)| Some((key, value?))) {
        out.write_str(key)?;
        write_int(out, i64::try_from(value).unwrap_or(i64::MAX))?;
    }
    if details.abilities != Abilities::default() {
        out.write_str(" can=")?;
        details.abilities.write(out)?;
    }
    if !details.firmware.is_empty() && details.firmware.bytes().all(|byte| byte.is_ascii_graphic()) {
        out.write_str(" fw=")?;
        out.write_str(&details.firmware)?;
    }
    if let Some(err_m) = details.err_m {
        out.write_str(" err=")?;
        write_double(out, err_m)?;
    }
    if let Some(blocked) = details.blocked {
        out.write_str(" blocked=")?;
        write_double(out, blocked.gap_m)?;
        out.write_str("@")?;
        write_double(out, blocked.towards)?;
    }
    if details.simulated {
        out.write_str(" sim=1")?;
    }
    if details.brakes != 0 {
        out.write_str(" brakes=")?;
        write_int(out, i64::from(details.brakes))?;
    }
    if let Some(near_m) = details.near_m {
        out.write_str(" near=")?;
        write_double(out, near_m)?;
    }
    Ok(())
}

impl Abilities {
    /// All abilities. Their words are read and written as one text, because nearly all reports hold all of them.
    pub const ALL: Self =
        Self { route: true, fade: true, blink: true, room: true, neighbours: true, light: true, live: true };
    /// `ALL` on the wire.
    const ALL_WORDS: &'static str = "route+fade+blink+room+neighbours+light+live";

    /// Reads words joined by `+`; unknown words are skipped.
    fn from_words(words: &str) -> Self {
        if words == Self::ALL_WORDS {
            return Self::ALL;
        }
        let mut abilities = Self::default();
        for word in words.as_bytes().split(|&byte| byte == b'+') {
            match word {
                b"route" => abilities.route = true,
                b"fade" => abilities.fade = true,
                b"blink" => abilities.blink = true,
                b"room" => abilities.room = true,
                b"neighbours" => abilities.neighbours = true,
                b"light" => abilities.light = true,
                b"live" => abilities.live = true,
                _ => {}
            }
        }
        abilities
    }

    fn write(self, out: &mut TextBuffer<'_>) -> fmt::Result {
        if self == Self::ALL {
            return out.write_str(Self::ALL_WORDS);
        }
        let mut joint = "";
        let words = [
            (self.route, "route"),
            (self.fade, "fade"),
            (self.blink, "blink"),
            (self.room, "room"),
            (self.neighbours, "neighbours"),
            (self.light, "light"),
            (self.live, "live"),
        ];
        for (has, word) in words {
            if has {
                out.write_str(joint)?;
                out.write_str(word)?;
                joint = "+";
            }
        }
        Ok(())
    }
}

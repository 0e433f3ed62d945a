//! Reads commands from bytes. `R4` and the like are rules of docs/protocol.md.

use lightbots_base::{Instant, Rgb, Span, Vec2};

use crate::fields::{Fields, cut};
use crate::light::decode_light;
use crate::live::{decode_live, decode_release, slot};
use crate::number::{instant, number, span};
use crate::path::decode_route;
use crate::{Blink, Command, Fade, TimeAnswer};

/// Longest payload that a robot reads, bytes (R4). A route of [`crate::MAX_PIECES`] curves needs about half of these
/// bytes. With a larger value, a payload keeps a small board busy for longer.
pub const MAX_PAYLOAD: usize = 16 * 1024;

/// Longest duration of a `BLINK` (R24); a longer one is shortened.
const LONGEST_BLINK: Span = Span::from_millis(60_000);

/// Why a part of a payload, or all of it, is not a command. A robot ignores and counts it (R7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// The first word is not a known command.
    Word,
    /// The command is known, but its fields are missing, out of range or otherwise invalid.
    Fields,
    /// The payload is not UTF-8; all of it is dropped.
    NotText,
    /// The payload is longer than [`MAX_PAYLOAD`]; all of it is dropped.
    TooLong,
}

/// Iterator over the commands of a payload. Each command is decoded when the caller requests it.
#[derive(Clone, Debug)]
pub struct Commands<'a> {
    /// Text that is not read yet.
    rest: Option<&'a str>,
    refused: Option<Unknown>,
}

/// Returns the commands of a payload in order. They are the parts between `|`; empty parts are skipped. An invalid part
/// is an error, and the parts after it are still read. A payload that is not UTF-8 or too long gives a single error.
pub fn commands(payload: &[u8]) -> Commands<'_> {
    let read = match payload.len() {
        0..=MAX_PAYLOAD => core::str::from_utf8(payload).map_err(|_| Unknown::NotText),
        _ => Err(Unknown::TooLong),
    };
    Commands { rest: read.ok(), refused: read.err() }
}

impl Iterator for Commands<'_> {
    type Item = Result<Command, Unknown>;

    fn next(&mut self) -> Option<Self::Item> {
        if let Some(why) = self.refused.take() {
            return Some(Err(why));
        }
        loop {
            let (part, rest) = cut(self.rest?, b'|');
            self.rest = rest;
            let mut fields = Fields::new(part);
            if let Some(word) = fields.next() {
                return decode(word, &mut fields);
            }
        }
    }
}

/// Decodes one command from its first word and the fields after it. Surplus fields are ignored, because later versions
/// of the protocol may add some.
// Each arm builds the whole result in place: a command has room for a route, and another move would copy all of it,
// even for a `HOLD`.
fn decode(word: &str, fields: &mut Fields<'_>) -> Option<Result<Command, Unknown>> {
    match word {
        "TARGET" => made(target(fields), Command::Target),
        "COLOR" => made(colour(fields), Command::Color),
        "UUID" => Some(Ok(Command::Uuid)),
        "PATH" => made(decode_route(fields).ok_or(Unknown::Fields), Command::Route),
        "START" => made(start(fields), |(seq, at)| Command::Start { seq, at }),
        "HOLD" => made(moment(fields), |at| Command::Hold { at }),
        "RESUME" => made(moment(fields), |at| Command::Resume { at }),
        // A robot stops whatever follows the word: an invalid moment makes it `STOP` at once.
        "STOP" => Some(Ok(moment(fields).map_or(Command::Stop, |at| Command::StopFrom { at }))),
        "TIME" => made(time(fields), Command::Time),
        "FADE" => made(fade(fields), Command::Fade),
        "BLINK" => made(duration(fields), |over| Command::Blink(Blink { over: over.min(LONGEST_BLINK) })),
        "LIGHT" => made(decode_light(fields).ok_or(Unknown::Fields), Command::Light),
        "SLOT" => made(slot(fields).ok_or(Unknown::Fields), Command::Slot),
        "LIVE" => made(decode_live(fields).ok_or(Unknown::Fields), Command::Live),
        "RELEASE" => made(decode_release(fields).ok_or(Unknown::Fields), Command::Release),
        "STATUS" => Some(Ok(Command::Status)),
        _ => Some(Err(Unknown::Word)),
    }
}

/// Converts a decoded value to its command, and keeps an error. Always returns `Some`, because that is the type of the
/// iterator's items.
#[inline(always)]
fn made<T>(read: Result<T, Unknown>, command: impl Fn(T) -> Command) -> Option<Result<Command, Unknown>> {
    match read {
        Ok(value) => Some(Ok(command(value))),
        Err(why) => Some(Err(why)),
    }
}

fn target(fields: &mut Fields<'_>) -> Result<Vec2, Unknown> {
    let mut next = || fields.next().and_then(number).ok_or(Unknown::Fields);
    Ok(Vec2::new(next()?, next()?))
}

fn start(fields: &mut Fields<'_>) -> Result<(u32, Instant), Unknown> {
    let seq = fields.next().and_then(|field| field.parse().ok()).filter(|&seq| seq != 0);
    Ok((seq.ok_or(Unknown::Fields)?, moment(fields)?))
}

fn time(fields: &mut Fields<'_>) -> Result<TimeAnswer, Unknown> {
    let answer = TimeAnswer { asked: moment(fields)?, received: moment(fields)?, sent: moment(fields)? };
    if answer.received <= answer.sent { Ok(answer) } else { Err(Unknown::Fields) }
}

fn fade(fields: &mut Fields<'_>) -> Result<Fade, Unknown> {
    Ok(Fade { to: colour(fields)?, at: moment(fields)?, over: duration(fields)? })
}

fn colour(fields: &mut Fields<'_>) -> Result<Rgb, Unknown> {
    let number = fields.next().and_then(|field| field.parse().ok());
    number.and_then(Rgb::from_number).ok_or(Unknown::Fields)
}

fn moment(fields: &mut Fields<'_>) -> Result<Instant, Unknown> {
    fields.next().and_then(instant).ok_or(Unknown::Fields)
}

fn duration(fields: &mut Fields<'_>) -> Result<Span, Unknown> {
    fields.next().and_then(span).ok_or(Unknown::Fields)
}

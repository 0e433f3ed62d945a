//! Bytes → commands.

use core::str::{Split, SplitAsciiWhitespace};

use lightbots_base::{Rgb, Span, Vec2};

use crate::number::{instant, number, span};
use crate::path::decode_route;
use crate::{Blink, Command, Fade, TimeAnswer};

/// The most bytes of a payload that are read. A route of [`crate::MAX_PIECES`] curves needs half of it.
pub const MAX_PAYLOAD: usize = 16 * 1024;

/// The longest a robot blinks: a minute.
const LONGEST_BLINK: Span = Span::from_millis(60_000);

/// Why a part of a payload is no command. It is counted and dropped, nothing else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// Its first word is none we know.
    Word,
    /// We know the word; its fields are missing, out of range or no numbers.
    Fields,
    /// The payload is not UTF-8. Nothing of it was read.
    NotText,
    /// The payload is longer than [`MAX_PAYLOAD`]. Nothing of it was read.
    TooLong,
}

/// The commands of a payload, decoded one by one as they are asked for.
#[derive(Clone, Debug)]
pub struct Commands<'a> {
    parts: Split<'a, char>,
    refused: Option<Unknown>,
}

/// The commands of a payload, in order: parts between `|`, empty ones skipped.
pub fn commands(payload: &[u8]) -> Commands<'_> {
    let read = match payload.len() {
        0..=MAX_PAYLOAD => core::str::from_utf8(payload).map_err(|_| Unknown::NotText),
        _ => Err(Unknown::TooLong),
    };
    Commands { parts: read.unwrap_or("").split('|'), refused: read.err() }
}

impl Iterator for Commands<'_> {
    type Item = Result<Command, Unknown>;

    fn next(&mut self) -> Option<Self::Item> {
        if let Some(why) = self.refused.take() {
            return Some(Err(why));
        }
        self.parts.find_map(|part| {
            let mut fields = part.split_ascii_whitespace();
            let word = fields.next()?;
            Some(decode(word, &mut fields))
        })
    }
}

/// One command from its word and the fields after it. Fields beyond those we know are left alone, so that later
/// versions may add some.
fn decode(word: &str, fields: &mut SplitAsciiWhitespace<'_>) -> Result<Command, Unknown> {
    let command = match word {
        "TARGET" => target(fields),
        "COLOR" => colour(fields).map(Command::Color),
        "UUID" => Some(Command::Uuid),
        "PATH" => decode_route(fields).map(Command::Route),
        "START" => start(fields),
        "HOLD" => fields.next().and_then(instant).map(|at| Command::Hold { at }),
        "RESUME" => fields.next().and_then(instant).map(|at| Command::Resume { at }),
        "STOP" => Some(Command::Stop),
        "TIME" => time(fields),
        "FADE" => fade(fields),
        "BLINK" => {
            fields.next().and_then(span).map(|over| Command::Blink(Blink { over: over.min(LONGEST_BLINK) }))
        }
        "STATUS" => Some(Command::Status),
        _ => return Err(Unknown::Word),
    };
    command.ok_or(Unknown::Fields)
}

fn target(fields: &mut SplitAsciiWhitespace<'_>) -> Option<Command> {
    let (x, y) = (number(fields.next()?)?, number(fields.next()?)?);
    Some(Command::Target(Vec2::new(x, y)))
}

fn colour(fields: &mut SplitAsciiWhitespace<'_>) -> Option<Rgb> {
    Rgb::from_number(fields.next()?.parse().ok()?)
}

fn start(fields: &mut SplitAsciiWhitespace<'_>) -> Option<Command> {
    let seq = fields.next()?.parse().ok().filter(|&seq| seq != 0)?;
    Some(Command::Start { seq, at: instant(fields.next()?)? })
}

fn time(fields: &mut SplitAsciiWhitespace<'_>) -> Option<Command> {
    let mut next = || fields.next().and_then(instant);
    let answer = TimeAnswer { asked: next()?, received: next()?, sent: next()? };
    (answer.received <= answer.sent).then_some(Command::Time(answer))
}

fn fade(fields: &mut SplitAsciiWhitespace<'_>) -> Option<Command> {
    Some(Command::Fade(Fade {
        to: colour(fields)?,
        at: instant(fields.next()?)?,
        over: span(fields.next()?)?,
    }))
}

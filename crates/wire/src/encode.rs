//! Writes commands as text.

use core::fmt::{self, Write};

use crate::Command;
use crate::light::encode_light;
use crate::live::encode_live;
use crate::number::{write_int, write_six_decimals};
use crate::path::encode_route;
use crate::text_buffer::TextBuffer;

/// Appends one command between bars, as the original program writes it: `|TARGET 0.500000 -1.250000|`. Several calls
/// with the same `out` build one payload.
pub fn encode(command: &Command, out: &mut dyn Write) -> fmt::Result {
    let mut buffer = TextBuffer::new(out);
    write(command, &mut buffer)?;
    buffer.finish()
}

fn write(command: &Command, out: &mut TextBuffer<'_>) -> fmt::Result {
    out.write_str("|")?;
    match command {
        Command::Target(at) => {
            out.write_str("TARGET ")?;
            write_six_decimals(out, at.x)?;
            out.write_str(" ")?;
            write_six_decimals(out, at.y)?;
        }
        Command::Color(colour) => words(out, "COLOR", &[u64::from(colour.number())])?,
        Command::Uuid => out.write_str("UUID")?,
        Command::Route(route) => encode_route(route, out)?,
        Command::Start { seq, at } => words(out, "START", &[u64::from(*seq), at.0])?,
        Command::Hold { at } => words(out, "HOLD", &[at.0])?,
        Command::Resume { at } => words(out, "RESUME", &[at.0])?,
        Command::Stop => out.write_str("STOP")?,
        Command::StopFrom { at } => words(out, "STOP", &[at.0])?,
        Command::Time(answer) => words(out, "TIME", &[answer.asked.0, answer.received.0, answer.sent.0])?,
        Command::Fade(fade) => {
            words(out, "FADE", &[u64::from(fade.to.number()), fade.at.0, not_negative(fade.over.0)])?
        }
        Command::Blink(blink) => words(out, "BLINK", &[not_negative(blink.over.0)])?,
        Command::Light(stretch) => encode_light(stretch, out)?,
        Command::Slot(slot) => words(out, "SLOT", &[u64::from(*slot)])?,
        Command::Live(live) => encode_live(live, out)?,
        Command::Release(release) => {
            let numbers = [u64::from(release.number), release.first.into(), release.count.into()];
            words(out, "RELEASE", &numbers)?;
        }
        Command::Status => out.write_str("STATUS")?,
    }
    out.write_str("|")
}

fn words(out: &mut TextBuffer<'_>, word: &str, numbers: &[u64]) -> fmt::Result {
    out.write_str(word)?;
    for &number in numbers {
        out.write_str(" ")?;
        write_int(out, i64::try_from(number).unwrap_or(i64::MAX))?;
    }
    Ok(())
}

fn not_negative(us: i64) -> u64 {
    us.max(0).unsigned_abs()
}

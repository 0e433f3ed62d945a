//! All example shows and their files.

mod color;
mod countdown;
mod dancers;
mod draw;
mod fireworks;
mod galaxy;
mod glyph;
mod heart;
mod hello;
mod march;
mod rings;
mod sea;
mod stroke;
mod thousand;
mod timeline;
mod voyage;
mod words;

use lightbots_exchange::{ARCHIVE, Format, LIGHTBOTS, ORIGINAL};
use lightbots_show::Show;

/// An example show and its file.
pub struct Entry {
    /// File name in the folder `shows`.
    pub file: &'static str,
    /// The format of the file.
    pub format: &'static Format,
    /// The show.
    pub show: Show,
}

impl Entry {
    /// The bytes of its file.
    pub fn bytes(&self) -> Vec<u8> {
        self.format.write(&self.show, None).bytes
    }
}

/// Every example show.
pub fn all() -> Vec<Entry> {
    let original = |file, show| Entry { file, format: &ORIGINAL, show };
    let ours = |file, show| Entry { file, format: &LIGHTBOTS, show };
    vec![
        original("hello.json", hello::show()),
        original("countdown.json", countdown::show()),
        ours("heart.lightbots.json", heart::show()),
        ours("rings.lightbots.json", rings::show()),
        ours("galaxy.lightbots.json", galaxy::show()),
        ours("fireworks.lightbots.json", fireworks::show()),
        ours("dancers.lightbots.json", dancers::show()),
        ours("words.lightbots.json", words::show()),
        Entry { file: "march.lightbots.zip", format: &ARCHIVE, show: march::show() },
        ours("voyage.lightbots.json", voyage::show()),
        ours("sea.lightbots.json", sea::show()),
        ours("thousand.lightbots.json", thousand::show()),
    ]
}

//! Turns words into drawings: fonts, letters and lines. A text is one drawing, or one for each word or scrolling step.
//!
//! The height of capitals is 1, y points up, and the baseline of the first line is 0.

mod accents;
mod clip;
mod curve;
mod fit;
mod font;
mod layout;
mod letter;
mod lines;
mod outline;
mod pages;
mod region;
mod runs;
mod settings;
mod shape;
mod spine;
mod strokes;
mod wrap;

#[cfg(test)]
mod tests;

pub(crate) use font::outline_files;
pub use font::{FONTS, Font, FontInfo};
pub use layout::draw;
pub use pages::{Page, STEPS_MAX, per_word, scrolling};
pub use settings::{Align, CHARACTERS_MAX, Colors, TextSettings};

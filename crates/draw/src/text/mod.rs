//! Turns words into drawings: fonts, letters and lines. A text becomes one drawing, or a drawing for each word, or a
//! drawing for each step of scrolling.
//!
//! Unit of length: the height of capitals (cap height). y points up, and the baseline of the first line is at 0.

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

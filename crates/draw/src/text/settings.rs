//! Settings for drawing words.

use lightbots_base::Rgb;

use super::font::Font;

/// Largest number of characters of a text. The time for shaping grows faster than the length.
pub const CHARACTERS_MAX: usize = 2_000;

/// Words and how they are drawn.
#[derive(Clone)]
pub struct TextSettings<'a> {
    /// The words. A line break begins a new line.
    pub words: &'a str,
    /// The font. Signs that it lacks are taken from built-in fonts.
    pub font: &'a Font,
    /// How lines that are shorter than the longest line are aligned with it.
    pub align: Align,
    /// Ratio of width to height of a rectangle that the text should fill: lines are broken between words for it.
    /// `None`: lines break only where `words` has line breaks.
    pub wrap: Option<f64>,
    /// Extra distance between letters, in cap heights; -0.5 to 5. Negative: closer together.
    pub letter_gap: f64,
    /// Free height between two lines, in cap heights; 0 to 5.
    pub line_gap: f64,
    /// Colours of the letters.
    pub colors: Colors,
}

/// How lines that are shorter than the longest line are aligned with it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Align {
    /// At the left edge.
    Left,
    /// In the middle.
    #[default]
    Centre,
    /// At the right edge.
    Right,
}

/// Colours of the letters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Colors {
    /// One colour for all letters.
    One(Rgb),
    /// The colours in turn, one for each letter in the order of the text. After the last colour, the first follows
    /// again. If empty, all letters are white.
    Each(Vec<Rgb>),
    /// From red over green and blue to magenta, in the order of the text.
    Rainbow,
}

impl<'a> TextSettings<'a> {
    /// Returns settings for white words, centred, without wrapping.
    pub fn new(words: &'a str, font: &'a Font) -> Self {
        Self {
            words,
            font,
            align: Align::Centre,
            wrap: None,
            letter_gap: 0.0,
            line_gap: 0.4,
            colors: Colors::One(Rgb::new(255, 255, 255)),
        }
    }
}

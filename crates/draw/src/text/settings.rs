//! What is drawn, and how.

use lightbots_base::Rgb;

use super::font::Font;

/// Most characters of a text, from the input table of the issue on drawing: shaping takes longer than linear time.
pub const CHARACTERS_MAX: usize = 2_000;

/// Words and how they are drawn.
#[derive(Clone)]
pub struct TextSettings<'a> {
    /// The words. A line break begins a new line.
    pub words: &'a str,
    /// The font. Signs that it lacks come from the fonts inside.
    pub font: &'a Font,
    /// Where short lines stand.
    pub align: Align,
    /// Ratio of width to height that line breaks between words should fill; `None`: no lines but those of the words.
    pub wrap: Option<f64>,
    /// Extra distance between letters, in cap heights; -0.5 to 5.
    pub letter_gap: f64,
    /// Free height between two lines, in cap heights; 0 to 5.
    pub line_gap: f64,
    /// Colours of the letters.
    pub colors: Colors,
}

/// Where lines stand that are shorter than the longest one.
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
    /// One for all.
    One(Rgb),
    /// One after the other, in the order of the text, from the beginning again at their end. Empty: white.
    Each(Vec<Rgb>),
    /// From red over green and blue to magenta, in the order of the text.
    Rainbow,
}

impl<'a> TextSettings<'a> {
    /// White words in the middle, without wrapping.
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

//! Splits a line of text into runs, from left to right. Each run has one writing direction and one font.

use std::ops::Range;

use unicode_bidi::BidiInfo;
use unicode_normalization::char::is_combining_mark;

use super::font::{Face, Font, stand_ins};

/// A part of a line with one writing direction and one font.
pub(super) struct FontRun<'a> {
    /// Range of the run in the line, bytes.
    pub(super) bytes: Range<usize>,
    /// Whether the run is written from right to left.
    pub(super) backwards: bool,
    /// The font's letters; `None` if no font has the run's characters.
    pub(super) face: Option<&'a Face>,
}

/// Returns the runs of a line in visual order, from left to right. The first letter with a writing direction decides
/// the direction of the whole line.
pub(super) fn runs<'a>(line: &str, font: &'a Font) -> Vec<FontRun<'a>> {
    let bidi = BidiInfo::new(line, None);
    let mut runs = Vec::new();
    for paragraph in &bidi.paragraphs {
        let (levels, pieces) = bidi.visual_runs(paragraph, paragraph.range.clone());
        for piece in pieces {
            let backwards = levels.get(piece.start).is_some_and(|level| level.is_rtl());
            let mut parts = by_face(line, piece, backwards, font);
            if backwards {
                parts.reverse();
            }
            runs.append(&mut parts);
        }
    }
    runs
}

/// Splits a piece of a line into runs of one font each, in the order of the text.
fn by_face<'a>(line: &str, piece: Range<usize>, backwards: bool, font: &'a Font) -> Vec<FontRun<'a>> {
    let mut parts: Vec<FontRun<'a>> = Vec::new();
    for unit in units(line, piece) {
        let face = face_for(line.get(unit.clone()).unwrap_or_default(), font);
        match parts.last_mut() {
            Some(last) if same(last.face, face) => last.bytes.end = unit.end,
            _ => parts.push(FontRun { bytes: unit, backwards, face }),
        }
    }
    parts
}

fn same(a: Option<&Face>, b: Option<&Face>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => std::ptr::eq(a, b),
        (None, None) => true,
        _ => false,
    }
}

/// Returns the ranges of characters in bytes, each with the marks and joiners that follow the character.
fn units(line: &str, piece: Range<usize>) -> Vec<Range<usize>> {
    let mut units: Vec<Range<usize>> = Vec::new();
    let text = line.get(piece.clone()).unwrap_or_default();
    for (at, character) in text.char_indices() {
        let (start, end) = (piece.start + at, piece.start + at + character.len_utf8());
        match units.last_mut() {
            Some(last) if is_combining_mark(character) || is_invisible(character) => last.end = end,
            _ => units.push(start..end),
        }
    }
    units
}

/// Whether a character draws nothing: joiners, variation selectors, direction marks and controls.
pub(super) fn is_invisible(character: char) -> bool {
    matches!(character, '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{2069}')
        || matches!(character, '\u{fe00}'..='\u{fe0f}' | '\u{feff}' | '\u{ad}' | '\u{e0100}'..='\u{e01ef}')
        || character.is_control()
}

/// Returns the first font that has a character and its marks, or else the first that has the character. Blanks get the
/// chosen font. `None` if no font has the character.
fn face_for<'a>(unit: &str, font: &'a Font) -> Option<&'a Face> {
    let first = unit.chars().next()?;
    if first.is_whitespace() || is_invisible(first) {
        return Some(font.face());
    }
    let faces = || std::iter::once(font.face()).chain(stand_ins().iter().map(Font::face));
    let whole = |face: &&Face| unit.chars().filter(|c| !is_invisible(*c)).all(|c| face.has(c));
    faces().find(whole).or_else(|| faces().find(|face| face.has(first)))
}

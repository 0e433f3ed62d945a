//! Shapes runs of text into letters by the font's own tables: glyphs, kerning, marks and joined forms.

use std::collections::BTreeMap;

use harfrust::{Buffer, BufferFlags, Direction, Feature, ShapeOptions, ShaperFont, Tag};
use lightbots_base::Vec2;
use skrifa::GlyphId;
use unicode_normalization::UnicodeNormalization;

use super::font::{Face, Font};
use super::letter::Letter;
use super::outline::Outlines;
use super::runs::{FontRun, is_invisible, runs};
use super::spine::spine;
use super::strokes::{StrokeFace, StrokeLine};

/// Width of a blank in a font without a blank, in cap heights: about that of common sans-serif fonts.
const BLANK: f64 = 0.35;

/// Largest number of points of a whole text. This number takes 32 MB of memory and is ten times the need of 2,000
/// ornate letters.
const POINTS_MAX: usize = 2_000_000;

/// Largest advance of one glyph, in cap heights. Larger values come from broken fonts and are reduced to this.
const ADVANCE_MAX: f64 = 100.0;

/// Letters of one line, and the width of the line.
#[derive(Clone, Debug, Default)]
pub(super) struct Shaped {
    /// Letters from left to right, with the baseline at y = 0.
    pub(super) letters: Vec<Letter>,
    /// Width of the line, including blanks at both ends, in cap heights.
    pub(super) width: f64,
}

/// Data that is collected while a whole text is shaped.
#[derive(Default)]
pub(super) struct Gathered {
    /// Characters that no font has, each with its number of occurrences.
    pub(super) missing: BTreeMap<char, usize>,
    /// Number of points of the outlines used.
    points: usize,
    /// For each letter, its area and its spine: lines that can replace the area. They are kept because finding a spine
    /// takes longer than everything else.
    spines: BTreeMap<String, (Rings, Vec<StrokeLine>)>,
}

/// The area of a letter.
type Rings = Vec<Vec<Vec2>>;

impl Gathered {
    /// Whether the outlines have more than [`POINTS_MAX`] points.
    pub(super) fn is_full(&self) -> bool {
        self.points > POINTS_MAX
    }

    fn miss(&mut self, characters: impl Iterator<Item = char>) {
        for character in characters.filter(|c| !is_invisible(*c)) {
            *self.missing.entry(character).or_default() += 1;
        }
    }

    /// Returns the spine of a letter. A spine found before is used again if the letter's area is equal.
    fn spine(&mut self, shown: &str, rings: &Rings, outlines: &Outlines) -> Vec<StrokeLine> {
        if let Some((_, spine)) = self.spines.get(shown).filter(|(known, _)| known == rings) {
            return spine.clone();
        }
        let spine = spine(shown, rings, outlines);
        self.spines.insert(shown.to_owned(), (rings.clone(), spine.clone()));
        spine
    }
}

/// Shapes the letters of a line. `from`: position of the line in the text, in bytes. `gap`: extra distance between
/// letters, in cap heights.
pub(super) fn shape(line: &str, from: usize, font: &Font, gap: f64, gathered: &mut Gathered) -> Shaped {
    let mut shaped = Shaped::default();
    for run in runs(line, font) {
        let text = line.get(run.bytes.clone()).unwrap_or_default();
        let at = from + run.bytes.start;
        match run.face {
            Some(Face::Outlines(outlines)) => by_font(text, at, outlines, &run, gap, gathered, &mut shaped),
            Some(Face::Strokes(strokes)) => by_lines(text, at, strokes, &run, gap, &mut shaped),
            None => gathered.miss(text.chars()),
        }
    }
    shaped
}

/// A letter of an outline font while it is composed of glyphs.
struct Cluster {
    start: usize,
    advance: f64,
    rings: Rings,
    /// Whether the font lacks one of the letter's characters. Example: it has the letter but not the mark on it.
    lacking: bool,
}

fn by_font(
    text: &str,
    at: usize,
    outlines: &Outlines,
    run: &FontRun,
    gap: f64,
    gathered: &mut Gathered,
    out: &mut Shaped,
) {
    let clusters = clusters(text, outlines, run.backwards, gathered);
    let mut starts: Vec<usize> = clusters.iter().map(|cluster| cluster.start).collect();
    starts.sort_unstable();
    for cluster in clusters {
        let end = starts.iter().copied().find(|start| *start > cluster.start).unwrap_or(text.len());
        let characters = text.get(cluster.start..end).unwrap_or_default();
        if cluster.lacking {
            gathered.miss(characters.chars().filter(|c| !outlines.has(*c)));
        }
        let shown: String = characters.nfc().filter(|c| !is_invisible(*c)).collect();
        let spine = gathered.spine(&shown, &cluster.rings, outlines);
        let letter =
            Letter { text: shown, at: at + cluster.start, rings: cluster.rings, lines: Vec::new(), spine };
        let advance = cluster.advance + if is_joined(characters) { 0.0 } else { gap };
        push(letter, advance, out);
    }
}

fn push(letter: Letter, advance: f64, out: &mut Shaped) {
    if letter.ink().next().is_some() {
        out.letters.push(letter.moved(Vec2::new(out.width, 0.0)));
    }
    out.width += advance;
}

/// Whether letters are written joined (Arabic). A gap would separate them.
fn is_joined(characters: &str) -> bool {
    characters.chars().any(|c| matches!(c, '\u{600}'..='\u{7bf}' | '\u{8a0}'..='\u{8ff}'))
}

/// Returns the letters of a run in visual order, from left to right.
fn clusters(text: &str, outlines: &Outlines, backwards: bool, gathered: &mut Gathered) -> Vec<Cluster> {
    let mut buffer = Buffer::new();
    buffer.push_str(text);
    buffer.guess_segment_properties();
    buffer.set_direction(if backwards { Direction::RightToLeft } else { Direction::LeftToRight });
    buffer.set_flags(BufferFlags::REMOVE_DEFAULT_IGNORABLES);
    // A ligature would make one part of several letters.
    let single = [b"liga", b"clig", b"dlig"].map(|tag| Feature::new(Tag::new(tag), 0, ..));
    let shaper = ShaperFont::new(outlines.file());
    if harfrust::shape(&shaper, &mut buffer, ShapeOptions::new().features(&single)).is_err() {
        return Vec::new();
    }
    let mut clusters: Vec<Cluster> = Vec::new();
    for (info, position) in buffer.glyph_infos().iter().zip(buffer.glyph_positions()) {
        let start = info.cluster as usize;
        if clusters.last().is_none_or(|last| last.start != start) {
            clusters.push(Cluster { start, advance: 0.0, rings: Vec::new(), lacking: false });
        }
        let Some(cluster) = clusters.last_mut() else { continue };
        let scaled = |units: i32| (f64::from(units) / outlines.unit).clamp(-ADVANCE_MAX, ADVANCE_MAX);
        let pen = Vec2::new(cluster.advance + scaled(position.x_offset), scaled(position.y_offset));
        cluster.advance += scaled(position.x_advance);
        if gathered.is_full() {
            continue;
        }
        if info.glyph_id == 0 {
            // The glyph of a missing character is a box.
            cluster.lacking = true;
            continue;
        }
        for ring in outlines.rings(GlyphId::new(info.glyph_id)) {
            gathered.points += ring.len();
            cluster.rings.push(ring.into_iter().map(|point| point + pen).collect());
        }
    }
    for cluster in clusters.iter_mut().filter(|cluster| cluster.advance == 0.0) {
        let blank = text.get(cluster.start..).is_some_and(|rest| rest.starts_with(char::is_whitespace));
        cluster.advance = if blank { BLANK } else { 0.0 };
    }
    clusters
}

fn by_lines(text: &str, at: usize, strokes: &StrokeFace, run: &FontRun, gap: f64, out: &mut Shaped) {
    let mut characters: Vec<(usize, char)> = text.char_indices().filter(|(_, c)| !is_invisible(*c)).collect();
    if run.backwards {
        characters.reverse();
    }
    for (start, character) in characters {
        let (lines, advance) = match strokes.glyph(character) {
            Some(glyph) => (glyph.lines.clone(), glyph.advance),
            None => (Vec::new(), BLANK),
        };
        let letter = Letter { text: character.into(), at: at + start, lines, ..Letter::default() };
        push(letter, advance + gap, out);
    }
}

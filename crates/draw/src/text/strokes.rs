//! Reads single-line fonts: SVG fonts whose letters are straight lines along the middle of each stroke.

use std::collections::BTreeMap;
use std::sync::Arc;

use lightbots_base::Vec2;
use usvg::roxmltree::{Document, ParsingOptions};

use super::region::distance;
use crate::geometry::bounds;

/// A closed line at most this wide and high is a dot, in cap heights. Makers of single-line fonts draw dots as small
/// squares.
const DOT_SHARE: f64 = 0.16;

/// Length of the line that replaces a dot, in cap heights. It is so short that it holds one robot, but still has a
/// direction.
const DOT_LENGTH: f64 = 0.02;

/// A piece of a line retraces another piece if both its ends are closer than this to it, in cap heights.
const SAME_PLACE: f64 = 0.015;

/// A line of a letter, in cap heights.
pub(super) type StrokeLine = Vec<Vec2>;

/// Lines of one letter.
#[derive(Clone, Debug)]
pub(super) struct StrokeGlyph {
    /// Distance from the start of the letter to the start of the next letter, in cap heights.
    pub(super) advance: f64,
    /// Its lines.
    pub(super) lines: Vec<StrokeLine>,
}

/// A font of single lines.
#[derive(Clone)]
pub(super) struct StrokeFace {
    glyphs: Arc<BTreeMap<char, StrokeGlyph>>,
}

impl StrokeFace {
    /// Reads the font in an SVG file with `glyph` elements. `None` if the file is damaged or has no H, whose height is
    /// the cap height.
    pub(super) fn read(svg: &str) -> Option<Self> {
        let options = ParsingOptions { allow_dtd: true, ..Default::default() };
        let document = Document::parse_with_options(svg, options).ok()?;
        let mut raw = BTreeMap::new();
        for node in document.descendants().filter(|node| node.has_tag_name("glyph")) {
            let mut characters = node.attribute("unicode").unwrap_or_default().chars();
            if let (Some(character), None) = (characters.next(), characters.next()) {
                let advance = node.attribute("horiz-adv-x").and_then(|text| text.parse().ok()).unwrap_or(0.0);
                raw.insert(
                    character,
                    StrokeGlyph { advance, lines: lines(node.attribute("d").unwrap_or_default()) },
                );
            }
        }
        // Some faces draw the middle of strokes. Their feet are above the baseline, and their tops below the height of
        // capitals.
        let (low, high) = bounds(raw.get(&'H')?.lines.iter().flatten())?;
        let scale = 1.0 / (high.y - low.y);
        if !(scale > 0.0 && scale.is_finite()) {
            return None;
        }
        let glyphs = raw.into_iter().map(|(character, glyph)| (character, glyph.placed(low.y, scale)));
        Some(Self { glyphs: Arc::new(glyphs.collect()) })
    }

    /// Whether the font has the character.
    pub(super) fn has(&self, character: char) -> bool {
        self.glyph(character).is_some()
    }

    /// Returns the lines of a character. `None` if the font does not have the character.
    pub(super) fn glyph(&self, character: char) -> Option<&StrokeGlyph> {
        self.glyphs.get(&character)
    }
}

impl StrokeGlyph {
    /// Converts the glyph from font units to cap heights above the foot of the capitals. Dots become short lines, and
    /// retraced pieces are removed.
    fn placed(self, foot: f64, scale: f64) -> Self {
        let placed = |line: StrokeLine| {
            line.into_iter().map(|point| Vec2::new(point.x, point.y - foot) * scale).collect()
        };
        let lines: Vec<StrokeLine> = self.lines.into_iter().map(placed).map(dotted).collect();
        let lines = without_retraces(&lines);
        Self { advance: self.advance * scale, lines }
    }
}

/// Reads the lines of an SVG path that has only absolute `M` and `L` commands.
fn lines(path: &str) -> Vec<StrokeLine> {
    let parts = path.split('M').map(|part| {
        let mut numbers =
            part.split(|c: char| c.is_whitespace() || c == 'L').filter_map(|text| text.parse::<f64>().ok());
        let mut line = StrokeLine::new();
        while let (Some(x), Some(y)) = (numbers.next(), numbers.next()) {
            line.push(Vec2::new(x, y));
        }
        line
    });
    parts.filter(|line| line.len() >= 2).collect()
}

/// Returns a short line in place of a small closed line, and any other line unchanged.
fn dotted(line: StrokeLine) -> StrokeLine {
    let Some((low, high)) = bounds(line.iter()) else { return line };
    let closed = line.first() == line.last();
    let size = high - low;
    if !closed || size.x.max(size.y) > DOT_SHARE {
        return line;
    }
    let centre = low.lerp(high, 0.5);
    let half = Vec2::new(DOT_LENGTH / 2.0, 0.0);
    vec![centre - half, centre + half]
}

/// Returns lines without the pieces that run along a longer piece. A pen may retrace its path, but robots would stand
/// twice in one place.
fn without_retraces(lines: &[StrokeLine]) -> Vec<StrokeLine> {
    let pieces: Vec<(Vec2, Vec2)> = lines.iter().flat_map(|line| pairs(line)).collect();
    let long = |at: usize| pieces[at].0.distance(pieces[at].1);
    let along = |at: usize, other: usize| {
        let (a, b) = pieces[other];
        let near = |point: Vec2| distance(point, a, b) < SAME_PLACE;
        // Of two pieces of the same length the first stays.
        let longer = long(other) > long(at) || (long(other) == long(at) && other < at);
        at != other && longer && near(pieces[at].0) && near(pieces[at].1)
    };
    let retraces = |at: usize| long(at) > 3.0 * SAME_PLACE && (0..pieces.len()).any(|other| along(at, other));
    let mut kept: Vec<StrokeLine> = Vec::new();
    let mut piece = 0;
    for line in lines {
        let mut open = StrokeLine::new();
        for (from, to) in pairs(line) {
            if retraces(piece) {
                kept.push(std::mem::take(&mut open));
            } else {
                if open.is_empty() {
                    open.push(from);
                }
                open.push(to);
            }
            piece += 1;
        }
        kept.push(open);
    }
    kept.retain(|line| line.len() >= 2);
    kept
}

fn pairs(line: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    line.iter().copied().zip(line.iter().copied().skip(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pen_that_goes_back_draws_once() {
        let at =
            |points: &[(f64, f64)]| points.iter().map(|(x, y)| Vec2::new(*x, *y)).collect::<StrokeLine>();
        let h = at(&[(0.0, 0.0), (0.0, 1.0), (0.0, 0.5), (0.7, 0.5), (0.7, 1.0), (0.7, 0.0)]);
        let once =
            [at(&[(0.0, 0.0), (0.0, 1.0)]), at(&[(0.0, 0.5), (0.7, 0.5)]), at(&[(0.7, 1.0), (0.7, 0.0)])];
        assert_eq!(without_retraces(&[h]), once);
    }
}

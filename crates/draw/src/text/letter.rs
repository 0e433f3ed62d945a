//! Letters at their places.

use lightbots_base::{Rgb, Vec2};

use crate::drawing::{Area, DrawingPart, FillRule, Stroke};

/// A letter at its place in the text's drawing. Coordinates are in cap heights.
#[derive(Clone, Debug, Default)]
pub(super) struct Letter {
    /// The text that it shows: one character with its marks, or the characters of a ligature.
    pub(super) text: String,
    /// Position of the letter in the text, in bytes.
    pub(super) at: usize,
    /// Rings of the letter's area; empty in a single-line font.
    pub(super) rings: Vec<Vec<Vec2>>,
    /// Lines of the letter in a single-line font; otherwise empty.
    pub(super) lines: Vec<Vec<Vec2>>,
    /// Lines that can replace the letter's area when there are few robots; may be empty.
    pub(super) spine: Vec<Vec<Vec2>>,
}

impl Letter {
    /// Returns the letter moved by a vector.
    pub(super) fn moved(mut self, by: Vec2) -> Self {
        let lines = self.rings.iter_mut().chain(&mut self.lines).chain(&mut self.spine);
        lines.flatten().for_each(|point| *point += by);
        self
    }

    /// All points of the visible areas and lines, which are those without the spine.
    pub(super) fn ink(&self) -> impl Iterator<Item = &Vec2> {
        self.rings.iter().chain(&self.lines).flatten()
    }

    /// Makes the letter a part of a drawing.
    pub(super) fn part(&self, name: String, color: Rgb) -> DrawingPart {
        let strokes = |lines: &[Vec<Vec2>]| {
            let stroke = |line: &Vec<Vec2>| {
                let closed = line.len() > 3 && line.first() == line.last();
                let points = line[..line.len() - usize::from(closed)].to_vec();
                Stroke { points, closed, ink: color.into(), weight: 1.0 }
            };
            lines.iter().map(stroke).collect()
        };
        let area =
            Area { rings: self.rings.clone(), rule: FillRule::NonZero, ink: color.into(), weight: 1.0 };
        DrawingPart {
            name,
            letter: self.text.chars().next(),
            areas: if self.rings.is_empty() { Vec::new() } else { vec![area] },
            strokes: strokes(&self.lines),
            spine: strokes(&self.spine),
            raster: None,
        }
    }
}

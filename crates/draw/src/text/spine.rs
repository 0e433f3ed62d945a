//! Finds the lines that replace the area of a letter when robots are few.

use lightbots_base::Vec2;

use super::accents;
use super::fit::{base, is_common, quality};
use super::outline::Outlines;
use super::region::LetterArea;
use super::strokes::StrokeLine;

/// Returns lines for the area of a letter. Empty if no lines lie well inside the area and cover it.
pub(super) fn spine(shown: &str, rings: &[Vec<Vec2>], outlines: &Outlines) -> Vec<StrokeLine> {
    let mut characters = shown.chars();
    let (Some(character), None) = (characters.next(), characters.next()) else { return Vec::new() };
    let Some(area) = LetterArea::new(rings).filter(is_common) else {
        return Vec::new();
    };
    let lines = match accents::parts(character) {
        Some(parts) => accents::composed(&parts, &area, outlines),
        None => base(character, &area),
    };
    lines.filter(|lines| quality(lines, &area).is_some()).unwrap_or_default()
}

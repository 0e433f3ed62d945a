//! Finds the spine of a letter: lines that can replace its area when there are few robots.

use lightbots_base::Vec2;

use super::accents;
use super::fit::{base, is_common, quality};
use super::outline::Outlines;
use super::region::LetterArea;
use super::strokes::StrokeLine;

/// Returns the spine for the area `rings` of the letter `shown`. Empty if no known lines are inside the area and cover
/// it well enough.
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

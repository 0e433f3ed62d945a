//! The lines that stand for the area of a letter where robots are few.

use lightbots_base::Vec2;

use super::accents;
use super::fit::{base, quality};
use super::outline::Outlines;
use super::region::LetterArea;
use super::strokes::StrokeLine;

/// Most points of a letter that gets a spine. The search is linear in them at every step; ornate letters have no strokes
/// anyway.
const POINTS_MAX: usize = 600;

/// Lines for the area of a letter; empty: there are none that lie inside of it and cover it.
pub(super) fn spine(shown: &str, rings: &[Vec<Vec2>], outlines: &Outlines) -> Vec<StrokeLine> {
    let mut characters = shown.chars();
    let (Some(character), None) = (characters.next(), characters.next()) else { return Vec::new() };
    let Some(region) = LetterArea::new(rings).filter(|region| region.points() <= POINTS_MAX) else {
        return Vec::new();
    };
    let lines = match accents::parts(character) {
        Some(parts) => accents::composed(&parts, &region, outlines),
        None => base(character, &region),
    };
    lines.filter(|lines| quality(lines, &region).is_some()).unwrap_or_default()
}

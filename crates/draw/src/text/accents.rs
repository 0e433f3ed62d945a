//! Strokes (middle lines) of letters with accents, composed of the strokes of the letter and those of the accent.

use lightbots_base::Vec2;
use unicode_normalization::UnicodeNormalization;

use super::fit::{base, stretched};
use super::outline::Outlines;
use super::region::LetterArea;
use super::strokes::StrokeLine;
use crate::geometry::bounds;

/// Outlines farther than this above or below the plain letter belong to the accent, in cap heights. Letters with
/// accents may be a little higher than the plain letter.
const CLEAR: f64 = 0.02;

/// Distance from the outline of an accent to its middle line, in stroke widths of the letter. It is below a half
/// because accents are thinner than letters.
const INSET: f64 = 0.4;

/// A letter with one accent.
pub(super) struct Parts {
    letter: char,
    accent: char,
}

/// Combining mark that stands for the bar of ł on an l. Unicode does not decompose ł.
const BAR: char = '\u{337}';

/// Splits a character into its letter and its accent. `None` if it has no accent. A second accent is ignored, and an i
/// with an accent above becomes ı.
pub(super) fn parts(character: char) -> Option<Parts> {
    match character {
        'ł' => return Some(Parts { letter: 'l', accent: BAR }),
        'Ł' => return Some(Parts { letter: 'L', accent: BAR }),
        _ => {}
    }
    let mut decomposed = std::iter::once(character).nfd();
    let (letter, accent) = (decomposed.next()?, decomposed.next()?);
    let dotless = matches!(letter, 'i' | 'j') && !is_below(accent);
    Some(Parts { letter: if dotless && letter == 'i' { 'ı' } else { letter }, accent })
}

/// Returns the strokes of a letter with its accent. `region`: area of the whole character. `None` if no strokes are
/// known for the letter or the accent, or if they do not fit the area.
pub(super) fn composed(parts: &Parts, region: &LetterArea, outlines: &Outlines) -> Option<Vec<StrokeLine>> {
    let mut rings = outlines.rings_of(parts.letter);
    let by = Vec2::new(shift(parts.accent, region, &LetterArea::new(&rings)?)?, 0.0);
    rings.iter_mut().flatten().for_each(|point| *point += by);
    let plain = LetterArea::new(&rings)?;
    let mut lines = base(parts.letter, &plain)?;
    lines.extend(if parts.accent == BAR {
        bar(region, &plain)?
    } else {
        accent(parts.accent, region, &plain)?
    });
    Some(lines)
}

/// Returns the distance by which the letter is farther right in its accented form than in its plain form, in cap
/// heights. Some fonts give the accented form more room.
fn shift(accent: char, region: &LetterArea, plain: &LetterArea) -> Option<f64> {
    let (low, high) = plain.extent;
    // The bar of ł sticks out on both sides, and only the top of the stem can be compared.
    let foot = if accent == BAR { high.y - CLEAR } else { low.y - CLEAR };
    let left = |region: &LetterArea| {
        let points =
            region.edges().map(|(a, _)| a).filter(|point| (foot..=high.y + CLEAR).contains(&point.y));
        points.map(|point| point.x).min_by(f64::total_cmp)
    };
    Some(left(region)? - left(plain)?)
}

fn is_below(accent: char) -> bool {
    matches!(accent, '\u{323}'..='\u{333}')
}

/// Returns the strokes of an accent where the outline of the accent is. `None` for an unknown accent.
fn accent(accent: char, region: &LetterArea, plain: &LetterArea) -> Option<Vec<StrokeLine>> {
    let lines: Vec<StrokeLine> =
        shape(accent)?.iter().map(|line| line.iter().map(|(x, y)| Vec2::new(*x, *y)).collect()).collect();
    let (low, high) = plain.extent;
    let below = is_below(accent);
    let belongs = |point: &Vec2| if below { point.y < low.y - CLEAR } else { point.y > high.y + CLEAR };
    let points: Vec<Vec2> = region.edges().map(|(a, _)| a).filter(belongs).collect();
    let (mut from, mut to) = bounds(points.iter())?;
    let inset = Vec2::new(region.stem, region.stem) * INSET;
    from += inset;
    to -= inset;
    if below && matches!(accent, '\u{327}' | '\u{328}') {
        to.y = low.y + region.stem / 2.0;
    }
    Some(stretched(lines, from, to))
}

/// Returns the strokes of an accent in the unit square. Dots are short lines. `None` for an unknown accent.
fn shape(accent: char) -> Option<&'static [&'static [(f64, f64)]]> {
    Some(match accent {
        '\u{300}' => &[&[(0.0, 1.0), (1.0, 0.0)]],
        '\u{301}' => &[&[(0.0, 0.0), (1.0, 1.0)]],
        '\u{302}' => &[&[(0.0, 0.0), (0.5, 1.0), (1.0, 0.0)]],
        '\u{303}' => &[&[(0.0, 0.1), (0.2, 0.8), (0.4, 0.8), (0.6, 0.2), (0.8, 0.2), (1.0, 0.9)]],
        '\u{304}' => &[&[(0.0, 0.5), (1.0, 0.5)]],
        '\u{306}' => &[&[(0.0, 1.0), (0.15, 0.4), (0.5, 0.0), (0.85, 0.4), (1.0, 1.0)]],
        '\u{307}' | '\u{323}' => &[&[(0.49, 0.5), (0.51, 0.5)]],
        '\u{308}' => &[&[(0.0, 0.5), (0.02, 0.5)], &[(0.98, 0.5), (1.0, 0.5)]],
        '\u{30a}' => &[&[
            (0.5, 0.0),
            (0.9, 0.2),
            (1.0, 0.5),
            (0.9, 0.8),
            (0.5, 1.0),
            (0.1, 0.8),
            (0.0, 0.5),
            (0.1, 0.2),
            (0.5, 0.0),
        ]],
        '\u{30b}' => &[&[(0.0, 0.0), (0.3, 1.0)], &[(0.7, 0.0), (1.0, 1.0)]],
        '\u{30c}' => &[&[(0.0, 1.0), (0.5, 0.0), (1.0, 1.0)]],
        '\u{326}' => &[&[(1.0, 1.0), (0.0, 0.0)]],
        '\u{327}' => &[&[(0.5, 1.0), (0.5, 0.7), (1.0, 0.5), (0.9, 0.1), (0.0, 0.0)]],
        '\u{328}' => &[&[(0.8, 1.0), (0.2, 0.6), (0.0, 0.25), (0.3, 0.0), (1.0, 0.1)]],
        _ => return None,
    })
}

/// Returns the bar of ł. It is a line between the left and the right end of those parts of the outline that do not
/// belong to the plain letter.
fn bar(region: &LetterArea, plain: &LetterArea) -> Option<Vec<StrokeLine>> {
    let own = |point: &Vec2| !plain.contains(*point) && plain.distance(*point) > CLEAR;
    let points: Vec<Vec2> = region.edges().map(|(a, _)| a).filter(own).collect();
    let (low, high) = bounds(points.iter())?;
    let end = |x: f64| {
        let points = points.iter().filter(|point| (point.x - x).abs() < region.stem / 4.0);
        bounds(points).map(|(low, high)| low.lerp(high, 0.5).y)
    };
    let inset = region.stem * INSET;
    Some(vec![vec![Vec2::new(low.x + inset, end(low.x)?), Vec2::new(high.x - inset, end(high.x)?)]])
}

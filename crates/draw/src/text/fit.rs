//! Single strokes of a letter, fitted to the area of the same letter of another font.

use lightbots_base::Vec2;

use super::font::spines;
use super::letter::bounds;
use super::region::{LetterArea, distance};
use super::strokes::StrokeLine;

/// Largest distance between points while lines are moved, in cap heights.
const STEP: f64 = 0.06;

/// Times that lines are moved to the middle; the second time corrects the directions of the first.
const ROUNDS: usize = 3;

/// Lines that deviate less than this from straight ones become straight, in cap heights.
const STRAIGHT: f64 = 0.006;

/// Least share of a spine inside of the area. Tuned on the three outline fonts inside, 2026-11-24.
const INSIDE_MIN: f64 = 0.95;

/// Least share of the outline that is near the spine.
const COVERED_MIN: f64 = 0.93;

/// Stroke widths within which an outline counts as near the spine: half a width is ideal, corners have 0.71.
const NEAR: f64 = 1.0;

/// Lines of a letter without accents: those of the single-line font that fits best.
pub(super) fn base(character: char, region: &LetterArea) -> Option<Vec<StrokeLine>> {
    let candidates = spines().iter().filter_map(|face| {
        let lines = match character {
            'ı' => face
                .glyph('i')?
                .lines
                .iter()
                .filter(|line| line.len() > 2 || !is_dot(line))
                .cloned()
                .collect(),
            _ => face.glyph(character)?.lines.clone(),
        };
        let fitted = fitted(lines, region);
        quality(&fitted, region).map(|quality| (quality, fitted))
    });
    candidates.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, lines)| lines)
}

fn is_dot(line: &StrokeLine) -> bool {
    bounds(line.iter()).is_some_and(|(low, high)| high.distance(low) < 2.0 * STEP)
}

/// Lines stretched to the middle of the outermost strokes, then moved into the middle of all strokes.
fn fitted(lines: Vec<StrokeLine>, region: &LetterArea) -> Vec<StrokeLine> {
    let half = Vec2::new(region.stem, region.stem) / 2.0;
    let (low, high) = region.extent;
    let lines = stretched(lines, low + half, high - half);
    let mut lines: Vec<StrokeLine> = lines.iter().map(divided).collect();
    for _ in 0..ROUNDS {
        lines = lines.into_iter().map(|line| centred(line, region)).collect();
    }
    lines.into_iter().map(|line| straightened(&line)).collect()
}

/// Lines stretched into a rectangle; where either has no width, they are centred.
pub(super) fn stretched(mut lines: Vec<StrokeLine>, low: Vec2, high: Vec2) -> Vec<StrokeLine> {
    let Some((from, to)) = bounds(lines.iter().flatten()) else { return lines };
    let axis = |value: f64, from: f64, to: f64, low: f64, high: f64| {
        if to - from < STEP || high <= low {
            (low + high) / 2.0 + (value - (from + to) / 2.0) * f64::from(high > low)
        } else {
            low + (value - from) / (to - from) * (high - low)
        }
    };
    for point in lines.iter_mut().flatten() {
        point.x = axis(point.x, from.x, to.x, low.x, high.x);
        point.y = axis(point.y, from.y, to.y, low.y, high.y);
    }
    lines
}

fn divided(line: &StrokeLine) -> StrokeLine {
    let mut points: StrokeLine = line.first().copied().into_iter().collect();
    for pair in line.windows(2) {
        let [a, b] = pair else { continue };
        let pieces = (a.distance(*b) / STEP).clamp(1.0, 100.0) as usize;
        points.extend((1..=pieces).map(|piece| a.lerp(*b, piece as f64 / pieces as f64)));
    }
    points
}

/// A line moved into the middle of the strokes that it lies on. Points at joints move like their neighbours.
fn centred(line: StrokeLine, region: &LetterArea) -> StrokeLine {
    let last = line.len().saturating_sub(1);
    let closed = line.len() > 3 && line.first() == line.last();
    let moves: Vec<Option<Vec2>> = (0..line.len())
        .map(|at| {
            let before = if at == 0 && closed { line[last - 1] } else { line[at.saturating_sub(1)] };
            let after = if at == last && closed { line[1] } else { line[(at + 1).min(last)] };
            let normal = (after - before).normalized()?.left();
            region.middle(line[at], normal).map(|way| normal * way)
        })
        .collect();
    let mut moves = filled(&moves);
    for _ in 0..2 {
        moves = smoothed(&moves, closed);
    }
    line.into_iter().zip(moves).map(|(point, by)| point + by).collect()
}

/// Moves that are not known lie between those before and after them.
fn filled(moves: &[Option<Vec2>]) -> Vec<Vec2> {
    let known: Vec<(usize, Vec2)> =
        moves.iter().enumerate().filter_map(|(at, by)| by.map(|by| (at, by))).collect();
    (0..moves.len())
        .map(|at| {
            let after = known.partition_point(|(index, _)| *index < at);
            match (after.checked_sub(1).and_then(|before| known.get(before)), known.get(after)) {
                (Some((low, a)), Some((high, b))) => a.lerp(*b, (at - low) as f64 / (high - low) as f64),
                (Some((_, by)), None) | (None, Some((_, by))) => *by,
                (None, None) => Vec2::ZERO,
            }
        })
        .collect()
}

fn smoothed(moves: &[Vec2], closed: bool) -> Vec<Vec2> {
    let last = moves.len().saturating_sub(1);
    (0..moves.len())
        .map(|at| {
            let before = if at == 0 && closed { last - 1 } else { at.saturating_sub(1) };
            let after = if at == last && closed { 1 } else { (at + 1).min(last) };
            (moves[before] + moves[at] * 2.0 + moves[after]) / 4.0
        })
        .collect()
}

/// The line with the fewest points that stays within `STRAIGHT` (Douglas and Peucker 1973).
fn straightened(line: &[Vec2]) -> StrokeLine {
    let (Some(first), Some(last)) = (line.first(), line.last()) else { return StrokeLine::new() };
    let ways = line.iter().map(|point| distance(*point, *first, *last));
    let farthest = ways.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
    match farthest {
        Some((at, way)) if way > STRAIGHT && at > 0 && at + 1 < line.len() => {
            let mut points = straightened(&line[..=at]);
            points.extend(straightened(&line[at..]).into_iter().skip(1));
            points
        }
        _ => vec![*first, *last],
    }
}

/// How well lines stand for an area: share of them inside plus share of the outline that is near. `None`: too badly.
pub(super) fn quality(lines: &[StrokeLine], region: &LetterArea) -> Option<f64> {
    let points: Vec<Vec2> = lines.iter().flat_map(divided).collect();
    let inside = points.iter().filter(|point| region.contains(**point)).count() as f64 / points.len() as f64;
    if points.iter().any(|point| !region.contains(*point) && region.distance(*point) > region.stem / 4.0) {
        return None;
    }
    let outline: Vec<Vec2> = region.edges().flat_map(|(a, b)| divided(&vec![a, b])).collect();
    let near = |point: &&Vec2| to_lines(**point, lines) <= NEAR * region.stem;
    let covered = outline.iter().filter(near).count() as f64 / outline.len() as f64;
    (inside >= INSIDE_MIN && covered >= COVERED_MIN).then_some(inside + covered)
}

fn to_lines(point: Vec2, lines: &[StrokeLine]) -> f64 {
    let pieces = lines.iter().flat_map(|line| line.windows(2));
    let ways = pieces.filter_map(|pair| match pair {
        [a, b] => Some(distance(point, *a, *b)),
        _ => None,
    });
    ways.fold(f64::INFINITY, f64::min)
}

//! Fits the strokes of a letter in a single-line font to the area of the letter in another font. The result is the
//! letter's spine: lines that can replace its area.

use lightbots_base::Vec2;

use super::font::spines;
use super::region::{LetterArea, distance};
use super::strokes::StrokeLine;
use crate::geometry::bounds;

/// Letters with more points than this get no spine. Every step of the search takes time in proportion to the number of
/// points, and ornate letters have no clear strokes anyway.
const POINTS_MAX: usize = 600;

/// Letters wider or higher than this get no spine, in cap heights, because the search divides lines into small steps.
const SIZE_MAX: f64 = 4.0;

/// About the largest distance between points of a line while it is moved, in cap heights.
const STEP: f64 = 0.06;

/// Number of times that lines are moved towards the middle of the strokes. Each time uses the directions of the lines
/// that the time before gave.
const ROUNDS: usize = 3;

/// A line that deviates from a straight line by at most this becomes straight, in cap heights.
const STRAIGHT: f64 = 0.006;

/// Least share of a spine that must be inside the area. Tuned on the three built-in outline fonts, 2026-11-24.
const INSIDE_MIN: f64 = 0.9;

/// Least share of the outline that must be near the spine.
const COVERED_MIN: f64 = 0.85;

/// A point of the outline is near the spine if it is at most this far from it, in stroke widths. At a straight stroke
/// the distance is 0.5, at a corner 0.71. At a round dot, whose mean width is its radius, it is 1.
const NEAR: f64 = 1.1;

/// Whether a letter is small and simple enough for the search of a spine.
pub(super) fn is_common(area: &LetterArea) -> bool {
    let size = area.extent.1 - area.extent.0;
    area.points() <= POINTS_MAX && size.x.max(size.y) <= SIZE_MAX
}

/// Returns the spine of a letter without accents, from the single-line font that fits its area best. `None` if no font
/// fits well enough ([`quality`]), or if the letter is too large or has too many points.
pub(super) fn base(character: char, area: &LetterArea) -> Option<Vec<StrokeLine>> {
    if !is_common(area) {
        return None;
    }
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
        let fitted = fitted(lines, area);
        quality(&fitted, area).map(|quality| (quality, fitted))
    });
    candidates.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, lines)| lines)
}

fn is_dot(line: &StrokeLine) -> bool {
    bounds(line.iter()).is_some_and(|(low, high)| high.distance(low) < 2.0 * STEP)
}

/// Stretches lines to the extent of an area, less half a stroke width on each side. Then moves each line into the middle
/// of the stroke on which it lies, and cuts off ends outside the area. If there are as many dots as small separate parts
/// of the area, each dot is moved to the centre of one of them instead.
fn fitted(lines: Vec<StrokeLine>, area: &LetterArea) -> Vec<StrokeLine> {
    let half = Vec2::new(area.stem, area.stem) / 2.0;
    let (mut dots, mut lines): (Vec<StrokeLine>, Vec<StrokeLine>) = lines.into_iter().partition(is_dot);
    let (blobs, rest) = area.blobs();
    let mut extent = rest;
    if dots.len() == blobs.len() {
        dots.sort_by(|a, b| foot(a).total_cmp(&foot(b)));
        let placed =
            dots.into_iter().zip(&blobs).map(|(dot, (low, high))| moved_to(dot, low.lerp(*high, 0.5)));
        dots = placed.collect();
    } else {
        lines.append(&mut dots);
        extent = Some(area.extent);
    }
    if let Some((low, high)) = extent {
        lines = stretched(lines, low + half, high - half);
    }
    let mut lines: Vec<StrokeLine> = lines.iter().map(divided).collect();
    for _ in 0..ROUNDS {
        lines = lines.into_iter().map(|line| centred(&line, area)).collect();
    }
    lines.into_iter().map(|line| straightened(trimmed(&line, area))).chain(dots).collect()
}

fn foot(line: &StrokeLine) -> f64 {
    line.first().map_or(0.0, |point| point.y)
}

/// Moves a dot to another centre.
fn moved_to(dot: StrokeLine, centre: Vec2) -> StrokeLine {
    let Some((low, high)) = bounds(dot.iter()) else { return dot };
    let by = centre - low.lerp(high, 0.5);
    dot.into_iter().map(|point| point + by).collect()
}

/// Stretches lines so that they fill the rectangle from `low` to `high`. Along an axis on which the lines have less
/// extent than [`STEP`], or the rectangle has none, lines are centred.
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

/// Returns a line without the points at its ends that are outside the area. Strokes of different fonts end in different
/// directions.
fn trimmed<'a>(line: &'a [Vec2], area: &LetterArea) -> &'a [Vec2] {
    let inside = |point: &Vec2| area.contains(*point);
    match (line.iter().position(inside), line.iter().rposition(inside)) {
        (Some(first), Some(last)) if last > first => &line[first..=last],
        _ => line,
    }
}

/// Move of a point: its distance, in cap heights, and the direction across the line in which it goes.
#[derive(Clone, Copy)]
struct Move {
    by: f64,
    across: Vec2,
}

/// Moves a line into the middle of the strokes on which it lies. Each piece between corners moves on its own.
fn centred(line: &[Vec2], area: &LetterArea) -> StrokeLine {
    let last = line.len().saturating_sub(1);
    let mut corners = vec![0];
    corners.extend((1..last).filter(|at| is_corner(line[at - 1], line[*at], line[at + 1])));
    corners.push(last);
    let pieces: Vec<Vec<Move>> =
        corners.windows(2).map(|ends| moves(&line[ends[0]..=ends[1]], area)).collect();
    let (Some(first), Some(end)) =
        (pieces.first().and_then(|piece| piece.first()), pieces.last().and_then(|piece| piece.last()))
    else {
        return line.to_vec();
    };
    let closed = line.len() > 3 && line[0] == line[last];
    let (from, to) = if closed { (met(*end, *first), met(*end, *first)) } else { (first.way(), end.way()) };
    let mut ways = vec![from];
    for (at, piece) in pieces.iter().enumerate() {
        ways.extend(piece.iter().take(piece.len() - 1).skip(1).map(|step| step.way()));
        let next = pieces.get(at + 1).and_then(|piece| piece.first());
        ways.push(next.map_or(to, |next| met(piece[piece.len() - 1], *next)));
    }
    line.iter().zip(ways).map(|(point, way)| *point + way).collect()
}

impl Move {
    fn way(&self) -> Vec2 {
        self.across * self.by
    }
}

/// Least cosine of the turn at a point that is no corner. Turns of 35 degrees or more are corners.
const CORNER_COSINE: f64 = 0.82;

/// If the sine of the angle between two pieces is below this, their meeting point is not used, because nearly parallel
/// lines meet far away.
const MEETING_SINE: f64 = 0.4;

fn is_corner(a: Vec2, b: Vec2, c: Vec2) -> bool {
    match ((b - a).normalized(), (c - b).normalized()) {
        (Some(before), Some(after)) => before.dot(after) < CORNER_COSINE,
        _ => false,
    }
}

/// Returns by which vector the corner between two pieces moves: to the point where the moved pieces meet.
fn met(a: Move, b: Move) -> Vec2 {
    let sine = a.across.cross(b.across);
    if sine.abs() < MEETING_SINE {
        return (a.way() + b.way()) / 2.0;
    }
    // The displacement d with d·across = by for both pieces.
    Vec2::new(a.by * b.across.y - b.by * a.across.y, b.by * a.across.x - a.by * b.across.x) / sine
}

/// Returns the moves of the points of a piece without corners. Points at joints of strokes, where no middle is found,
/// move like their neighbours.
fn moves(piece: &[Vec2], area: &LetterArea) -> Vec<Move> {
    let last = piece.len().saturating_sub(1);
    let across =
        |at: usize| (piece[(at + 1).min(last)] - piece[at.saturating_sub(1)]).normalized().map(Vec2::left);
    let across: Vec<Vec2> = (0..piece.len()).map(|at| across(at).unwrap_or(Vec2::ZERO)).collect();
    let known: Vec<Option<f64>> =
        piece.iter().zip(&across).map(|(point, across)| area.middle(*point, *across)).collect();
    let mut by = filled(&known);
    for _ in 0..2 {
        by = smoothed(&by);
    }
    by.into_iter().zip(across).map(|(by, across)| Move { by, across }).collect()
}

/// Replaces unknown moves by values interpolated between the known moves before and after them.
fn filled(moves: &[Option<f64>]) -> Vec<f64> {
    let known: Vec<(usize, f64)> =
        moves.iter().enumerate().filter_map(|(at, by)| by.map(|by| (at, by))).collect();
    (0..moves.len())
        .map(|at| {
            let after = known.partition_point(|(index, _)| *index < at);
            match (after.checked_sub(1).and_then(|before| known.get(before)), known.get(after)) {
                (Some((low, a)), Some((high, b))) => a + (b - a) * (at - low) as f64 / (high - low) as f64,
                (Some((_, by)), None) | (None, Some((_, by))) => *by,
                (None, None) => 0.0,
            }
        })
        .collect()
}

fn smoothed(moves: &[f64]) -> Vec<f64> {
    let last = moves.len().saturating_sub(1);
    let near = |at: usize| moves[at.saturating_sub(1)] + moves[at] * 2.0 + moves[(at + 1).min(last)];
    (0..moves.len()).map(|at| near(at) / 4.0).collect()
}

/// Returns a line of few points that stays within [`STRAIGHT`] of the given line (Douglas and Peucker 1973).
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

/// Returns how well lines represent an area. This is the share of the lines that is inside, plus the share of the
/// outline that is near the lines. `None` if one of these shares is too small, or a point of the lines is too far
/// outside.
pub(super) fn quality(lines: &[StrokeLine], area: &LetterArea) -> Option<f64> {
    let points: Vec<Vec2> = lines.iter().flat_map(divided).collect();
    let inside = points.iter().filter(|point| area.contains(**point)).count() as f64 / points.len() as f64;
    if points.iter().any(|point| !area.contains(*point) && area.distance(*point) > area.stem / 4.0) {
        return None;
    }
    let outline: Vec<Vec2> = area.edges().flat_map(|(a, b)| divided(&vec![a, b])).collect();
    let near = |point: &&Vec2| to_lines(**point, lines) <= NEAR * area.stem;
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

//! Distributes words over lines, in the number of lines with which the text fills a rectangle best.

use super::lines::{lines, words};
use super::settings::TextSettings;
use super::shape::{Gathered, shape};

/// Largest number of lines that is tried.
const LINES_MAX: usize = 60;

/// Number of bisection steps in the search for the smallest width of lines. After them, 2⁻⁴⁰ of the width is left,
/// which is negligible.
const HALVINGS: usize = 40;

/// Height of a line without the gap below it, in cap heights.
const LINE: f64 = 1.0;

/// A word: where it begins and ends in the text, in bytes, and its width, in cap heights.
struct Word {
    from: usize,
    end: usize,
    width: f64,
}

/// Returns the lines of the wrapped text, each with its position in the text in bytes. Line breaks of the text are
/// kept. `ratio`: width over height of the rectangle to fill.
pub(super) fn wrap(
    text: &str,
    ratio: f64,
    settings: &TextSettings,
    gathered: &mut Gathered,
) -> Vec<(usize, String)> {
    let mut blank = 0.35 + settings.letter_gap;
    let paragraphs: Vec<Vec<Word>> = lines(text)
        .map(|(from, line)| {
            let words = words(line).map(|(at, word)| {
                let shaped = shape(word, from + at, settings.font, settings.letter_gap, gathered);
                Word { from: from + at, end: from + at + word.len(), width: shaped.width }
            });
            words.collect()
        })
        .collect();
    blank = blank.max(0.1);
    let all: f64 = paragraphs.iter().flatten().map(|word| word.width + blank).sum();
    let count = paragraphs.iter().map(Vec::len).sum::<usize>().min(LINES_MAX);
    let mut best: Option<(f64, f64)> = None;
    for wanted in paragraphs.len()..=count.max(paragraphs.len()) {
        let Some(width) = narrowest(&paragraphs, blank, wanted, all) else { continue };
        let rows = rows(&paragraphs, blank, width);
        let widest = rows.iter().map(|row| row.width).fold(0.0, f64::max);
        let height = rows.len() as f64 * (LINE + settings.line_gap) - settings.line_gap;
        let scale = (ratio / widest.max(0.01)).min(1.0 / height);
        if best.is_none_or(|(most, _)| scale > most + 1e-9) {
            best = Some((scale, width));
        }
    }
    let rows = rows(&paragraphs, blank, best.map_or(all, |(_, width)| width));
    rows.into_iter()
        .map(|row| (row.from, text.get(row.from..row.end).unwrap_or_default().to_owned()))
        .collect()
}

/// Returns the smallest width, in cap heights, at which the words need at most `wanted` lines. `None` if they need more
/// at the width `all`.
fn narrowest(paragraphs: &[Vec<Word>], blank: f64, wanted: usize, all: f64) -> Option<f64> {
    let fits = |width: f64| rows(paragraphs, blank, width).len() <= wanted;
    if !fits(all) {
        return None;
    }
    let (mut low, mut high) = (0.0, all);
    for _ in 0..HALVINGS {
        let middle = (low + high) / 2.0;
        if fits(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

struct Row {
    from: usize,
    end: usize,
    width: f64,
}

/// Fills lines of at most `width` with words, from the first word on. A word wider than `width` gets a line of its own.
fn rows(paragraphs: &[Vec<Word>], blank: f64, width: f64) -> Vec<Row> {
    let mut rows = Vec::new();
    for paragraph in paragraphs {
        let mut open: Option<Row> = None;
        for word in paragraph {
            match &mut open {
                Some(row) if row.width + blank + word.width <= width => {
                    row.end = word.end;
                    row.width += blank + word.width;
                }
                _ => rows.extend(open.replace(Row { from: word.from, end: word.end, width: word.width })),
            }
        }
        rows.extend(open);
    }
    rows
}

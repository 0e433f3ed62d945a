//! Lays out letters on one or several lines.

use std::collections::BTreeMap;

use lightbots_base::{Rgb, Vec2};
use unicode_normalization::UnicodeNormalization;

use super::letter::Letter;
use super::lines::lines;
use super::runs::is_invisible;
use super::settings::{Align, CHARACTERS_MAX, Colors, TextSettings};
use super::shape::{Gathered, Shaped, shape};
use super::wrap::wrap;
use crate::drawing::Drawing;
use crate::error::{DrawError, Made, Note};
use crate::geometry::bounds;

/// Largest number of characters that a note names.
const NAMED_MAX: usize = 20;

/// Colours of [`Colors::Rainbow`]: red, yellow, green, cyan, blue, magenta.
const RAINBOW: [Rgb; 6] = [
    Rgb::new(255, 0, 0),
    Rgb::new(255, 255, 0),
    Rgb::new(0, 255, 0),
    Rgb::new(0, 255, 255),
    Rgb::new(0, 0, 255),
    Rgb::new(255, 0, 255),
];

/// Draws the words as one drawing, with a part for each visible letter.
///
/// # Errors
/// `text-empty` if no sign is visible, `text-too-long`, `text-settings` for numbers out of range. `text-no-glyphs` if
/// no sign can be drawn, `text-too-detailed` if the letters have too many points.
pub fn draw(settings: &TextSettings) -> Result<Made, DrawError> {
    check(settings)?;
    let (letters, notes) = lay_out(settings)?;
    Ok(Made { drawing: drawing(&letters, &settings.colors), notes })
}

/// Returns an error for settings that cannot be drawn.
pub(super) fn check(settings: &TextSettings) -> Result<(), DrawError> {
    let characters = settings.words.chars().count();
    if characters > CHARACTERS_MAX {
        let message =
            format!("The text has {characters} characters; at most {CHARACTERS_MAX} are drawn. Shorten it.");
        return Err(DrawError::new("text-too-long", message));
    }
    if settings.words.chars().all(|c| c.is_whitespace() || is_invisible(c)) {
        return Err(DrawError::new(
            "text-empty",
            "There is nothing to draw: the text is empty or only blanks. Type a word.",
        ));
    }
    let ranges = [
        ("letter gap", settings.letter_gap, -0.5, 5.0),
        ("line gap", settings.line_gap, 0.0, 5.0),
        ("wrap ratio", settings.wrap.unwrap_or(1.0), 0.01, 100.0),
    ];
    for (name, value, low, high) in ranges {
        if !(low..=high).contains(&value) {
            let message = format!("The {name} of the text is {value}; choose one from {low} to {high}.");
            return Err(DrawError::new("text-settings", message));
        }
    }
    Ok(())
}

/// Returns letters at their places, in the order of the text, and a note about missing signs.
///
/// # Errors
/// `text-too-detailed` and `text-no-glyphs`, as for [`draw`].
pub(super) fn lay_out(settings: &TextSettings) -> Result<(Vec<Letter>, Vec<Note>), DrawError> {
    // Composed characters let fonts use their own accented letters.
    let text: String = settings
        .words
        .nfc()
        .collect::<String>()
        .replace("\r\n", "\n")
        .replace(['\r', '\u{2028}', '\u{2029}'], "\n");
    let text = text.replace('\t', " ");
    let mut gathered = Gathered::default();
    let lines = match settings.wrap {
        Some(ratio) => wrap(&text, ratio, settings, &mut gathered),
        None => lines(&text).map(|(from, line)| (from, line.to_owned())).collect(),
    };
    gathered.missing.clear();
    let shaped = lines
        .iter()
        .map(|(from, line)| shape(line, *from, settings.font, settings.letter_gap, &mut gathered));
    let shaped: Vec<Shaped> = shaped.collect();
    if gathered.is_full() {
        let message = "The letters of the font have too many points. Use a simpler font or a shorter text.";
        return Err(DrawError::new("text-too-detailed", message));
    }
    let notes: Vec<Note> = missing(&gathered.missing).into_iter().collect();
    let mut letters = stacked(shaped, settings);
    if letters.is_empty() {
        let named = named(&gathered.missing);
        let message =
            format!("No font has a sign of the text ({named}). Choose a font that has them, or other words.");
        return Err(DrawError::new("text-no-glyphs", message));
    }
    letters.sort_by_key(|letter| letter.at);
    Ok((letters, notes))
}

/// Stacks lines below each other and aligns them. All baselines are equally far apart: as close as `line_gap` between
/// all pairs of successive lines allows.
fn stacked(lines: Vec<Shaped>, settings: &TextSettings) -> Vec<Letter> {
    let boxes: Vec<Option<(Vec2, Vec2)>> =
        lines.iter().map(|line| bounds(line.letters.iter().flat_map(Letter::ink))).collect();
    let pitch = pitch(&boxes) + settings.line_gap;
    let width = boxes.iter().flatten().map(|(low, high)| high.x - low.x).fold(0.0, f64::max);
    let mut letters = Vec::new();
    for (row, (line, extent)) in lines.into_iter().zip(boxes).enumerate() {
        let Some((low, high)) = extent else { continue };
        let free = width - (high.x - low.x);
        let indent = match settings.align {
            Align::Left => 0.0,
            Align::Centre => free / 2.0,
            Align::Right => free,
        };
        let by = Vec2::new(indent - low.x, -pitch * row as f64);
        letters.extend(line.letters.into_iter().map(|letter| letter.moved(by)));
    }
    letters
}

/// Returns the distance between baselines at which the closest two successive lines touch; at least 1 cap height.
/// `boxes`: the box around each line, with its baseline at y = 0; `None` for a blank line.
pub(super) fn pitch(boxes: &[Option<(Vec2, Vec2)>]) -> f64 {
    let touching = boxes.windows(2).filter_map(|pair| match pair {
        [Some((upper, _)), Some((_, lower))] => Some(lower.y - upper.y),
        _ => None,
    });
    touching.fold(1.0, f64::max)
}

/// Makes a drawing with one part for each letter. A part's name is its letter and a number, counted from 1 for each
/// letter.
pub(super) fn drawing(letters: &[Letter], colors: &Colors) -> Drawing {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let parts = letters.iter().enumerate().map(|(at, letter)| {
        let text = if letter.text.is_empty() { "?" } else { letter.text.as_str() };
        let count = counts.entry(text).or_default();
        *count += 1;
        letter.part(format!("{text} {count}"), color(colors, at, letters.len()))
    });
    Drawing { parts: parts.collect() }
}

/// Returns the colour of letter number `at`, counted from 0, in a text of `of` letters.
fn color(colors: &Colors, at: usize, of: usize) -> Rgb {
    match colors {
        Colors::One(color) => *color,
        Colors::Each(list) => {
            let turn = at.checked_rem(list.len()).and_then(|turn| list.get(turn));
            turn.copied().unwrap_or(Rgb::new(255, 255, 255))
        }
        Colors::Rainbow => {
            let place = at as f64 / (of.max(2) - 1) as f64 * (RAINBOW.len() - 1) as f64;
            let band = (place as usize).min(RAINBOW.len() - 2);
            RAINBOW[band].mixed(RAINBOW[band + 1], place - band as f64)
        }
    }
}

/// Returns a note that names the characters that no font has. `None` if there are none.
fn missing(characters: &BTreeMap<char, usize>) -> Option<Note> {
    if characters.is_empty() {
        return None;
    }
    let count: usize = characters.values().sum();
    let named = named(characters);
    let message =
        format!("{count} signs are left out, as no font has them: {named}. Choose a font that has them.");
    Some(Note::new("text-missing-sign", message))
}

fn named(characters: &BTreeMap<char, usize>) -> String {
    let named = characters.keys().take(NAMED_MAX).map(|c| format!("{c} (U+{:04X})", u32::from(*c)));
    let list = named.collect::<Vec<String>>().join(", ");
    match characters.len().saturating_sub(NAMED_MAX) {
        0 => list,
        more => format!("{list} and {more} others"),
    }
}

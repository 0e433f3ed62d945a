//! Splits one text into several drawings: one for each word, or one for each step of scrolling.

use lightbots_base::Vec2;

use super::clip::clipped;
use super::layout::{check, draw, drawing, lay_out};
use super::letter::Letter;
use super::lines::words;
use super::settings::TextSettings;
use crate::drawing::{Drawing, DrawingPart};
use crate::error::{DrawError, Made, Note};
use crate::geometry::bounds;

/// Largest number of steps of a scrolling text: five minutes at ten steps per second. Bounds the time and memory that
/// the drawings take.
pub const STEPS_MAX: usize = 3_000;

/// Largest number of points of all steps together. This number takes about 100 MB of memory.
const POINTS_MAX: usize = 4_000_000;

/// One of several drawings.
#[derive(Clone, Debug, PartialEq)]
pub struct Page {
    /// The word that the drawing shows, or its step, such as "step 3".
    pub title: String,
    /// The drawing, and what is missing from it.
    pub made: Made,
}

/// Makes one drawing for each word. The first letter of each word has the first colour. A word without any sign that
/// can be drawn is left out, and a note in the first drawing says so.
///
/// # Errors
/// As for [`draw`].
pub fn per_word(settings: &TextSettings) -> Result<Vec<Page>, DrawError> {
    check(settings)?;
    let mut pages: Vec<Page> = Vec::new();
    let mut left_out = Vec::new();
    for (_, word) in words(settings.words) {
        match draw(&TextSettings { words: word, wrap: None, ..settings.clone() }) {
            Ok(made) => pages.push(Page { title: word.to_owned(), made }),
            Err(error) if matches!(error.code, "text-no-glyphs" | "text-empty") => {
                left_out.push(Note::new(
                    "text-missing-word",
                    format!("The word {word} is left out. {}", error.message),
                ));
            }
            Err(error) => return Err(error),
        }
    }
    match pages.first_mut() {
        Some(first) => first.made.notes.append(&mut left_out),
        None => return draw(settings).map(|made| vec![Page { title: settings.words.to_owned(), made }]),
    }
    Ok(pages)
}

/// Moves a text on one line from right to left behind a window, in equal steps. Each step gives a drawing.
///
/// A text wider than the window begins with its first letter at the left edge and ends with its last letter at the
/// right edge. A narrower text moves from the right edge to the left edge. The window begins at x = 0 and is `window`
/// cap heights wide, 0.5 to 1,000. Steps in which the window is empty are left out.
///
/// # Errors
/// As for [`draw`], `text-settings` for a window or a number of steps out of range, and `text-too-detailed` for too
/// many points.
pub fn scrolling(settings: &TextSettings, window: f64, steps: usize) -> Result<Vec<Page>, DrawError> {
    check(settings)?;
    if !(0.5..=1_000.0).contains(&window) || !(1..=STEPS_MAX).contains(&steps) {
        let message = format!(
            "A window {window} cap heights wide with {steps} steps cannot scroll; choose a width from 0.5 to 1000 and from 1 to \
             {STEPS_MAX} steps."
        );
        return Err(DrawError::new("text-settings", message));
    }
    let one_line = words(settings.words).map(|(_, word)| word).collect::<Vec<&str>>().join(" ");
    let (letters, mut notes) = lay_out(&TextSettings { words: &one_line, wrap: None, ..settings.clone() })?;
    let colored = drawing(&letters, &settings.colors);
    let width = bounds(letters.iter().flat_map(Letter::ink)).map_or(0.0, |(_, high)| high.x);
    let (start, end) = ((window - width).max(0.0), (window - width).min(0.0));
    let mut pages = Vec::new();
    let mut points = 0;
    for step in 0..steps {
        let share = step as f64 / steps.saturating_sub(1).max(1) as f64;
        let shift = start + (end - start) * share;
        let parts = cut(&letters, &colored, shift, window);
        points += parts
            .iter()
            .flat_map(|part| &part.areas)
            .flat_map(|area| &area.rings)
            .map(Vec::len)
            .sum::<usize>();
        if points > POINTS_MAX {
            let message = "All steps together have too many points. Scroll in fewer steps, or behind a narrower window.";
            return Err(DrawError::new("text-too-detailed", message));
        }
        if !parts.is_empty() {
            let made = Made { drawing: Drawing { parts }, notes: std::mem::take(&mut notes) };
            pages.push(Page { title: format!("step {}", step + 1), made });
        }
    }
    Ok(pages)
}

/// Returns the parts of the drawing that are visible in a window when the text is moved to the right by `shift`, in cap
/// heights.
fn cut(letters: &[Letter], colored: &Drawing, shift: f64, window: f64) -> Vec<DrawingPart> {
    let parts = letters.iter().zip(&colored.parts).filter_map(|(letter, part)| {
        let (low, high) = bounds(letter.ink())?;
        if high.x + shift <= 0.0 || low.x + shift >= window {
            return None;
        }
        let color = part
            .areas
            .first()
            .map(|area| area.ink.color)
            .or(part.strokes.first().map(|stroke| stroke.ink.color))?;
        let cut = clipped(&letter.clone().moved(Vec2::new(shift, 0.0)), 0.0, window);
        cut.ink().next().is_some().then(|| cut.part(part.name.clone(), color))
    });
    parts.collect()
}

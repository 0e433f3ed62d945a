//! Decides which colours of a page become lights. Colours of the paper do not; black becomes white.

use lightbots_base::Rgb;

use crate::error::Note;
use crate::ink::Ink;
use crate::picture::lifted;
use crate::svg::canvas::{Canvas, Line, Surface};

/// A colour is dark if its brightest channel is below this, 0 to 255: a light of this colour would be off. An example
/// is printers' black, #231f20.
const DARK_BELOW: u8 = 40;
/// A colour counts as white paper if its darkest channel is at least this, 0 to 255.
const PAPER_FROM: u8 = 225;

/// Removes the background and brightens gradients. If areas or lines are dark, they are removed with a dark background.
/// Otherwise they become white, and areas and lines as white as paper are removed. Returns notes about the background,
/// white and black.
pub fn light(canvas: &mut Canvas) -> Vec<Note> {
    lift_gradients(canvas);
    let background = remove_background(canvas);
    let mut notes = Vec::new();
    if let Some(color) = background {
        let message = format!("The background, {color}, is left out: it would need most robots.");
        notes.push(Note::new("svg-background", message));
    }
    if !count(canvas, is_dark) {
        return notes;
    }
    if background.is_some_and(is_dark) {
        remove(canvas, is_dark);
        return notes;
    }
    if count(canvas, is_paper) {
        remove(canvas, is_paper);
        let message = "White areas and lines are left dark, because black ones are lit.";
        notes.push(Note::new("svg-white", message));
    }
    if count(canvas, |color| !is_dark(color)) {
        let message = "Black areas and lines are lit white, because a black light is off.";
        notes.push(Note::new("svg-black", message));
    }
    for ink in inks_mut(canvas) {
        if is_dark(ink.color) {
            *ink = Rgb::new(255, 255, 255).into();
        }
    }
    notes
}

/// Makes the dark stops of gradients bright enough for lights.
fn lift_gradients(canvas: &mut Canvas) {
    let gradients = inks_mut(canvas).filter_map(|ink| ink.gradient.as_mut());
    for (_, color) in gradients.flat_map(|gradient| &mut gradient.stops) {
        *color = lifted(*color);
    }
}

/// Inks of all areas and lines.
fn inks_mut(canvas: &mut Canvas) -> impl Iterator<Item = &mut Ink> {
    let areas = canvas.surfaces.iter_mut().map(|surface| &mut surface.ink);
    areas.chain(canvas.lines.iter_mut().map(|line| &mut line.ink))
}

/// Removes all background areas, unless there is nothing else. Returns the colour of the largest one; `None` if nothing
/// was removed.
fn remove_background(canvas: &mut Canvas) -> Option<Rgb> {
    let others = canvas.surfaces.iter().any(|surface| !surface.background) || !canvas.lines.is_empty();
    if !others {
        return None;
    }
    let behind = canvas.surfaces.iter().filter(|surface| surface.background);
    let largest =
        behind.max_by(|a, b| a.region.area().total_cmp(&b.region.area())).map(|surface| surface.ink.color);
    canvas.surfaces.retain(|surface| !surface.background);
    largest
}

/// Whether the colour of any area or line passes the test.
fn count(canvas: &Canvas, test: impl Fn(Rgb) -> bool) -> bool {
    let areas = canvas.surfaces.iter().map(|surface| surface.ink.color);
    areas.chain(canvas.lines.iter().map(|line| line.ink.color)).any(test)
}

/// Removes all areas and lines whose colour passes the test, unless nothing would be left.
fn remove(canvas: &mut Canvas, test: impl Fn(Rgb) -> bool) {
    if count(canvas, |color| !test(color)) {
        canvas.surfaces.retain(|surface: &Surface| !test(surface.ink.color));
        canvas.lines.retain(|line: &Line| !test(line.ink.color));
    }
}

fn is_dark(color: Rgb) -> bool {
    color.r.max(color.g).max(color.b) < DARK_BELOW
}

fn is_paper(color: Rgb) -> bool {
    color.r.min(color.g).min(color.b) >= PAPER_FROM
}

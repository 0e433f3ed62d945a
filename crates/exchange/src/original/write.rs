//! From a show to a file of the original. The original loads a file only if all fields of its editor's state are there,
//! so they are derived from the show.

use lightbots_base::{Rgb, Vec2};
use lightbots_plan::ShowPlan;
use lightbots_show::{Frame, Issue, Issues, Pixel, Show, frame_label};

use super::canvas::{CANVAS_PX, canvas_from_stage};
use crate::format::Written;
use crate::json::text::{lines, number, quoted};

/// Side of a picture in the original's row of frames, canvas pixels: `pixelTimelineLocation` in the original's files
/// goes from 0 to this value.
const TIMELINE_PX: f64 = 100.0;
/// Number of robots of the original's fleet. The original's controller assigns pixels only once 30 robots have reported.
const ROBOTS: usize = 30;

pub(crate) fn encode(show: &Show, _: Option<&ShowPlan>) -> Written {
    Written { bytes: text(show).into_bytes(), issues: wrong_count(show) }
}

fn text(show: &Show) -> String {
    lines(show.frames.iter().enumerate().map(|(index, frame)| frame_text(frame, index == 0)), "") + "\n"
}

/// A warning about the first frame whose number of pixels is not `ROBOTS`.
fn wrong_count(show: &Show) -> Issues {
    let wrong = show.frames.iter().position(|frame| frame.pixels.len() != ROBOTS);
    let warning = wrong.map(|index| {
        let frame = &show.frames[index];
        let what = format!(
            "{} has {} pixels; the original plays only shows of {ROBOTS}: use it with LightBots only",
            frame_label(index, &frame.name),
            frame.pixels.len()
        );
        Issue::warning("not-30-pixels", what).in_frame(index)
    });
    warning.into_iter().collect()
}

fn frame_text(frame: &Frame, selected: bool) -> String {
    // The original numbers its robots from 0 without gaps. Pixels are sorted by id, so their index is that number.
    let pixels = frame.pixels.iter().enumerate().map(|(number, pixel)| pixel_text(number, pixel));
    format!(
        "{{\"name\":{},\"pixels\":{},\"selected\":{selected},\"airTime\":{},\"selectedPixels\":[]}}",
        quoted(&frame.name),
        lines(pixels, ""),
        real(frame.air_time_s)
    )
}

fn pixel_text(number: usize, pixel: &Pixel) -> String {
    let canvas = canvas_from_stage(pixel.at);
    let color = color(pixel.color);
    format!(
        "{{\"pixelLocation\":{0},\"physicalLocation\":{1},\"pixelPreviewLocation\":{0},\"pixelTimelineLocation\":{2},\
         \"color\":{color},\"previewColor\":{color},\"pixelId\":{number}}}",
        location(canvas),
        location(pixel.at),
        location(canvas * (TIMELINE_PX / CANVAS_PX))
    )
}

fn location(at: Vec2) -> String {
    format!("{{\"X\":{},\"Y\":{}}}", real(at.x), real(at.y))
}

/// A colour as JSON. Its components are 0 to 1 with the precision of 32-bit numbers, as in the original's files. A
/// colour of such a file is thus written as it was read.
fn color(color: Rgb) -> String {
    let share = |byte: u8| match f64::from(f32::from(byte) / 255.0) {
        whole if whole.fract() == 0.0 => format!("{whole:.1}"),
        share => share.to_string(),
    };
    format!("{{\"R\":{},\"G\":{},\"B\":{}}}", share(color.r), share(color.g), share(color.b))
}

/// A number with a decimal point, because the original's files have one in every number.
fn real(value: f64) -> String {
    let text = number(value);
    if text.contains('.') || text == "null" { text } else { text + ".0" }
}

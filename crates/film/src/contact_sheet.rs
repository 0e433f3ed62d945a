//! Puts the frames of a show on one sheet, as PNG.

use std::fmt::Write as _;

use lightbots_draw::font_faces;
use lightbots_lighting::PlannedShow;
use lightbots_show::{Show, clock_label};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::camera::FilmView;
use crate::film::{FilmSize, ShowFilm};
use crate::words::{numbered, short};

/// Largest number of frames on a sheet.
pub const SHEET_FRAMES_MAX: usize = 400;
/// Largest number of columns of pictures.
const COLUMNS_MAX: usize = 8;
/// Width of a row of pictures and the gaps between them if no size of a picture is given, pixels.
const WIDTH_MAX: usize = 3_200;
/// Smallest and largest width of a picture if no size is given, pixels.
const PICTURE: (usize, usize) = (160, 480);
/// Space around pictures, pixels.
const GAP: usize = 16;
/// Height of the line of text below each picture, pixels.
const LINE: usize = 30;
/// Height of the heading, pixels.
const HEADING: usize = 64;
/// sRGB code of the sheet's background, a dark grey.
const PAPER: u8 = 12;

/// Positions and sizes on a sheet, pixels.
struct Layout {
    columns: usize,
    picture: (usize, usize),
    size: (usize, usize),
}

/// Returns a contact sheet as PNG. It has a picture of each frame in the middle of the frame's air time, with number, name
/// and start of the air time. `size` is width and height of a picture in pixels; `None`: the size depends on the number of
/// frames. Only the first [`SHEET_FRAMES_MAX`] frames are shown.
pub fn contact_sheet(
    show: &Show,
    planned: &PlannedShow<'_>,
    view: FilmView,
    size: Option<(u32, u32)>,
) -> Vec<u8> {
    let frames = planned.times().len().min(SHEET_FRAMES_MAX);
    let layout = Layout::new(frames, show, view, size);
    let (width, height) = layout.size;
    let mut sheet = vec![PAPER; 3 * width * height];
    let of_picture = FilmSize { width: layout.picture.0 as u32, height: layout.picture.1 as u32, fps: 1.0 };
    let mut film = ShowFilm::new(planned, &show.stage, view, of_picture);
    for (frame, times) in planned.times().iter().take(frames).enumerate() {
        let at_s = planned.first_drive_s() + (times.air_s + times.end_s) / 2.0;
        let picture = film.picture_at(at_s);
        let (left, top) = layout.corner(frame);
        for (row, pixels) in picture.chunks_exact(3 * layout.picture.0).enumerate() {
            let start = 3 * ((top + row) * width + left);
            sheet[start..start + pixels.len()].copy_from_slice(pixels);
        }
    }
    letter(&mut sheet, &layout, show, planned, frames);
    encoded(&sheet, layout.size)
}

impl Layout {
    fn new(frames: usize, show: &Show, view: FilmView, size: Option<(u32, u32)>) -> Self {
        let columns = ((frames as f64).sqrt().ceil() as usize).clamp(1, COLUMNS_MAX);
        let picture = size.map_or_else(
            || {
                let width = (WIDTH_MAX / columns - GAP).clamp(PICTURE.0, PICTURE.1);
                let aspect = match view {
                    FilmView::Above => (show.stage.depth_m / show.stage.width_m).clamp(0.4, 1.6),
                    FilmView::Front => 9.0 / 16.0,
                };
                (width, (width as f64 * aspect).round() as usize)
            },
            |(width, height)| (width as usize, height as usize),
        );
        let rows = frames.div_ceil(columns).max(1);
        let size = (GAP + columns * (picture.0 + GAP), HEADING + rows * (picture.1 + LINE + GAP));
        Self { columns, picture, size }
    }

    /// Returns left and top edge of the picture of the frame with the index `frame`, pixels.
    fn corner(&self, frame: usize) -> (usize, usize) {
        let (column, row) = (frame % self.columns, frame / self.columns);
        (GAP + column * (self.picture.0 + GAP), HEADING + row * (self.picture.1 + LINE + GAP))
    }
}

/// Writes the heading of the sheet, and below each picture the frame's number, name and start of the air time.
fn letter(sheet: &mut [u8], layout: &Layout, show: &Show, planned: &PlannedShow<'_>, frames: usize) {
    let (width, height) = layout.size;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" font-family=\"Lato\" fill=\"#dcdcdc\">"
    );
    let mut line = |x: usize, y: usize, size: usize, end: bool, words: &str| {
        let anchor = if end { " text-anchor=\"end\"" } else { "" };
        let _ =
            write!(svg, "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\"{anchor}>{}</text>", escaped(words));
    };
    let title = if show.name.trim().is_empty() { "A show" } else { &show.name };
    line(GAP, 42, 28, false, &short(title, layout.size.0 / 36));
    let facts = format!(
        "{} robots · {} frames · {}",
        planned.robots(),
        show.frames.len(),
        clock_label(planned.duration_s())
    );
    if layout.size.0 > 700 {
        line(width - GAP, 42, 18, true, &facts);
    }
    for (frame, times) in planned.times().iter().take(frames).enumerate() {
        let (left, top) = layout.corner(frame);
        let y = top + layout.picture.1 + 20;
        let moment = clock_label(planned.first_drive_s() + times.air_s);
        line(left, y, 15, false, &numbered(frame, &show.frames[frame].name, layout.picture.0 / 12));
        line(left + layout.picture.0, y, 15, true, &moment);
    }
    svg.push_str("</svg>");
    let options = Options { fontdb: font_faces(), ..Options::default() };
    // The SVG is written by this function, and the size of the sheet is limited.
    let (Ok(tree), Some(mut text)) =
        (Tree::from_str(&svg, &options), Pixmap::new(width as u32, height as u32))
    else {
        return;
    };
    resvg::render(&tree, Transform::identity(), &mut text.as_mut());
    for (below, over) in sheet.chunks_exact_mut(3).zip(text.pixels()) {
        for (below, over_channel) in below.iter_mut().zip([over.red(), over.green(), over.blue()]) {
            let rest = u16::from(*below) * u16::from(255 - over.alpha()) / 255;
            *below = over_channel.saturating_add(rest as u8);
        }
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn encoded(sheet: &[u8], (width, height): (usize, usize)) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    // Writing to memory does not fail, and the bytes fill the sheet.
    let _ = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(sheet)?;
        writer.finish()
    });
    bytes
}

//! The starting places as a show of one frame, which robots play when they are sent home.

use lightbots_base::Rgb;
use lightbots_show::{Frame, Pixel, Show, back_rows, starting_places};

/// Id of the first pixel of the starting places. It is far above the ids of shows, so that no binding by the operator
/// concerns these pixels.
const FIRST_ID: u32 = 4_000_000_000;
/// Colour of robots on the drive to their starting places: dim, but visible.
const LIGHT: Rgb = Rgb::new(0x40, 0x32, 0x1e);

/// Returns a show whose only frame has a pixel at each starting place of `show`. If these are fewer than `robots`, it
/// has that number of places in rows along the back edge of the floor.
pub(crate) fn show(show: &Show, robots: usize) -> Show {
    let mut places = starting_places(show);
    if places.len() < robots {
        places = back_rows(&show.stage, robots);
    }
    let pixel = |(index, at)| Pixel { id: FIRST_ID + index, at, color: LIGHT, ..Pixel::default() };
    let pixels = (0..).zip(places).map(pixel).collect();
    let frame = Frame { name: "Home".into(), pixels, ..Frame::default() };
    Show { name: show.name.clone(), stage: show.stage.clone(), frames: vec![frame], ..Show::default() }
}

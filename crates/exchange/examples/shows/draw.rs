//! Makes frames and shows from coloured dots.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Pixel, Show};

/// A place in stage metres and its colour.
pub type Dot = (Vec2, Rgb);

/// A frame whose pixels are numbered in the order of the dots.
pub fn frame(name: &str, air_time_s: f64, dots: impl IntoIterator<Item = Dot>) -> Frame {
    let pixel = |(id, (at, color))| Pixel { id, at: tidy(at), color, ..Pixel::default() };
    Frame {
        name: name.into(),
        air_time_s,
        transition_s: None,
        easing: Easing::Swift,
        pixels: (0..).zip(dots).map(pixel).collect(),
        ..Frame::default()
    }
}

/// A frame whose pixels are numbered from left to right, as the original numbers its robots.
pub fn frame_by_x(name: &str, air_time_s: f64, dots: impl IntoIterator<Item = Dot>) -> Frame {
    let mut dots: Vec<Dot> = dots.into_iter().map(|(at, color)| (tidy(at), color)).collect();
    dots.sort_by(|(a, _), (b, _)| a.x.total_cmp(&b.x).then(b.y.total_cmp(&a.y)));
    frame(name, air_time_s, dots)
}

/// A show on a square floor.
pub fn show(name: &str, side_m: f64, frames: Vec<Frame>) -> Show {
    let show = Show { name: name.into(), frames, ..Show::default() };
    lightbots_show::with_floor(show, side_m, side_m)
}

/// All places in one colour.
pub fn lit(places: impl IntoIterator<Item = Vec2>, color: Rgb) -> Vec<Dot> {
    places.into_iter().map(|at| (at, color)).collect()
}

/// Dots at these places, each with the colour that `shade` returns for it.
pub fn shaded(places: impl IntoIterator<Item = Vec2>, shade: impl Fn(Vec2) -> Rgb) -> Vec<Dot> {
    places.into_iter().map(|at| (at, shade(at))).collect()
}

/// Rounds a place to tenths of millimetres, as files do.
pub fn tidy(at: Vec2) -> Vec2 {
    let round = |metres: f64| (metres * 1e4).round() / 1e4 + 0.0;
    Vec2::new(round(at.x), round(at.y))
}

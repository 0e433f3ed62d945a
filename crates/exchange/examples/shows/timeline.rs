//! Layers and motions for example shows.

use lightbots_base::Vec2;
use lightbots_show::{Frame, Layer, PictureMotion, Show};

use super::draw::tidy;

/// The show with these layers, which are JSON as in docs/show-format.md. Frames get the ids `1`, `2` and so on.
pub fn with_layers(show: Show, layers: &str) -> Show {
    let number = |(index, frame): (usize, Frame)| Frame { id: Some((index + 1).to_string()), ..frame };
    Show { layers: read(layers), frames: show.frames.into_iter().enumerate().map(number).collect(), ..show }
}

fn read(layers: &str) -> Vec<Layer> {
    let document = format!(r#"{{"lightbots": 2, "frames": [{{"pixels": []}}], "layers": [{layers}]}}"#);
    let loaded = lightbots_exchange::read(document.as_bytes(), None);
    loaded.map(|loaded| loaded.show.layers).unwrap_or_default()
}

/// A frame with the picture of `before`, turned about the centre of the floor by `turn` radians.
pub fn turned(before: &Frame, name: &str, air_time_s: f64, turn: f64) -> Frame {
    let motion = PictureMotion::Turn { center: Vec2::ZERO, turn, size: 1.0 };
    let cos_sin = Vec2::unit(turn);
    let place =
        |at: Vec2| Vec2::new(at.x * cos_sin.x - at.y * cos_sin.y, at.x * cos_sin.y + at.y * cos_sin.x);
    let mut after = moved(before, name, air_time_s, motion);
    for pixel in &mut after.pixels {
        pixel.at = tidy(place(pixel.at));
    }
    after
}

/// A frame with the picture of `before`, after a motion that ends where it began.
pub fn moved(before: &Frame, name: &str, air_time_s: f64, motion: PictureMotion) -> Frame {
    Frame { name: name.into(), air_time_s, motion: Some(motion), ..before.clone() }
}

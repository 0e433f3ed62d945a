//! Shows of frames in rows.

use lightbots_base::{Rgb, Vec2};
use lightbots_show::{Easing, Frame, Pixel, Show};

/// A row of `count` pixels with the ids 0, 1 and so on, 0.1 m apart.
pub fn row(count: u32) -> Vec<Pixel> {
    let place = |id: u32| Vec2::new(f64::from(id) * 0.1 - 1.4, 0.0);
    (0..count)
        .map(|id| Pixel { id, at: place(id), color: Rgb::new(255, 165, 0), ..Pixel::default() })
        .collect()
}

/// A show of these frames.
pub fn show(frames: Vec<Vec<Pixel>>) -> Show {
    let frame = |pixels| Frame {
        name: "Row".into(),
        air_time_s: 1.0,
        transition_s: None,
        easing: Easing::Swift,
        pixels,
        ..Frame::default()
    };
    Show { frames: frames.into_iter().map(frame).collect(), ..Show::default() }
}

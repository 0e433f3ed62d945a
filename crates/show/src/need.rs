//! Number of robots that a show needs.

use std::collections::BTreeSet;

use crate::{MAX_PIXELS, Show};

/// Number of different robots that the pixels of all frames name.
pub fn robots_asked_for(show: &Show) -> usize {
    let pixels = show.frames.iter().flat_map(|frame| &frame.pixels);
    pixels.filter_map(|pixel| pixel.robot.as_deref()).collect::<BTreeSet<_>>().len()
}

/// Number of pixels of the largest frame.
pub fn most_pixels(show: &Show) -> usize {
    show.frames.iter().map(|frame| frame.pixels.len()).max().unwrap_or(0)
}

/// Number of robots that a show is made for, including spare robots, of which at most `MAX_PIXELS` count. Without spare
/// robots, it is the number of pixels of the largest frame, or the number of robots that pixels name if that is larger.
pub fn robots_needed(show: &Show) -> usize {
    let spares = usize::try_from(show.spares).unwrap_or(MAX_PIXELS).min(MAX_PIXELS);
    most_pixels(show).max(robots_asked_for(show)) + spares
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, Pixel};
    use lightbots_base::{Rgb, Vec2};

    #[test]
    fn named_robots_are_needed_even_if_no_frame_has_as_many_pixels() {
        let frame = |names: &[Option<&str>]| Frame {
            name: String::new(),
            air_time_s: 1.0,
            transition_s: None,
            easing: Default::default(),
            pixels: (0..)
                .zip(names)
                .map(|(id, name)| {
                    let robot = name.map(str::to_owned);
                    Pixel { id, at: Vec2::ZERO, color: Rgb::BLACK, robot, ..Pixel::default() }
                })
                .collect(),
            ..Frame::default()
        };
        let of = |frames: Vec<Frame>| robots_needed(&Show { frames, ..Show::default() });
        assert_eq!(of(vec![frame(&[None, Some("a")]), frame(&[Some("b"), Some("c")])]), 3);
        assert_eq!(of(vec![frame(&[None, Some("a")]), frame(&[Some("a"), None])]), 2);
        assert_eq!(of(vec![]), 0);
        let of_spares =
            |spares| robots_needed(&Show { spares, frames: vec![frame(&[None])], ..Show::default() });
        assert_eq!((of_spares(2), of_spares(u32::MAX)), (3, 1 + MAX_PIXELS));
    }
}

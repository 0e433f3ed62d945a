//! How many robots a show needs.

use std::collections::BTreeSet;

use crate::Show;

/// How many different robots pixels ask for by name.
pub fn robots_asked_for(show: &Show) -> usize {
    let pixels = show.frames.iter().flat_map(|frame| &frame.pixels);
    pixels.filter_map(|pixel| pixel.robot.as_deref()).collect::<BTreeSet<_>>().len()
}

/// How many pixels the largest frame of a show has.
pub fn most_pixels(show: &Show) -> usize {
    show.frames.iter().map(|frame| frame.pixels.len()).max().unwrap_or(0)
}

/// How many robots a show needs: one for each pixel of its largest frame, and everybody a pixel asks for by name.
pub fn robots_needed(show: &Show) -> usize {
    most_pixels(show).max(robots_asked_for(show))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Frame, Pixel};
    use lightbots_base::{Rgb, Vec2};

    #[test]
    fn who_is_asked_for_by_name_is_needed_even_where_no_frame_has_so_many_pixels() {
        let frame = |names: &[Option<&str>]| Frame {
            name: String::new(),
            air_time_s: 1.0,
            transition_s: None,
            easing: Default::default(),
            identity: None,
            pixels: (0..)
                .zip(names)
                .map(|(id, name)| {
                    let robot = name.map(str::to_owned);
                    Pixel { id, at: Vec2::ZERO, color: Rgb::BLACK, robot }
                })
                .collect(),
        };
        let of = |frames: Vec<Frame>| robots_needed(&Show { frames, ..Show::default() });
        assert_eq!(of(vec![frame(&[None, Some("a")]), frame(&[Some("b"), Some("c")])]), 3);
        assert_eq!(of(vec![frame(&[None, Some("a")]), frame(&[Some("a"), None])]), 2);
        assert_eq!(of(vec![]), 0);
    }
}

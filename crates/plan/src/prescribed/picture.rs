//! A picture as the places of its pixels.

use std::collections::BTreeMap;

use lightbots_base::Vec2;
use lightbots_show::Frame;

/// Places of a frame's pixels by pixel id, stage metres.
pub type PlacesById = BTreeMap<u32, Vec2>;

/// Returns the places of a frame's pixels by pixel id.
pub(super) fn picture(frame: &Frame) -> PlacesById {
    frame.pixels.iter().map(|pixel| (pixel.id, pixel.at)).collect()
}

//! The devices of the one robot that a process is.

use crate::proximity::RAYS;

/// A device's tag as Webots has it: small numbers from 1.
pub type Tag = u16;

/// Names by tag, from 1.
const NAMES: [&[u8]; 17] = [
    b"gps",
    b"compass",
    b"ledrgb",
    b"left wheel motor",
    b"right wheel motor",
    b"left wheel sensor",
    b"right wheel sensor",
    b"ps0",
    b"ps1",
    b"ps2",
    b"ps3",
    b"ps4",
    b"ps5",
    b"ps6",
    b"ps7",
    b"ps8",
    b"ps9",
];
/// How many tags there are, with that of no device.
pub(crate) const TAGS: usize = NAMES.len() + 1;

pub(crate) const GPS: Tag = 1;
pub(crate) const COMPASS: Tag = 2;
pub(crate) const MOTORS: [Tag; 2] = [4, 5];
pub(crate) const SENSORS: [Tag; 2] = [6, 7];
/// The first of the proximity sensors.
const PROXIMITY: Tag = 8;

/// The tag of a name; 0: there is none.
pub(crate) fn tag(name: &[u8]) -> Tag {
    NAMES.iter().position(|known| *known == name).map_or(0, |index| index as Tag + 1)
}

/// Which wheel a tag of `tags` belongs to: 0 left, 1 right.
pub(crate) fn side(tags: [Tag; 2], tag: Tag) -> Option<usize> {
    tags.iter().position(|known| *known == tag)
}

/// Which proximity sensor a tag is, clockwise from the front.
pub(crate) fn proximity(tag: Tag) -> Option<usize> {
    tag.checked_sub(PROXIMITY).map(usize::from).filter(|sensor| *sensor < RAYS)
}

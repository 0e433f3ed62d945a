//! Devices of the robot that this process controls.

use crate::proximity::RAYS;

/// Number of a device, as in Webots: a small number from 1; 0 is no device.
pub type Tag = u16;

/// Names of the devices. The tag of a device is its index here plus 1.
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
/// Number of possible tags, including tag 0.
pub(crate) const TAGS: usize = NAMES.len() + 1;

/// Tag of the GPS in `NAMES`.
pub(crate) const GPS: Tag = 1;
/// Tag of the compass in `NAMES`.
pub(crate) const COMPASS: Tag = 2;
/// Tags of the left and right motor in `NAMES`.
pub(crate) const MOTORS: [Tag; 2] = [4, 5];
/// Tags of the left and right wheel sensor in `NAMES`.
pub(crate) const SENSORS: [Tag; 2] = [6, 7];
/// Tag of the first proximity sensor in `NAMES`.
const PROXIMITY: Tag = 8;

/// Returns the tag of a device by its name; 0 if there is no such device.
pub(crate) fn tag(name: &[u8]) -> Tag {
    NAMES.iter().position(|known| *known == name).map_or(0, |index| index as Tag + 1)
}

/// Returns the wheel to which a tag in `tags` belongs: 0 left, 1 right. `None` if the tag is not in `tags`.
pub(crate) fn side(tags: [Tag; 2], tag: Tag) -> Option<usize> {
    tags.iter().position(|known| *known == tag)
}

/// Returns the index of the proximity sensor with this tag, counted clockwise from the front, from 0. `None` for other
/// devices.
pub(crate) fn proximity(tag: Tag) -> Option<usize> {
    tag.checked_sub(PROXIMITY).map(usize::from).filter(|sensor| *sensor < RAYS)
}

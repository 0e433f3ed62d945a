//! VVIZ 1.0, Verge Aero's format for visualisation: JSON with steps of places and held colours. The floor's x is x, its y
//! is z, and y is the height.

mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::encode;

use crate::json;

/// Whether the bytes begin like an object, and have the performances of VVIZ and not the version of our format.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    let holds = |word: &[u8]| bytes.windows(word.len()).any(|window| window == word);
    json::first_byte(bytes) == Some(b'{') && holds(b"\"performances\"") && !holds(b"\"lightbots\"")
}

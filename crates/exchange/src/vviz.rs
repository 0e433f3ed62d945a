//! VVIZ 1.0, Verge Aero's format for visualisation: JSON with steps of places and held colours. Its x is x of the
//! floor, its z is y of the floor, and its y is the height.

mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::encode;

use crate::json;

/// Whether the bytes begin like a JSON object, and contain the words `"performances"` of VVIZ but not `"lightbots"` of
/// our format.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    let holds = |word: &[u8]| bytes.windows(word.len()).any(|window| window == word);
    json::first_byte(bytes) == Some(b'{') && holds(b"\"performances\"") && !holds(b"\"lightbots\"")
}

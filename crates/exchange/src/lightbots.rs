//! Our own format, versions 1 and 2: a JSON object with the fields `lightbots`, `stage`, `frames` and more.
//! `docs/show-format.md` describes every field.

mod assets;
mod fields;
mod motion;
mod read;
mod settings;
mod sources;
mod timeline;
mod trajectories;
mod write;

pub(crate) use read::read;
pub use read::read_layer;
pub(crate) use write::encode;

use crate::json;

/// Whether the bytes begin like a JSON object. An object without the field `lightbots` is accepted here; [`read()`]
/// refuses it with a message.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    json::first_byte(bytes) == Some(b'{')
}

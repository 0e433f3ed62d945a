//! The format of the original system: a JSON list of frames.

mod canvas;
mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::encode;

use crate::json;

/// Whether the bytes begin like a JSON list.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    json::first_byte(bytes) == Some(b'[')
}

//! Our own format, version 1: a JSON object with the fields `lightbots`, `stage`, `frames` and more.

mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::encode;

use crate::json;

/// Whether the bytes begin like a JSON object. An object without the field `lightbots` is refused by [`read`], which
/// says so.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    json::first_byte(bytes) == Some(b'{')
}

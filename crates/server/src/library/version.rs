//! Version of a document, and time of the last change of its file.

use std::path::Path;
use std::time::UNIX_EPOCH;

/// Returns the version of a document in quotes: the FNV-1a hash of its bytes, and their number.
pub(super) fn etag(bytes: &[u8]) -> String {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    format!("\"{:016x}-{:x}\"", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step), bytes.len())
}

/// Returns when a file was last written, milliseconds since the start of 1970 (UTC); 0 if that is not known.
pub(super) fn modified_ms(path: &Path) -> u64 {
    let modified = std::fs::metadata(path).and_then(|about| about.modified()).ok();
    modified.and_then(|time| time.duration_since(UNIX_EPOCH).ok()).map_or(0, |since| since.as_millis() as u64)
}

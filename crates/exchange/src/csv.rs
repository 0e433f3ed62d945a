//! Skybrush's CSV: a zip archive with one table per robot, whose file is named after the robot. Rows have a time in
//! milliseconds, a place in metres and a colour in linear light. Places and colours change linearly between rows.

mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::encode;

use crate::zip_files::holds;
use crate::{archive, skyc};

/// First line of a table.
const HEAD: &str = "Time [msec],x [m],y [m],z [m],Red,Green,Blue";

/// Whether the bytes are a zip archive with at least one table and without a document of our format or of Skybrush.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    let is_document = |name: &[u8]| [archive::DOCUMENT, skyc::DOCUMENT].map(str::as_bytes).contains(&name);
    holds(bytes, is_table_bytes) && !holds(bytes, is_document)
}

/// Whether a file in an archive is a table, by its name.
fn is_table(name: &str) -> bool {
    is_table_bytes(name.as_bytes())
}

/// Whether a file in an archive is a table, by its name: it ends with `.csv`, in upper or lower case. The name need not
/// be UTF-8. Files in `__MACOSX/` are none: macOS adds them to its archives.
fn is_table_bytes(name: &[u8]) -> bool {
    name.len() > 4 && name[name.len() - 4..].eq_ignore_ascii_case(b".csv") && !name.starts_with(b"__MACOSX/")
}

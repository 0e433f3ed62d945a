//! Reads the bytes of a file of any format.

use lightbots_show::excerpt;

use crate::error::ReadError;
use crate::format::Loaded;
use crate::json::{self, Json};
use crate::limits::MAX_BYTES;
use crate::table::{for_file, formats_in_words, sniff};

/// Reads a file of any format. The bytes alone decide which format it is. `file` is the name of the file, if known, and
/// only makes messages clearer.
///
/// # Errors
/// If the bytes are not a show. A show that can be read but must not be played is not an error here:
/// [`validate`](lightbots_show::validate) finds the issues of the show.
pub fn read(bytes: &[u8], file: Option<&str>) -> Result<Loaded, ReadError> {
    if bytes.len() > MAX_BYTES {
        let size_mb = bytes.len() as f64 / 1e6;
        let (most_mb, most_mib) = (MAX_BYTES as f64 / 1e6, MAX_BYTES >> 20);
        let what = format!(
            "the file has {size_mb:.1} MB; a show has at most {most_mb:.1} MB ({most_mib} MiB): split it into several"
        );
        return Err(ReadError::whole("too-big", what));
    }
    if json::first_byte(bytes).is_none() {
        return Err(ReadError::whole("empty-file", "the file is empty; a show has at least one frame"));
    }
    match sniff(bytes) {
        Some(format) => (format.read)(bytes),
        None => Err(no_format(bytes, file)),
    }
}

/// The error for bytes that no format accepts.
fn no_format(bytes: &[u8], file: Option<&str>) -> ReadError {
    let remedy = remedy(file);
    match json::text(bytes) {
        Err(error) => ReadError { what: format!("{}; {remedy}", error.what), ..error },
        Ok(text) => {
            let mut json = Json::new(text);
            json.is_at_end();
            json.fail("not-json", format!("this is not JSON; {remedy}"))
        }
    }
}

fn remedy(file: Option<&str>) -> String {
    let file = file.unwrap_or_default();
    match (for_file(file), file.rsplit_once('.')) {
        (Some(format), _) => format!("the show in a {} file is: save the show again", format.ending()),
        (None, Some((_, ending))) => {
            format!("a .{} file is not read: open a {}", excerpt(ending), formats_in_words())
        }
        (None, None) => format!("open a {}", formats_in_words()),
    }
}

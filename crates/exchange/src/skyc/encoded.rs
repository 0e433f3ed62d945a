//! Bytes in a document, as base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use crate::error::ReadError;
use crate::json::Json;

/// Reads a base64 text and returns its bytes. For an error, `what` says what the bytes are, and `remedy` what to do.
pub(super) fn encoded(json: &mut Json<'_>, what: &str, remedy: &str) -> Result<Vec<u8>, ReadError> {
    json.peek()?;
    let begin = json.clone();
    let text = json.text(what)?;
    let bytes = STANDARD.decode(text.as_bytes());
    bytes.map_err(|_| begin.fail("bad-base64", format!("{what} is not base64; {remedy}")))
}

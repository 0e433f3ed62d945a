//! Writes messages to screens as text.

use axum::extract::ws::Utf8Bytes;
use lightbots_api::ToScreen;

/// Returns a message as JSON.
pub fn text(message: &ToScreen) -> Utf8Bytes {
    // The message types have only values that JSON can hold.
    serde_json::to_string(message).unwrap_or_default().into()
}

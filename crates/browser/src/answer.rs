//! Writes answers as JSON, and turns errors and notes into values.

use lightbots_api::MakeRemark;
use lightbots_draw::{DrawError, Note};
use lightbots_exchange::ReadError;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Returns an answer as JSON.
pub(crate) fn text<T: Serialize>(answer: &T) -> String {
    // Answers consist of lists, texts and finite or null numbers, which can always be written as JSON.
    serde_json::to_string(answer).unwrap_or_default()
}

/// Reads a request as JSON.
pub(crate) fn request<T: DeserializeOwned>(request: &str) -> Result<T, MakeRemark> {
    serde_json::from_str(request)
        .map_err(|error| MakeRemark { code: "bad-request".to_owned(), message: error.to_string() })
}

/// Converts an error of `lightbots_draw` into a value for an answer.
pub(crate) fn drawing(error: DrawError) -> MakeRemark {
    MakeRemark { code: error.code.to_owned(), message: error.message }
}

/// Converts an error of reading a show file into a value for an answer.
pub(crate) fn reading(error: &ReadError) -> MakeRemark {
    MakeRemark { code: error.code.to_owned(), message: error.to_string() }
}

/// Converts notes of `lightbots_draw` into values for an answer.
pub(crate) fn notes(notes: &[Note]) -> Vec<MakeRemark> {
    let remark = |note: &Note| MakeRemark { code: note.code.to_owned(), message: note.message.clone() };
    notes.iter().map(remark).collect()
}

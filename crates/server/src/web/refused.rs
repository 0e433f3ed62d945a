//! Refusals of requests.

use axum::Json;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use lightbots_api::Problem;

/// A refusal: HTTP status and one line for people.
#[derive(Debug)]
pub struct Refused(StatusCode, String);

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        (self.0, Json(Problem { error: self.1 })).into_response()
    }
}

/// A refusal with a line for people.
pub fn refuse(status: StatusCode, line: &str) -> Refused {
    Refused(status, line.to_owned())
}

//! Refusals of requests, with a line for people in each.

use axum::Json;
use axum::body::to_bytes;
use axum::extract::Request;
use axum::http::{StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use lightbots_api::Problem;

/// Longest text of a refusal by the web framework that is passed on, bytes. A longer one is replaced by the name of the
/// status.
const LINE_MAX: usize = 4 << 10;

/// A refusal: HTTP status and one line for people.
#[derive(Debug)]
pub struct Refused(StatusCode, String);

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        (self.0, Json(Problem { error: self.1 })).into_response()
    }
}

/// Returns a refusal with a line for people.
pub fn refuse(status: StatusCode, line: &str) -> Refused {
    Refused(status, line.to_owned())
}

/// Gives the web framework's refusals under `/api/` the form of all other refusals: status 4xx with a line in JSON. The
/// framework refuses a body that is no JSON, or a wrong method, with plain text or nothing.
pub async fn uniform(request: Request, next: Next) -> Response {
    let is_api = request.uri().path().starts_with("/api/");
    let answer = next.run(request).await;
    let kind = answer.headers().get(header::CONTENT_TYPE);
    let is_text = kind.is_none_or(|kind| kind.as_bytes().starts_with(b"text/plain"));
    if !is_api || !answer.status().is_client_error() || !is_text {
        return answer;
    }
    let (mut head, body) = answer.into_parts();
    let text = to_bytes(body, LINE_MAX).await.unwrap_or_default();
    let line = match String::from_utf8_lossy(&text).trim() {
        "" => head.status.canonical_reason().unwrap_or("refused").to_owned(),
        line => line.to_owned(),
    };
    let mut answer = refuse(head.status, &line).into_response();
    if let Some(allowed) = head.headers.remove(header::ALLOW) {
        answer.headers_mut().insert(header::ALLOW, allowed);
    }
    answer
}

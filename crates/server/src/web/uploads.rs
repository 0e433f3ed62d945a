//! Bounds the cost of uploads: each body is read whole, within a bounded time, and all bodies together hold a bounded
//! number of bytes.

use std::sync::Arc;
use std::time::Duration;

use axum::body::{Body, HttpBody, to_bytes};
use axum::extract::{Request, State};
use axum::http::StatusCode;
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use tokio::sync::Semaphore;

use super::api::{BODY_MAX, too_long};
use super::refused::refuse;

/// Longest body that counts as short, bytes: a usual show (1,000 robots in 16 frames). Long bodies do not make short
/// ones wait.
const SHORT: usize = 1 << 20;
/// Most bytes of short bodies at once: 32 bodies of the length [`SHORT`].
const SHORT_AT_ONCE: usize = 32 << 20;
/// Most bytes of long bodies at once: one body of greatest length.
const LONG_AT_ONCE: usize = BODY_MAX;
/// Bytes that one permit of a semaphore stands for. A semaphore hands out its permits by a 32-bit number.
const PERMIT_BYTES: usize = 1 << 10;
/// Longest time that a request waits until there is room for its body. It is longer than a short body may take to arrive, so
/// that one slow body before it does not lead to a refusal.
const TURN_WITHIN: Duration = Duration::from_secs(20);
/// Longest time for a body to arrive. A long body also gets [`BODY_WITHIN_MORE`] for each [`SHORT`] bytes, because a
/// poor radio link carries 1 MB/s.
const BODY_WITHIN: Duration = Duration::from_secs(10);
/// Further time for each full [`SHORT`] bytes of a body.
const BODY_WITHIN_MORE: Duration = Duration::from_secs(1);

/// The bytes that further bodies may take. Clones share them.
#[derive(Clone, Debug)]
pub struct Uploads {
    short: Arc<Semaphore>,
    long: Arc<Semaphore>,
}

impl Uploads {
    /// The whole budget of bytes.
    pub fn new() -> Self {
        let room = |bytes| Arc::new(Semaphore::new(bytes / PERMIT_BYTES));
        Self { short: room(SHORT_AT_ONCE), long: room(LONG_AT_ONCE) }
    }

    fn room(&self, bytes: usize) -> Arc<Semaphore> {
        if bytes <= SHORT { self.short.clone() } else { self.long.clone() }
    }
}

/// Reads the body within the bounds, then passes the request on. The bytes of the body count until the request is answered.
pub async fn bound(State(uploads): State<Uploads>, request: Request, next: Next) -> Response {
    if request.body().is_end_stream() {
        return next.run(request).await;
    }
    let hint = request.body().size_hint();
    if hint.lower() > BODY_MAX as u64 {
        return too_long().into_response();
    }
    // A body without a stated length may have the greatest length.
    let bytes = hint.exact().map_or(BODY_MAX, |bytes| bytes as usize);
    let turn = uploads.room(bytes).acquire_many_owned(bytes.div_ceil(PERMIT_BYTES) as u32);
    let Ok(Ok(_turn)) = tokio::time::timeout(TURN_WITHIN, turn).await else {
        let line = "the server is busy with other uploads; try again in a minute";
        return refuse(StatusCode::SERVICE_UNAVAILABLE, line).into_response();
    };
    let (head, body) = request.into_parts();
    let within = BODY_WITHIN + BODY_WITHIN_MORE * (bytes / SHORT) as u32;
    match tokio::time::timeout(within, to_bytes(body, bytes)).await {
        Ok(Ok(bytes)) => next.run(Request::from_parts(head, Body::from(bytes))).await,
        Ok(Err(error)) if is_too_long(&error) => too_long().into_response(),
        Ok(Err(_)) => refuse(StatusCode::BAD_REQUEST, "the upload broke off; try again").into_response(),
        Err(_) => refuse(StatusCode::REQUEST_TIMEOUT, "the upload took too long; try again").into_response(),
    }
}

/// Whether a body was refused because it is too long.
fn is_too_long(error: &axum::Error) -> bool {
    std::error::Error::source(error).is_some_and(|cause| cause.to_string().contains("length limit"))
}

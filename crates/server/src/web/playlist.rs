//! The playlist over HTTP.

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use lightbots_api::{PlaylistChange, PlaylistState};

use super::refused::{Refused, refuse};
use crate::playlist::{ChangeRefused, PlaylistStore};

/// Longest body, bytes: the most entries fit twice.
pub const LONGEST: usize = 128 << 10;

/// `GET /api/playlist`
pub async fn read(State(playlist): State<PlaylistStore>) -> Json<PlaylistState> {
    Json(playlist.state())
}

/// `PUT /api/playlist`
pub async fn change(
    State(playlist): State<PlaylistStore>,
    Json(change): Json<PlaylistChange>,
) -> Result<Json<PlaylistState>, Refused> {
    playlist.change(change).map_err(|refused| match refused {
        ChangeRefused::Wrong(line) => refuse(StatusCode::UNPROCESSABLE_ENTITY, &line),
        ChangeRefused::Stale(line) => refuse(StatusCode::PRECONDITION_FAILED, &line),
        ChangeRefused::Fault(line) => refuse(StatusCode::CONFLICT, &line),
        ChangeRefused::Disk(line) => refuse(StatusCode::INTERNAL_SERVER_ERROR, &line),
    })?;
    Ok(Json(playlist.state()))
}

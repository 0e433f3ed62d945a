//! The playlist over HTTP.

use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use lightbots_api::{PlaylistChange, PlaylistState};

use super::refused::{Refused, refuse};
use crate::playlist::{ChangeRefused, PlaylistStore};

/// Longest body of a change, bytes: more than twice the length of the longest playlist.
pub const LONGEST: usize = 128 << 10;

/// `GET /api/playlist`: returns the playlist and its state.
pub async fn read(State(playlist): State<PlaylistStore>) -> Json<PlaylistState> {
    Json(playlist.state())
}

/// `PUT /api/playlist`: replaces the entries and switches the playlist on or off. Returns the new state. Refused if another
/// client changed the playlist first.
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

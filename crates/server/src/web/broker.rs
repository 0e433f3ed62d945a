//! The broker settings over HTTP.

use std::sync::Arc;

use axum::Json;
use axum::extract::State;
use lightbots_api::BrokerSettings;

use super::state::Shared;

/// `GET /api/broker`: returns the broker settings without secrets.
pub async fn settings(State(shared): State<Arc<Shared>>) -> Json<BrokerSettings> {
    Json(shared.broker.shown())
}

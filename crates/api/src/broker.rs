//! The broker's settings over HTTP.
//!
//! | request | body | answer |
//! |---|---|---|
//! | `GET /api/broker` | | [`BrokerSettings`] |
//!
//! The operation `connect` on the WebSocket changes the settings.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// The kept broker settings, for a form. Passwords and keys never leave the server.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct BrokerSettings {
    /// Addresses of the broker in use or used last, without login, separated by commas; or `embedded`.
    pub address: String,
    /// User name; null: no user name is kept.
    pub user: Option<String>,
    /// Whether the server keeps a password for that user.
    pub has_password: bool,
    /// Certificate authority to trust: PEM text or the path of a file on the server; null: those of the system.
    pub ca: Option<String>,
    /// Client certificate for the broker: PEM text or the path of a file on the server; null: none.
    pub client_cert: Option<String>,
    /// Whether the server keeps the key of the client certificate.
    pub has_client_key: bool,
    /// Address of the server's own broker; null: the server runs none and refuses `embedded`.
    pub embedded: Option<String>,
}

//! The broker's settings over HTTP.
//!
//! | request | answer |
//! |---|---|
//! | `GET /api/broker` | the `BrokerSettings` |
//!
//! They are changed by the operation `connect` on the WebSocket.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// What a form for the broker begins with. Passwords and keys never leave the server.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, TS)]
pub struct BrokerSettings {
    /// The broker that is used, or was last: addresses without login, with commas between them, or `embedded`.
    pub address: String,
    /// User name; null: none.
    pub user: Option<String>,
    /// Whether a password is kept for it.
    pub has_password: bool,
    /// The authority to trust, as it was stated: PEM text, or a file on the server's machine; null: the system's.
    pub ca: Option<String>,
    /// Our own certificate, as it was stated; null: none.
    pub client_cert: Option<String>,
    /// Whether its key is kept.
    pub has_client_key: bool,
    /// Address of the server's own broker; null: it runs none, and `embedded` is refused.
    pub embedded: Option<String>,
}

//! Bounds the keep-alive of clients of MQTT 5.

use std::sync::Arc;

use rmqtt::fitter::{DefaultFitter, FitterManager};
use rmqtt::types::{ConnectInfo, FitterType, Id, ListenerConfig};

use super::limits;

/// rmqtt's rules, but with a longest keep-alive for clients of MQTT 5. The setting of rmqtt itself would also refuse clients
/// of MQTT 3 with a longer keep-alive.
pub struct KeepAlive;

impl FitterManager for KeepAlive {
    fn create(&self, connect: Arc<ConnectInfo>, id: Id, mut listener: ListenerConfig) -> FitterType {
        if matches!(connect.as_ref(), ConnectInfo::V5(..)) {
            Arc::make_mut(&mut listener).max_keepalive = limits::KEEP_ALIVE_S;
        }
        Arc::new(DefaultFitter::new(connect, id, listener))
    }
}

//! Configuration and events of a link, and the state that it shares with its task.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize};

use tokio::sync::Notify;

use crate::BrokerUrl;

/// Configuration of a link.
#[derive(Clone, Debug)]
pub struct LinkConfig {
    /// Broker to connect to. If one of its addresses fails, the next one is tried.
    pub broker: BrokerUrl,
    /// MQTT client id of this program.
    pub client_id: String,
    /// Topic filters to subscribe to, all at QoS 0.
    pub filters: Vec<String>,
    /// Most queued messages in each direction, at least 16; further messages are dropped.
    pub queue: usize,
}

/// Event of a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkEvent {
    /// Connected and subscribed to all filters.
    Connected,
    /// Not connected; sent again when the reason changes. The link keeps trying.
    Disconnected {
        /// Reason, one line for people.
        reason: String,
    },
    /// A message arrived.
    Message {
        /// Topic of the message.
        topic: String,
        /// Payload of the message.
        payload: Vec<u8>,
        /// Whether the broker had stored the message before this subscription (an MQTT retained message).
        retained: bool,
    },
}

/// State that the link, its senders and its task share.
#[derive(Debug, Default)]
pub(crate) struct LinkStatus {
    pub(crate) connected: AtomicBool,
    /// Index of the address in use or used last.
    pub(crate) at: AtomicUsize,
    /// Messages dropped in both directions because a queue was full.
    pub(crate) dropped: AtomicU64,
    /// Wakes the task to replace the connection.
    pub(crate) renew: Notify,
}

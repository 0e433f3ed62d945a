//! What a link takes and gives, and what it shares with its task.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize};

use tokio::sync::Notify;

use crate::BrokerUrl;

/// Configuration of a link.
#[derive(Clone, Debug)]
pub struct LinkConfig {
    /// Broker; its addresses are tried in turn, and the next one when the one in use fails.
    pub broker: BrokerUrl,
    /// MQTT client id of this program.
    pub client_id: String,
    /// Topic filters to subscribe to, all at QoS 0.
    pub filters: Vec<String>,
    /// Most queued messages in each direction; further messages are dropped.
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
        /// The broker kept it from before this subscription.
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

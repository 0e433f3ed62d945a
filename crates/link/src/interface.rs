//! Configuration and events of a link, and the state that it shares with its task.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize};

use tokio::sync::Notify;

use crate::BrokerUrl;

/// Configuration of a link.
#[derive(Clone, Debug)]
pub struct LinkConfig {
    /// Broker to connect to. If the connection to one of its addresses fails, the next address is tried.
    pub broker: BrokerUrl,
    /// MQTT client id of this program.
    pub client_id: String,
    /// Topic filters to subscribe to, all at QoS 0.
    pub filters: Vec<String>,
    /// Largest number of messages that wait to be sent, and of events that wait to be received; less than 16 counts as
    /// 16. Further messages are dropped.
    pub queue: usize,
}

/// Event of a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkEvent {
    /// The link is connected, and the broker has granted all filters.
    Connected,
    /// The link is not connected, and keeps trying. The event is sent again when an attempt fails for a new reason.
    Disconnected {
        /// Why the link is not connected: one line for people.
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
    /// Index of the address of the present connection, or of the last one.
    pub(crate) at: AtomicUsize,
    /// Number of messages, sent and received, that were dropped because a queue was full.
    pub(crate) dropped: AtomicU64,
    /// Wakes the task so that it replaces the connection.
    pub(crate) renew: Notify,
}

//! The link as its user sees it.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use rumqttc::{AsyncClient, PublishOptions};
use tokio::sync::{mpsc, oneshot};

use crate::connection::ConnectionTask;
use crate::interface::{LinkConfig, LinkEvent, LinkStatus};

/// A connection to a broker that reconnects by itself. Dropping the link closes the connection.
#[derive(Debug)]
pub struct Link {
    sender: Sender,
    events: mpsc::Receiver<LinkEvent>,
    stop: Option<oneshot::Sender<()>>,
    task: Option<tokio::task::JoinHandle<()>>,
}

/// The sending half of a link. All clones send over the same connection.
#[derive(Clone, Debug)]
pub struct Sender {
    client: AsyncClient,
    status: Arc<LinkStatus>,
}

impl Link {
    /// Returns a link that begins to connect, and keeps trying until it is closed. Must be called in a tokio runtime.
    pub fn open(config: LinkConfig) -> Self {
        let status = Arc::new(LinkStatus::default());
        let (client, connection, events, stop) = ConnectionTask::new(config, status.clone());
        let task = tokio::spawn(connection.run());
        Self { sender: Sender { client, status }, events, stop: Some(stop), task: Some(task) }
    }

    /// Returns a sending half of this link.
    pub fn sender(&self) -> Sender {
        self.sender.clone()
    }

    /// Waits for the next event; `None` once the link is closed. Cancel-safe.
    pub async fn next(&mut self) -> Option<LinkEvent> {
        self.events.recv().await
    }

    /// Returns the next event if one is waiting; otherwise, and once the link is closed, `None`.
    pub fn try_next(&mut self) -> Option<LinkEvent> {
        self.events.try_recv().ok()
    }

    /// Closes the connection, because the present broker does not deliver messages. Then connects to the next address,
    /// or again to the same one if there is only one. Queued messages are lost. Does nothing if the link is not
    /// connected.
    pub fn renew(&self) {
        if self.sender.is_connected() {
            self.sender.status.renew.notify_one();
        }
    }

    /// Sends the messages that are still queued, for at most half a second, and disconnects. A link that is not
    /// connected just ends.
    pub async fn close(mut self) {
        drop(self.stop.take());
        if let Some(task) = self.task.take() {
            // A failed task has closed the connection as well.
            let _ = task.await;
        }
    }
}

impl Sender {
    /// Publishes a message at QoS 0 and never blocks. Returns `false` if the message was dropped, because there is no
    /// connection or the queue is full.
    pub fn send(&self, topic: &str, payload: Vec<u8>) -> bool {
        if !self.is_connected() {
            return false;
        }
        let sent = self.client.try_publish(topic, payload, PublishOptions::at_most_once()).is_ok();
        if !sent {
            self.status.dropped.fetch_add(1, Ordering::Relaxed);
        }
        sent
    }

    /// Whether the link is connected and has subscribed to all filters. Even then, a message is dropped if the queue is
    /// full.
    pub fn is_connected(&self) -> bool {
        self.status.connected.load(Ordering::Acquire)
    }

    /// Index in [`BrokerUrl::addresses`](crate::BrokerUrl::addresses) of the present connection's address. Without a
    /// connection, that of the last one, or 0 if there was none.
    pub fn address_index(&self) -> usize {
        self.status.at.load(Ordering::Acquire)
    }

    /// Number of messages, sent and received, that were dropped because a queue was full.
    pub fn dropped(&self) -> u64 {
        self.status.dropped.load(Ordering::Relaxed)
    }
}

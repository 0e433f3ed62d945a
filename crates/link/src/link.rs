//! The user's side of a connection.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use rumqttc::{AsyncClient, PublishOptions};
use tokio::sync::{Notify, mpsc, oneshot};

use crate::{BrokerUrl, pump::Pump};

/// What a link needs to know.
#[derive(Clone, Debug)]
pub struct LinkConfig {
    /// Where the broker is. Its addresses are tried in turn, and the next one where one dies.
    pub broker: BrokerUrl,
    /// How this program calls itself there.
    pub client_id: String,
    /// Topic filters to subscribe to, all at QoS 0.
    pub filters: Vec<String>,
    /// How many messages each direction holds at most. A message that comes in or goes out beyond it is dropped.
    pub queue: usize,
}

/// What happens on a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkEvent {
    /// Connected, and subscribed to everything.
    Connected,
    /// Not connected, or not any more; said again when the reason changes. The link keeps trying.
    Disconnected {
        /// One line for people.
        reason: String,
    },
    /// A message came in.
    Message {
        /// Its topic.
        topic: String,
        /// Its bytes.
        payload: Vec<u8>,
    },
}

/// A connection that mends itself. Dropping it closes the connection.
#[derive(Debug)]
pub struct Link {
    sender: Sender,
    events: mpsc::Receiver<LinkEvent>,
    stop: Option<oneshot::Sender<()>>,
    task: Option<tokio::task::JoinHandle<()>>,
}

/// The sending half of a link; clones share it.
#[derive(Clone, Debug)]
pub struct Sender {
    client: AsyncClient,
    shared: Arc<Shared>,
}

/// What both halves and the pump know.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    pub(crate) connected: AtomicBool,
    /// Index of the address in use, or used last.
    pub(crate) at: AtomicUsize,
    /// Messages dropped in either direction because a queue was full.
    pub(crate) dropped: AtomicU64,
    /// Somebody wants another connection.
    pub(crate) renew: Notify,
}

impl Link {
    /// Begins to connect, and keeps trying until the link is closed. Must be called in a tokio runtime.
    pub fn open(config: LinkConfig) -> Self {
        let shared = Arc::new(Shared::default());
        let (client, pump, events, stop) = Pump::new(config, shared.clone());
        let task = tokio::spawn(pump.run());
        Self { sender: Sender { client, shared }, events, stop: Some(stop), task: Some(task) }
    }

    /// The sending half.
    pub fn sender(&self) -> Sender {
        self.sender.clone()
    }

    /// The next event; waits for it. `None` once the link is closed. Cancel-safe.
    pub async fn next(&mut self) -> Option<LinkEvent> {
        self.events.recv().await
    }

    /// The next event, if there is one already.
    pub fn try_next(&mut self) -> Option<LinkEvent> {
        self.events.try_recv().ok()
    }

    /// The connection stands but is of no use: gives it up for one to the next address. What is queued is lost.
    pub fn renew(&self) {
        if self.sender.is_connected() {
            self.sender.shared.renew.notify_one();
        }
    }

    /// Says goodbye to the broker and waits, for half a second at most, until what was sent before is out.
    pub async fn close(mut self) {
        drop(self.stop.take());
        if let Some(task) = self.task.take() {
            // A task that failed has closed the connection as well.
            let _ = task.await;
        }
    }
}

impl Sender {
    /// Publishes at QoS 0. Never blocks; `false` where there is no connection or the queue is full, and the message is
    /// then dropped.
    pub fn send(&self, topic: &str, payload: Vec<u8>) -> bool {
        if !self.is_connected() {
            return false;
        }
        let sent = self.client.try_publish(topic, payload, PublishOptions::at_most_once()).is_ok();
        if !sent {
            self.shared.dropped.fetch_add(1, Ordering::Relaxed);
        }
        sent
    }

    /// Whether messages can go out now.
    pub fn is_connected(&self) -> bool {
        self.shared.connected.load(Ordering::Acquire)
    }

    /// Which of the broker's addresses is in use, or was last, counted from 0.
    pub fn place(&self) -> usize {
        self.shared.at.load(Ordering::Acquire)
    }

    /// How many messages were dropped in either direction because a queue was full.
    pub fn dropped(&self) -> u64 {
        self.shared.dropped.load(Ordering::Relaxed)
    }
}

//! Bounds the bytes that wait for clients. rmqtt counts waiting messages, not their bytes, and counts none while the
//! client's socket is full. Therefore each message is charged to its receiver when it is forwarded. The charge ends
//! when rmqtt drops the payload: after sending, at its expiry, or with the session.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use bytes::Bytes;
use rmqtt::codec::v5::UserProperty;
use rmqtt::types::{ClientId, Publish};

use super::limits;
use super::notices::Notices;

/// Bytes that wait to be sent, for each client and in total.
#[derive(Debug)]
pub struct Queues {
    total: Arc<AtomicUsize>,
    clients: Mutex<BTreeMap<ClientId, Arc<AtomicUsize>>>,
    notices: Arc<Notices>,
}

/// Bytes that count as waiting for a client until this value is dropped.
#[derive(Debug)]
pub struct Charge {
    bytes: usize,
    client: Arc<AtomicUsize>,
    total: Arc<AtomicUsize>,
}

/// A payload and its charge.
struct Charged {
    payload: Bytes,
    _charge: Charge,
}

impl AsRef<[u8]> for Charged {
    fn as_ref(&self) -> &[u8] {
        &self.payload
    }
}

impl Queues {
    /// Empty queues.
    pub fn new(notices: Arc<Notices>) -> Self {
        Self { total: Arc::default(), clients: Mutex::default(), notices }
    }

    /// Returns a copy of a message whose payload is charged to its receiver `client`. If the receiver's queue or all
    /// queues together are full, reports that and returns `None`.
    pub fn charged(&self, publish: &Publish, client: &ClientId) -> Option<Publish> {
        let Some(charge) = self.charge(client, size(publish) + limits::MESSAGE_OVERHEAD_BYTES) else {
            self.notices.say(client, &full_queue(client));
            return None;
        };
        let mut publish = publish.clone();
        let payload = std::mem::take(&mut publish.inner.payload);
        publish.inner.payload = Bytes::from_owner(Charged { payload, _charge: charge });
        // rmqtt adds a topic alias, a subscription identifier and the rest of an expiry to the properties. A message
        // that came over version 3 has none.
        publish.inner.properties.get_or_insert_default();
        Some(publish)
    }

    /// Charges `bytes`, the length of a message, to a client. `None` if the client's queue or the total is full. A queue
    /// that stays within [`limits::QUEUE_SHARE_BYTES`] always has room.
    fn charge(&self, client: &ClientId, bytes: usize) -> Option<Charge> {
        let queue = self.queue(client);
        let waiting = queue.load(Ordering::Relaxed) + bytes;
        let total = self.total.load(Ordering::Relaxed) + bytes;
        let has_room = waiting <= limits::QUEUE_BYTES && total <= limits::QUEUE_BYTES_TOTAL;
        if !has_room && waiting > limits::QUEUE_SHARE_BYTES {
            return None;
        }
        queue.fetch_add(bytes, Ordering::Relaxed);
        self.total.fetch_add(bytes, Ordering::Relaxed);
        Some(Charge { bytes, client: queue, total: self.total.clone() })
    }

    fn queue(&self, client: &ClientId) -> Arc<AtomicUsize> {
        let mut clients = self.clients.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(queue) = clients.get(client) {
            return queue.clone();
        }
        if clients.len() >= 2 * limits::CONNECTIONS {
            // A counter that no waiting message holds belongs to a client with an empty queue.
            clients.retain(|_, queue| Arc::strong_count(queue) > 1);
        }
        clients.entry(client.clone()).or_default().clone()
    }
}

impl Drop for Charge {
    fn drop(&mut self) {
        self.client.fetch_sub(self.bytes, Ordering::Relaxed);
        self.total.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

/// Returns the bytes of a message: topic, payload and properties.
pub fn size(publish: &Publish) -> usize {
    let of_text = |text: Option<&str>| text.map_or(0, str::len);
    let properties = publish.inner.properties.as_ref().map_or(0, |properties| {
        let users = properties.user_properties.iter();
        let of_users: usize =
            users.map(|(name, value)| name.len() + value.len() + size_of::<UserProperty>()).sum();
        let correlation = properties.correlation_data.as_ref().map_or(0, Bytes::len);
        of_users
            + correlation
            + of_text(properties.content_type.as_deref())
            + of_text(properties.response_topic.as_deref())
    });
    publish.inner.topic.len() + publish.inner.payload.len() + properties
}

fn full_queue(client: &ClientId) -> String {
    let client: String = client.chars().take(80).collect();
    format!(
        "The broker drops messages to client {}: it does not read what waits for it, or not fast enough.",
        client.escape_debug()
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of messages of 64 KiB in a full queue.
    const FULL: usize = limits::QUEUE_BYTES / (64 << 10);

    fn queues() -> Queues {
        Queues::new(Arc::new(Notices::new().0))
    }

    /// Charges messages of 64 KiB until the queue is full. Returns the number that fitted.
    fn fill(queues: &Queues, client: &str, charges: &mut Vec<Charge>) -> usize {
        let before = charges.len();
        charges.extend(std::iter::from_fn(|| queues.charge(&client.into(), 64 << 10)));
        charges.len() - before
    }

    #[test]
    fn a_full_queue_takes_no_more_until_messages_leave_it() {
        let (queues, mut charges) = (queues(), Vec::new());
        assert_eq!(fill(&queues, "slow", &mut charges), FULL);
        assert!(queues.charge(&"slow".into(), 1).is_none());
        charges.pop();
        assert!(queues.charge(&"slow".into(), 64 << 10).is_some());
        charges.clear();
        assert_eq!(queues.total.load(Ordering::Relaxed), 0);
        assert_eq!(fill(&queues, "slow", &mut charges), FULL);
    }

    #[test]
    fn properties_count_as_bytes_of_a_message() {
        let properties = rmqtt::codec::v5::PublishProperties {
            user_properties: vec![("ab".into(), "c".into()); 1_000],
            content_type: Some("text".into()),
            ..Default::default()
        };
        let publish = rmqtt::codec::types::Publish {
            dup: false,
            retain: false,
            qos: rmqtt::types::QoS::AtMostOnce,
            topic: "topic".into(),
            packet_id: None,
            payload: Bytes::from_static(b"payload"),
            properties: Some(properties),
        };
        let of_pair = 3 + size_of::<UserProperty>();
        assert_eq!(size(&publish.into()), 5 + 7 + 4 + 1_000 * of_pair);
    }

    #[test]
    fn slow_readers_together_are_bounded_and_leave_others_their_share() {
        let (queues, mut charges) = (queues(), Vec::new());
        for client in 0..100 {
            fill(&queues, &client.to_string(), &mut charges);
        }
        assert_eq!(queues.total.load(Ordering::Relaxed), limits::QUEUE_BYTES_TOTAL);
        let robot = queues.charge(&"LightBot/r1".into(), 16 << 10);
        assert!(robot.is_some() && queues.charge(&"LightBot/r1".into(), 32 << 10).is_none());
    }
}

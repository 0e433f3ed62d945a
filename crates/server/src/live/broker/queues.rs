//! Bounds the bytes that wait for clients. rmqtt counts waiting messages, not their bytes, and counts none while the
//! client's socket is full. So each message is charged to its receiver when it is forwarded, and the charge ends with
//! the payload, wherever rmqtt drops that: when it was sent, when it expired, or with the session.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use async_trait::async_trait;
use bytes::Bytes;
use rmqtt::context::ServerContext;
use rmqtt::session::Session;
use rmqtt::shared::{DefaultShared, Entry, Shared};
use rmqtt::types::{
    ClientId, ForwardedCount, ForwardedRecipients, From, Id, MsgID, Publish, Reason, SessionStatus,
    SubRelations, SubRelationsMap, SubsSearchParams, SubsSearchResult, To,
};

use super::limits;
use super::notices::Notices;
use super::sessions::OwnedEntry;

/// Messages that could not be handed over, and to which client.
type Failed = Vec<(To, From, Publish, Reason)>;

/// Bytes that wait, by client and in all.
#[derive(Debug, Default)]
pub struct Queues {
    total: Arc<AtomicUsize>,
    clients: Mutex<BTreeMap<ClientId, Arc<AtomicUsize>>>,
}

/// Bytes charged to a client until the value is dropped.
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
    /// Charges a message of `bytes` to a client; `None` where its queue is full.
    pub fn charge(&self, client: &ClientId, bytes: usize) -> Option<Charge> {
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
            // Counters that no waiting message holds are of clients with an empty queue.
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

/// rmqtt's way from a message to its receivers, with [`Queues`] before each of them.
pub struct BoundedShared {
    inner: DefaultShared,
    context: ServerContext,
    queues: Queues,
    notices: Arc<Notices>,
    /// Whether clients log in, so that sessions belong to logins.
    has_users: bool,
}

impl BoundedShared {
    /// Takes the place of the context's own.
    pub async fn install(context: &ServerContext, notices: Arc<Notices>, has_users: bool) {
        let inner = DefaultShared::new(Some(context.clone()));
        let bounded = Self { inner, context: context.clone(), queues: Queues::default(), notices, has_users };
        *context.extends.shared_mut().await = Box::new(bounded);
    }

    /// The message with its payload charged to the client; `None` where the client's queue is full.
    fn charged(&self, publish: &Publish, client: &ClientId) -> Option<Publish> {
        let bytes = publish.payload.len() + publish.topic.len() + limits::MESSAGE_OVERHEAD_BYTES;
        let Some(charge) = self.queues.charge(client, bytes) else {
            self.notices.say(client, &full_queue(client));
            return None;
        };
        let mut publish = publish.clone();
        let payload = std::mem::take(&mut publish.inner.payload);
        publish.inner.payload = Bytes::from_owner(Charged { payload, _charge: charge });
        Some(publish)
    }

    async fn relations(&self, from: &From, publish: &Publish) -> SubRelations {
        let matches = self.context.extends.router().await.matches(from.id.clone(), &publish.topic).await;
        match matches {
            Ok(mut nodes) => nodes.remove(&self.context.node.id()).unwrap_or_default(),
            Err(error) => {
                tracing::warn!("the broker finds no receivers of a message on {}: {error}", publish.topic);
                SubRelations::default()
            }
        }
    }
}

fn full_queue(client: &ClientId) -> String {
    let client: String = client.chars().take(80).collect();
    format!(
        "The broker drops messages to client {}: it does not read what waits for it, or not fast enough.",
        client.escape_debug()
    )
}

#[async_trait]
impl Shared for BoundedShared {
    async fn forwards(
        &self,
        msg_id: Option<MsgID>,
        from: From,
        publish: Publish,
    ) -> Result<ForwardedCount, (ForwardedCount, Failed)> {
        if publish.target_clientid.is_some() {
            return self.inner.forwards(msg_id, from, publish).await;
        }
        let (mut forwarded, mut failed) = (0, Failed::new());
        for relation in self.relations(&from, &publish).await {
            let Some(message) = self.charged(&publish, &relation.1) else { continue };
            let outcome = self.inner.forwards_to(from.clone(), &message, vec![relation], msg_id).await;
            let (receivers, errors) =
                outcome.map_or_else(|errors| errors, |receivers| (receivers, Failed::new()));
            forwarded += receivers.len();
            failed.extend(errors);
        }
        if failed.is_empty() { Ok(forwarded) } else { Err((forwarded, failed)) }
    }

    fn entry(&self, id: Id) -> Box<dyn Entry> {
        let entry = self.inner.entry(id);
        if self.has_users { Box::new(OwnedEntry::new(entry)) } else { entry }
    }

    fn exist(&self, client_id: &str) -> bool {
        self.inner.exist(client_id)
    }

    async fn forwards_and_get_shareds(
        &self,
        from: From,
        publish: Publish,
    ) -> Result<(SubRelationsMap, ForwardedRecipients), (ForwardedRecipients, Failed)> {
        self.inner.forwards_and_get_shareds(from, publish).await
    }

    async fn forwards_to(
        &self,
        from: From,
        publish: &Publish,
        relations: SubRelations,
        msg_id: Option<MsgID>,
    ) -> Result<ForwardedRecipients, (ForwardedRecipients, Failed)> {
        self.inner.forwards_to(from, publish, relations, msg_id).await
    }

    fn iter(&self) -> Box<dyn Iterator<Item = Box<dyn Entry>> + Sync + Send + '_> {
        self.inner.iter()
    }

    fn random_session(&self) -> Option<Session> {
        self.inner.random_session()
    }

    async fn session_status(&self, client_id: &str) -> Option<SessionStatus> {
        self.inner.session_status(client_id).await
    }

    async fn client_states_count(&self) -> usize {
        self.inner.client_states_count().await
    }

    fn sessions_count(&self) -> usize {
        self.inner.sessions_count()
    }

    async fn query_subscriptions(&self, q: &SubsSearchParams) -> Vec<SubsSearchResult> {
        self.inner.query_subscriptions(q).await
    }

    async fn subscriptions_count(&self) -> usize {
        self.inner.subscriptions_count().await
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Messages of 64 KiB in a full queue.
    const FULL: usize = limits::QUEUE_BYTES / (64 << 10);

    /// Charges messages of 64 KiB until the queue is full; how many fitted.
    fn fill(queues: &Queues, client: &str, charges: &mut Vec<Charge>) -> usize {
        let before = charges.len();
        charges.extend(std::iter::from_fn(|| queues.charge(&client.into(), 64 << 10)));
        charges.len() - before
    }

    #[test]
    fn a_full_queue_takes_no_more_until_messages_leave_it() {
        let (queues, mut charges) = (Queues::default(), Vec::new());
        assert_eq!(fill(&queues, "slow", &mut charges), FULL);
        assert!(queues.charge(&"slow".into(), 1).is_none());
        charges.pop();
        assert!(queues.charge(&"slow".into(), 64 << 10).is_some());
        charges.clear();
        assert_eq!(queues.total.load(Ordering::Relaxed), 0);
        assert_eq!(fill(&queues, "slow", &mut charges), FULL);
    }

    #[test]
    fn slow_readers_together_are_bounded_and_leave_others_their_share() {
        let (queues, mut charges) = (Queues::default(), Vec::new());
        for client in 0..100 {
            fill(&queues, &client.to_string(), &mut charges);
        }
        assert_eq!(queues.total.load(Ordering::Relaxed), limits::QUEUE_BYTES_TOTAL);
        let robot = queues.charge(&"LightBot/r1".into(), 16 << 10);
        assert!(robot.is_some() && queues.charge(&"LightBot/r1".into(), 32 << 10).is_none());
    }
}

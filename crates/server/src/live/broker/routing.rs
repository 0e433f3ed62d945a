//! Forwards messages to their receivers as rmqtt does, with a bounded queue before each receiver.

use std::sync::Arc;

use async_trait::async_trait;
use rmqtt::context::ServerContext;
use rmqtt::net::Result;
use rmqtt::session::Session;
use rmqtt::shared::{DefaultShared, Entry, RetainLoadCallback, Shared};
use rmqtt::types::{
    ForwardedCount, ForwardedRecipients, From, Id, MsgID, NodeId, Publish, Reason, SessionStatus,
    SubRelations, SubRelationsMap, SubsSearchParams, SubsSearchResult, To, TopicFilter,
};
use tokio::sync::Semaphore;

use super::limits;
use super::notices::Notices;
use super::queues::Queues;
use super::sessions::GuardedEntry;

/// Messages that could not be handed over: receiver, sender, message and reason.
type Failed = Vec<(To, From, Publish, Reason)>;

/// rmqtt's forwarding of messages, with [`Queues`] before each receiver.
pub struct BoundedShared {
    inner: DefaultShared,
    context: ServerContext,
    queues: Arc<Queues>,
    /// Bounds the number of subscriptions that wait for retained messages. `turn` serves them one after the other.
    waiting: Semaphore,
    turn: tokio::sync::Mutex<()>,
    /// Whether clients log in as users. Each session then belongs to the user that began it.
    has_users: bool,
}

impl BoundedShared {
    /// Makes `context` forward messages through a new `BoundedShared`.
    pub async fn install(context: &ServerContext, notices: Arc<Notices>, has_users: bool) {
        let inner = DefaultShared::new(Some(context.clone()));
        let bounded = Self {
            inner,
            context: context.clone(),
            queues: Arc::new(Queues::new(notices)),
            waiting: Semaphore::new(limits::RETAINED_WAITING),
            turn: tokio::sync::Mutex::default(),
            has_users,
        };
        *context.extends.shared_mut().await = Box::new(bounded);
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

#[async_trait]
impl Shared for BoundedShared {
    async fn forwards(
        &self,
        msg_id: Option<MsgID>,
        from: From,
        publish: Publish,
    ) -> std::result::Result<ForwardedCount, (ForwardedCount, Failed)> {
        if publish.target_clientid.is_some() {
            return self.inner.forwards(msg_id, from, publish).await;
        }
        let (mut forwarded, mut failed) = (0, Failed::new());
        for relation in self.relations(&from, &publish).await {
            let Some(message) = self.queues.charged(&publish, &relation.1) else { continue };
            let outcome = self.inner.forwards_to(from.clone(), &message, vec![relation], msg_id).await;
            let (receivers, errors) =
                outcome.map_or_else(|errors| errors, |receivers| (receivers, Failed::new()));
            forwarded += receivers.len();
            failed.extend(errors);
        }
        if failed.is_empty() { Ok(forwarded) } else { Err((forwarded, failed)) }
    }

    fn entry(&self, id: Id) -> Box<dyn Entry> {
        Box::new(GuardedEntry::new(self.inner.entry(id), self.queues.clone(), self.has_users))
    }

    fn exist(&self, client_id: &str) -> bool {
        self.inner.exist(client_id)
    }

    async fn forwards_and_get_shareds(
        &self,
        from: From,
        publish: Publish,
    ) -> std::result::Result<(SubRelationsMap, ForwardedRecipients), (ForwardedRecipients, Failed)> {
        self.inner.forwards_and_get_shareds(from, publish).await
    }

    async fn forwards_to(
        &self,
        from: From,
        publish: &Publish,
        relations: SubRelations,
        msg_id: Option<MsgID>,
    ) -> std::result::Result<ForwardedRecipients, (ForwardedRecipients, Failed)> {
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

    /// Delivers retained messages to a new subscription, one subscription at a time. rmqtt calls this function in a separate
    /// task for each subscription. Each call copies all messages that match, so that many at once would take much memory.
    async fn retain_load_with(
        &self,
        filter: &TopicFilter,
        deliver: Arc<dyn RetainLoadCallback>,
    ) -> Result<Vec<(NodeId, MsgID)>> {
        let Ok(_place) = self.waiting.try_acquire() else {
            tracing::debug!("too many subscriptions at once: one gets no retained messages");
            return Ok(Vec::new());
        };
        let _turn = self.turn.lock().await;
        self.inner.retain_load_with(filter, deliver).await
    }
}

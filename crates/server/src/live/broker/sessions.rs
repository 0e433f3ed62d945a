//! If the broker has users, a session belongs to the user that began it: another user neither takes over the connection
//! of a client id, nor goes on with its session. A session that is to end with its connection is never resumed, even if
//! rmqtt has not yet noticed the end of the connection. Both are checked while rmqtt holds the lock of the client id,
//! so that no other login comes in between.

use std::sync::Arc;

use async_trait::async_trait;
use rmqtt::net::{Error, Result};
use rmqtt::session::Session;
use rmqtt::shared::Entry;
use rmqtt::types::{
    ConnectInfo, From, Id, IsAdmin, OfflineSession, Publish, Reason, SubsSearchResult, Subscribe,
    SubscribeReturn, Tx, Unsubscribe,
};

use super::queues::Queues;

/// Whether the session of a client id was begun by another user than that of `id`.
pub fn is_of_another(session: Option<&Session>, id: &Id) -> bool {
    session.is_some_and(|session| session.id.username != id.username)
}

/// Whether a session ends together with its connection. This holds for a clean session of MQTT 3 (section 3.1.2.4), and for
/// a session of MQTT 5 without an expiry interval (section 3.1.2.11.2).
async fn ends_with_connection(session: &Session) -> bool {
    let Ok(connect) = session.connect_info().await else { return true };
    if let ConnectInfo::V3(_, connect) = connect.as_ref() {
        return connect.clean_session;
    }
    let disconnect = session.disconnect().await.unwrap_or_default();
    session.fitter.session_expiry_interval(disconnect.as_ref()).is_zero()
}

/// The entry of a client id in rmqtt's table of sessions, with the rules of this module.
pub struct GuardedEntry {
    entry: Box<dyn Entry>,
    queues: Arc<Queues>,
    /// Whether only the user that began a session may take it over.
    is_owned: bool,
}

impl GuardedEntry {
    /// Puts the rules of this module around rmqtt's entry.
    pub fn new(entry: Box<dyn Entry>, queues: Arc<Queues>, is_owned: bool) -> Self {
        Self { entry, queues, is_owned }
    }
}

#[async_trait]
impl Entry for GuardedEntry {
    async fn try_lock(&self) -> Result<Box<dyn Entry>> {
        let locked = self.entry.try_lock().await?;
        Ok(Box::new(Self::new(locked, self.queues.clone(), self.is_owned)))
    }

    fn id(&self) -> Id {
        self.entry.id()
    }

    fn id_same(&self) -> Option<bool> {
        self.entry.id_same()
    }

    async fn set(&mut self, session: Session, tx: Tx) -> Result<()> {
        self.entry.set(session, tx).await
    }

    async fn remove(&mut self) -> Result<Option<(Session, Tx)>> {
        self.entry.remove().await
    }

    async fn remove_with(&mut self, id: &Id) -> Result<Option<(Session, Tx)>> {
        self.entry.remove_with(id).await
    }

    async fn kick(
        &mut self,
        clean_start: bool,
        clear_subscriptions: bool,
        is_admin: IsAdmin,
    ) -> Result<OfflineSession> {
        let session = self.entry.session();
        if self.is_owned && !is_admin && is_of_another(session.as_ref(), &self.entry.id()) {
            return Err(Error::msg("the session belongs to another login"));
        }
        let has_ended = match &session {
            Some(session) => ends_with_connection(session).await,
            None => false,
        };
        let (clean_start, clear_subscriptions) = (clean_start || has_ended, clear_subscriptions || has_ended);
        match self.entry.kick(clean_start, clear_subscriptions, is_admin).await {
            // The session ended by itself before it answered. At the second attempt no session has to answer.
            Err(_) => self.entry.kick(clean_start, clear_subscriptions, is_admin).await,
            kicked => kicked,
        }
    }

    async fn online(&self) -> bool {
        self.entry.online().await
    }

    async fn is_connected(&self) -> bool {
        self.entry.is_connected().await
    }

    fn session(&self) -> Option<Session> {
        self.entry.session()
    }

    fn exist(&self) -> bool {
        self.entry.exist()
    }

    fn tx(&self) -> Option<Tx> {
        self.entry.tx()
    }

    async fn subscribe(&self, subscribe: &Subscribe) -> Result<SubscribeReturn> {
        self.entry.subscribe(subscribe).await
    }

    async fn unsubscribe(&self, unsubscribe: &Unsubscribe) -> Result<bool> {
        self.entry.unsubscribe(unsubscribe).await
    }

    async fn publish(
        &self,
        from: From,
        publish: Publish,
    ) -> std::result::Result<(), (From, Publish, Reason)> {
        // Retained messages come this way. A message for which the queue has no room is dropped.
        let Some(charged) = self.queues.charged(&publish, &self.entry.id().client_id) else { return Ok(()) };
        self.entry.publish(from, charged).await
    }

    async fn subscriptions(&self) -> Option<Vec<SubsSearchResult>> {
        self.entry.subscriptions().await
    }
}

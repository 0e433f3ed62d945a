//! Sessions belong to the login that began them: another login neither takes over the connection of a client id, nor goes
//! on with its session. The check is made while rmqtt holds the lock of the client id, so that no login slips in between.

use async_trait::async_trait;
use rmqtt::net::{Error, Result};
use rmqtt::session::Session;
use rmqtt::shared::Entry;
use rmqtt::types::{
    From, Id, IsAdmin, OfflineSession, Publish, Reason, SubsSearchResult, Subscribe, SubscribeReturn, Tx,
    Unsubscribe,
};

/// Whether the session of a client id belongs to another login than that of `id`.
pub fn is_of_another(session: Option<&Session>, id: &Id) -> bool {
    session.is_some_and(|session| session.id.username != id.username)
}

/// A client id's entry among the sessions that only the session's own login takes over.
pub struct OwnedEntry(Box<dyn Entry>);

impl OwnedEntry {
    /// rmqtt's entry with that rule.
    pub fn new(entry: Box<dyn Entry>) -> Self {
        Self(entry)
    }
}

#[async_trait]
impl Entry for OwnedEntry {
    async fn try_lock(&self) -> Result<Box<dyn Entry>> {
        let locked = self.0.try_lock().await?;
        Ok(Box::new(Self(locked)))
    }

    fn id(&self) -> Id {
        self.0.id()
    }

    fn id_same(&self) -> Option<bool> {
        self.0.id_same()
    }

    async fn set(&mut self, session: Session, tx: Tx) -> Result<()> {
        self.0.set(session, tx).await
    }

    async fn remove(&mut self) -> Result<Option<(Session, Tx)>> {
        self.0.remove().await
    }

    async fn remove_with(&mut self, id: &Id) -> Result<Option<(Session, Tx)>> {
        self.0.remove_with(id).await
    }

    async fn kick(
        &mut self,
        clean_start: bool,
        clear_subscriptions: bool,
        is_admin: IsAdmin,
    ) -> Result<OfflineSession> {
        if !is_admin && is_of_another(self.0.session().as_ref(), &self.0.id()) {
            return Err(Error::msg("the session belongs to another login"));
        }
        self.0.kick(clean_start, clear_subscriptions, is_admin).await
    }

    async fn online(&self) -> bool {
        self.0.online().await
    }

    async fn is_connected(&self) -> bool {
        self.0.is_connected().await
    }

    fn session(&self) -> Option<Session> {
        self.0.session()
    }

    fn exist(&self) -> bool {
        self.0.exist()
    }

    fn tx(&self) -> Option<Tx> {
        self.0.tx()
    }

    async fn subscribe(&self, subscribe: &Subscribe) -> Result<SubscribeReturn> {
        self.0.subscribe(subscribe).await
    }

    async fn unsubscribe(&self, unsubscribe: &Unsubscribe) -> Result<bool> {
        self.0.unsubscribe(unsubscribe).await
    }

    async fn publish(
        &self,
        from: From,
        publish: Publish,
    ) -> std::result::Result<(), (From, Publish, Reason)> {
        self.0.publish(from, publish).await
    }

    async fn subscriptions(&self) -> Option<Vec<SubsSearchResult>> {
        self.0.subscriptions().await
    }
}

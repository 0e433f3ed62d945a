//! The embedded broker's hooks: who comes in, who may say what, who may hear what.

use std::net::SocketAddr;
use std::sync::Arc;

use async_trait::async_trait;
use rmqtt::codec::v5::SubscribeAckReason;
use rmqtt::context::ServerContext;
use rmqtt::hook::{Handler, HookResult, Parameter, ReturnType, Type};
use rmqtt::types::{AuthResult, Id, LastWill, PublishAclResult, SubscribeAclResult};

use super::gate::Peers;
use super::notices::Notices;
use super::rights::Who;
use super::users::{Role, Users};

/// Judges everything clients ask for.
#[derive(Clone)]
pub struct Door {
    /// With none, everybody may come in.
    pub users: Arc<Users>,
    pub notices: Arc<Notices>,
    /// Connections that came through the TLS gate, and where that hands them over.
    pub peers: Arc<Peers>,
}

impl Door {
    /// Puts it up.
    pub async fn hang(&self, context: &ServerContext) {
        let register = context.extends.hook_mgr().register();
        for kind in [Type::ClientAuthenticate, Type::ClientSubscribeCheckAcl, Type::MessagePublishCheckAcl] {
            register.add(kind, Box::new(self.clone())).await;
        }
        register.start().await;
    }

    fn who(&self, id: &Id) -> Result<Who, String> {
        let user = id.username.as_deref().unwrap_or_default();
        Who::of(self.users.role(user), user, &id.client_id)
    }

    fn login(&self, id: &Id, password: &[u8], will: Option<LastWill<'_>>) -> Result<(), Refused> {
        let user = id.username.as_deref().unwrap_or_default();
        let from = id.remote_addr;
        if self.peers.is_inner(id.lid) && self.peers.of(from).is_none() {
            return Err(Refused::Rights("it did not come through the gate".into()));
        }
        let role =
            if self.users.is_empty() { Some(Role::ByClientId) } else { self.users.login(user, password) };
        let role = role.ok_or(Refused::Password)?;
        let who = Who::of(role, user, &id.client_id).map_err(Refused::Rights)?;
        // A last will is published without being asked about again.
        let (topic, message) = match &will {
            Some(LastWill::V3(will)) => (&will.topic, &will.message),
            Some(LastWill::V5(will)) => (&will.topic, &will.message),
            None => return Ok(()),
        };
        who.may_publish(topic, message)
            .map_err(|why| Refused::Rights(format!("its last will on {topic}: {why}")))
    }

    /// One line about a refusal: who, what, why.
    fn refuse(&self, id: &Id, what: &str, why: &str) {
        let client: String = id.client_id.chars().take(80).collect();
        let user = id.username.as_deref().unwrap_or("(none)");
        let from = self.peers.of(id.remote_addr).or(id.remote_addr);
        let from = from.map_or_else(String::new, |from: SocketAddr| format!(" from {}", from.ip()));
        let line = format!(
            "The broker refused client {} (user {}{from}) {what}: {why}.",
            client.escape_debug(),
            user.escape_debug()
        );
        self.notices.say(&id.client_id, &line);
    }
}

/// Why somebody does not come in.
enum Refused {
    Password,
    Rights(String),
}

#[async_trait]
impl Handler for Door {
    async fn hook(&self, parameter: &Parameter, result: Option<HookResult>) -> ReturnType {
        match parameter {
            Parameter::ClientAuthenticate(info) => {
                let id = info.id();
                let password = info.password().map(|password| password.to_vec()).unwrap_or_default();
                let answer = match self.login(id, &password, info.last_will()) {
                    Ok(()) => AuthResult::Allow(false, None),
                    Err(Refused::Password) => {
                        self.refuse(id, "the login", "user or password is wrong");
                        AuthResult::BadUsernameOrPassword
                    }
                    Err(Refused::Rights(why)) => {
                        self.refuse(id, "the login", &why);
                        AuthResult::NotAuthorized
                    }
                };
                (false, Some(HookResult::AuthResult(answer)))
            }
            Parameter::MessagePublishCheckAcl(session, publish) => {
                let allowed =
                    self.who(&session.id).and_then(|who| who.may_publish(&publish.topic, &publish.payload));
                let answer = match allowed {
                    Ok(()) => PublishAclResult::allow(),
                    Err(why) => {
                        self.refuse(
                            &session.id,
                            &format!("a message on {}", shortened(&publish.topic)),
                            &why,
                        );
                        PublishAclResult::rejected(false, None)
                    }
                };
                (false, Some(HookResult::PublishAclResult(answer)))
            }
            Parameter::ClientSubscribeCheckAcl(session, subscribe) => {
                let filter = &subscribe.topic_filter;
                match self.who(&session.id).and_then(|who| who.may_subscribe(filter)) {
                    Ok(()) => (true, result),
                    Err(why) => {
                        let what = format!("the subscription to {}", shortened(filter));
                        self.refuse(&session.id, &what, &why);
                        let answer = SubscribeAclResult::new_failure(SubscribeAckReason::NotAuthorized);
                        (false, Some(HookResult::SubscribeAclResult(answer)))
                    }
                }
            }
            _ => (true, result),
        }
    }
}

/// A topic fit for a line.
fn shortened(topic: &str) -> String {
    topic.chars().take(100).collect::<String>().escape_debug().to_string()
}

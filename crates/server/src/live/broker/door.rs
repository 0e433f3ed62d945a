//! The embedded broker's hooks: which clients may connect, publish and subscribe.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Instant;

use async_trait::async_trait;
use lightbots_base::RobotId;
use rmqtt::codec::v5::SubscribeAckReason;
use rmqtt::context::ServerContext;
use rmqtt::hook::{Handler, HookResult, Parameter, ReturnType, Type};
use rmqtt::types::{AuthResult, Id, LastWill, PublishAclResult, Reason, SubscribeAclResult};

use super::admitted::Admitted;
use super::flood::Floods;
use super::gate::Peers;
use super::limits;
use super::notices::Notices;
use super::rights::Who;
use super::sessions::is_of_another;
use super::takeovers::Takeovers;
use super::users::{Role, Users};

/// Decides about the logins, messages and subscriptions of all clients.
#[derive(Clone)]
pub struct Door {
    /// Known users. If there are none, no client needs a login.
    pub users: Arc<Users>,
    pub notices: Arc<Notices>,
    /// Connections that came through the TLS gate, and the listener to which the gate hands them over.
    pub peers: Arc<Peers>,
    /// Connections that have logged in.
    pub admitted: Arc<Admitted>,
    /// Detects robots that share a name, by the connections that they take from each other.
    pub takeovers: Arc<Takeovers>,
    /// Counts of messages that clients have published.
    pub floods: Arc<Floods>,
    /// rmqtt's state, with the sessions and subscriptions of all clients.
    pub context: ServerContext,
}

impl Door {
    /// Registers the hooks with rmqtt.
    pub async fn hang(&self, context: &ServerContext) {
        let register = context.extends.hook_mgr().register();
        let kinds = [
            Type::ClientAuthenticate,
            Type::ClientDisconnected,
            Type::ClientSubscribeCheckAcl,
            Type::MessagePublishCheckAcl,
        ];
        for kind in kinds {
            register.add(kind, Box::new(self.clone())).await;
        }
        register.start().await;
    }

    fn who(&self, id: &Id) -> Result<Who, String> {
        let user = id.username.as_deref().unwrap_or_default();
        Who::of(self.users.role(user), user, &id.client_id)
    }

    async fn login(&self, id: &Id, password: &[u8], will: Option<LastWill<'_>>) -> Result<(), Refused> {
        let user = id.username.as_deref().unwrap_or_default();
        let from = id.remote_addr;
        if self.peers.is_inner(id.lid) && self.peers.of(from).is_none() {
            return Err(Refused::Rights("it did not come through the gate".into()));
        }
        let role =
            if self.users.is_empty() { Some(Role::ByClientId) } else { self.users.login(user, password) };
        let role = role.ok_or(Refused::Password)?;
        let who = Who::of(role, user, &id.client_id).map_err(Refused::Rights)?;
        if self.floods.is_banned(&id.client_id, Instant::now()) {
            let seconds = limits::FLOOD_BAN.as_secs();
            return Err(Refused::Rights(format!("it flooded the broker less than {seconds} s ago")));
        }
        let entry = self.context.extends.shared().await.entry(id.clone());
        if !self.users.is_empty() && is_of_another(entry.session().as_ref(), id) {
            return Err(Refused::Rights("the session of this client id belongs to another user".into()));
        }
        if let Who::Robot(robot) = who {
            self.watch_takeover(id, robot, entry.online().await);
        }
        // The last will is checked at the login, because rmqtt publishes it without a further check.
        let will = match &will {
            Some(LastWill::V3(will)) => Some((&will.topic, &will.message)),
            Some(LastWill::V5(will)) => Some((&will.topic, &will.message)),
            None => None,
        };
        if let Some((topic, message)) = will {
            short_enough(topic)
                .and_then(|()| who.may_publish(topic, message))
                .map_err(|why| Refused::Rights(format!("its last will on {}: {why}", shortened(topic))))?;
        }
        let has_room = from.is_none_or(|from| self.admitted.add(from));
        if has_room { Ok(()) } else { Err(Refused::Rights(full("connections", self.admitted.most()))) }
    }

    /// Notes the login of a robot. If robots of this name keep taking the connection from each other, reports that two
    /// robots share the name.
    fn watch_takeover(&self, id: &Id, robot: RobotId, is_online: bool) {
        let now = Instant::now();
        if is_online && self.takeovers.taken_over(&id.client_id, now) {
            let line = format!(
                "Two robots are called {robot}: they take the connection from each other. Give one of them another \
                 name."
            );
            self.notices.say(&format!("two {}", id.client_id), &line);
        }
        self.takeovers.active(&id.client_id, now);
    }

    /// Checks whether a client may subscribe to a filter. `Err`: why not.
    async fn subscription(&self, id: &Id, filter: &str) -> Result<(), String> {
        short_enough(filter)?;
        let there_are = self.context.extends.router().await.routes().count();
        if usize::try_from(there_are).unwrap_or(0) >= limits::SUBSCRIPTIONS_TOTAL {
            return Err(full("subscriptions", limits::SUBSCRIPTIONS_TOTAL));
        }
        self.who(id)?.may_subscribe(filter)
    }

    /// Counts a message of a client, and checks whether the client may publish it. `Err`: why not, and whether the client is
    /// cut off.
    fn message(&self, id: &Id, topic: &str, payload: &[u8]) -> Result<(), (String, bool)> {
        let who = self.who(id).map_err(|why| (why, false))?;
        let now = Instant::now();
        if matches!(who, Who::Robot(_)) {
            self.takeovers.active(&id.client_id, now);
        }
        if let Some(rate) = who.rate()
            && !self.floods.count(&id.client_id, rate, now)
        {
            let line =
                format!("it publishes more than {} messages a second, and is cut off", rate.per_second);
            return Err((line, true));
        }
        short_enough(topic).and_then(|()| who.may_publish(topic, payload)).map_err(|why| (why, false))
    }

    /// Reports in one line what the broker refused to which client, and why.
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

/// Why a client may not connect.
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
                let answer = match self.login(id, &password, info.last_will()).await {
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
                let answer = match self.message(&session.id, &publish.topic, &publish.payload) {
                    Ok(()) => PublishAclResult::allow(),
                    Err((why, is_cut_off)) => {
                        let what = format!("a message on {}", shortened(&publish.topic));
                        self.refuse(&session.id, &what, &why);
                        PublishAclResult::rejected(is_cut_off, None)
                    }
                };
                (false, Some(HookResult::PublishAclResult(answer)))
            }
            Parameter::ClientSubscribeCheckAcl(session, subscribe) => {
                // rmqtt has removed the group of a shared subscription from its filter.
                let filter = match subscribe.opts.shared_group() {
                    Some(group) => format!("$share/{group}/{}", subscribe.topic_filter),
                    None => subscribe.topic_filter.to_string(),
                };
                match self.subscription(&session.id, &filter).await {
                    Ok(()) => (true, result),
                    Err(why) => {
                        let what = format!("the subscription to {}", shortened(&filter));
                        self.refuse(&session.id, &what, &why);
                        let answer = SubscribeAclResult::new_failure(SubscribeAckReason::NotAuthorized);
                        (false, Some(HookResult::SubscribeAclResult(answer)))
                    }
                }
            }
            Parameter::ClientDisconnected(session, reason) => {
                if is_too_long(reason) {
                    let most = limits::PACKET_BYTES;
                    self.refuse(&session.id, "a packet", &format!("it has more than {most} bytes"));
                }
                if let Some(peer) = session.id.remote_addr {
                    self.admitted.remove(peer);
                }
                (true, result)
            }
            _ => (true, result),
        }
    }
}

/// Checks the levels and bytes of a topic or filter against limits that only an attack exceeds. `Err`: what is too
/// long.
fn short_enough(topic: &str) -> Result<(), String> {
    let levels = topic.split('/').count();
    if levels > limits::TOPIC_LEVELS {
        return Err(format!("it has {levels} levels; at most {} are possible", limits::TOPIC_LEVELS));
    }
    if topic.len() > limits::TOPIC_BYTES {
        return Err(format!("it has {} bytes; at most {} are possible", topic.len(), limits::TOPIC_BYTES));
    }
    Ok(())
}

fn full(what: &str, limit: usize) -> String {
    format!("the broker has {limit} {what} already, the most it takes")
}

/// Whether a connection ended because of a packet that is longer than [`limits::PACKET_BYTES`].
fn is_too_long(reason: &Reason) -> bool {
    // rmqtt wraps what its decoder says in several layers, which differ by version of the protocol.
    let text = format!("{reason:?}");
    text.contains("MaxSizeExceeded") || text.contains("Max size exceeded")
}

/// Returns the first 100 characters of a topic, escaped, for a line of text.
fn shortened(topic: &str) -> String {
    topic.chars().take(100).collect::<String>().escape_debug().to_string()
}

//! The embedded broker: rmqtt in a runtime of its own, because it has no way to stop but to lose it.

use std::net::SocketAddr;
use std::num::NonZeroU16;

use async_trait::async_trait;
use lightbots_link::BrokerUrl;
use rmqtt::context::ServerContext;
use rmqtt::hook::{Handler, HookResult, Parameter, ReturnType, Type};
use rmqtt::net::{Builder, Listener};
use rmqtt::server::MqttServer;
use rmqtt::types::AuthResult;

use crate::failure::Failure;

/// Who may use a broker that can be reached from other machines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct User {
    name: String,
    password: String,
}

/// A broker that runs until it is dropped.
#[derive(Debug)]
pub struct Broker {
    runtime: Option<tokio::runtime::Runtime>,
    address: SocketAddr,
}

/// The longest message it takes; what is longer costs its sender the connection.
const LONGEST_PACKET: u32 = 2 << 20;

impl User {
    /// Reads `user:password`.
    pub fn parse(text: &str) -> Result<Self, Failure> {
        match text.split_once(':') {
            Some((name, password)) if !name.is_empty() && !password.is_empty() => {
                Ok(Self { name: name.into(), password: password.into() })
            }
            _ => Err(Failure::input(format!("--mqtt-user '{text}': say USER:PASSWORD, both not empty"))),
        }
    }
}

impl Broker {
    /// Starts to listen. On loopback anyone may come in; elsewhere only `users`, of which there must be one. `robots`
    /// is how many there may be: queues are sized for them.
    pub fn start(listen: SocketAddr, users: Vec<User>, robots: usize) -> Result<Self, Failure> {
        if !listen.ip().is_loopback() && users.is_empty() {
            return Err(Failure::input(format!(
                "the broker would be open to everyone on {listen}: name who may use it with --mqtt-user USER:PASSWORD"
            )));
        }
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .thread_name("broker")
            .enable_all()
            .build()
            .map_err(|error| Failure::problem(format!("the system gives the broker no threads: {error}")))?;
        // From here on it is stopped as a broker is: a runtime must not be dropped where others run.
        let mut broker = Self { runtime: Some(runtime), address: listen };
        if let Some(runtime) = &broker.runtime {
            let _inside = runtime.enter();
            let listener = bind(listen, robots)?;
            broker.address = listener.local_addr().unwrap_or(listen);
            runtime.spawn(serve(listener, users));
        }
        Ok(broker)
    }

    /// How this machine's own programs reach it.
    pub fn url(&self, users: &[User]) -> BrokerUrl {
        let ip = match self.address.ip() {
            ip if !ip.is_unspecified() => ip.to_string(),
            std::net::IpAddr::V4(_) => "127.0.0.1".into(),
            std::net::IpAddr::V6(_) => "::1".into(),
        };
        let login = users.first().map(|user| (user.name.clone(), user.password.clone())).unzip();
        BrokerUrl::new(ip, self.address.port()).with_login(login.0, login.1)
    }
}

impl Drop for Broker {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

fn bind(listen: SocketAddr, robots: usize) -> Result<Listener, Failure> {
    let inflight = NonZeroU16::new(100).unwrap_or(NonZeroU16::MIN);
    let builder = Builder::new()
        .name("lightbots")
        .laddr(listen)
        .backlog(4096)
        .nodelay(true)
        .reuseaddr(Some(true))
        .allow_anonymous(listen.ip().is_loopback())
        .max_packet_size(LONGEST_PACKET)
        .max_handshaking_limit(20_000)
        .max_inflight(inflight)
        .max_mqueue_len((robots * 2).max(100_000));
    builder
        .bind()
        .and_then(|listener| listener.tcp())
        .map_err(|error| cannot_listen(listen, &error.to_string()))
}

/// One line for an address that cannot be listened on.
fn cannot_listen(listen: SocketAddr, why: &str) -> Failure {
    let why = why.to_ascii_lowercase();
    if why.contains("in use") {
        let line = "stop the other broker there, use it with --broker, or choose a port with --mqtt-listen";
        return Failure::problem(format!("the broker's address {listen} is taken: {line}"));
    }
    Failure::problem(format!("the broker cannot listen on {listen}: {why}; choose another --mqtt-listen"))
}

async fn serve(listener: Listener, users: Vec<User>) {
    // Whether it thinks the machine busy must not turn robots away: a noisy neighbour is no reason to lose a show.
    let context = ServerContext::new().busy_check_enable(false).build().await;
    if !users.is_empty() {
        let register = context.extends.hook_mgr().register();
        register.add(Type::ClientAuthenticate, Box::new(Door { users })).await;
        register.start().await;
    }
    let id = listener.local_addr().map_or(1883, |address| address.port());
    if let Err(error) = MqttServer::new(context).listener_by_id(listener, id).build().run().await {
        tracing::error!("the broker failed: {error}");
    }
}

/// Lets named users in.
struct Door {
    users: Vec<User>,
}

#[async_trait]
impl Handler for Door {
    async fn hook(&self, parameter: &Parameter, result: Option<HookResult>) -> ReturnType {
        let Parameter::ClientAuthenticate(who) = parameter else { return (true, result) };
        let name = who.username().map(ToString::to_string).unwrap_or_default();
        let password = who.password().map(|password| password.to_vec()).unwrap_or_default();
        let known = self.users.iter().any(|user| user.name == name && user.password.as_bytes() == password);
        let answer = if known { AuthResult::Allow(false, None) } else { AuthResult::BadUsernameOrPassword };
        (false, Some(HookResult::AuthResult(answer)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beyond_this_machine_somebody_must_be_named() {
        let everywhere = "0.0.0.0:0".parse().unwrap();
        assert_eq!(Broker::start(everywhere, vec![], 1).unwrap_err().code, 2);
        assert!(User::parse("me").is_err() && User::parse(":x").is_err() && User::parse("me:").is_err());
    }

    #[test]
    fn a_taken_port_is_said_in_one_line() {
        let first = Broker::start("127.0.0.1:0".parse().unwrap(), vec![], 1).unwrap();
        let error = Broker::start(first.address, vec![], 1).unwrap_err();
        assert!(error.line.contains("is taken") && !error.line.contains('\n'), "{}", error.line);
    }
}

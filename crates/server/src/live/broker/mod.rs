//! The embedded broker: rmqtt in a runtime of its own, because it has no way to stop but to lose it. `users` says who
//! may come in, `rights` who may say and hear what, `door` asks both for every client; `gate` speaks TLS before it.

mod door;
mod gate;
mod notices;
mod rights;
mod users;

use std::net::{Ipv4Addr, SocketAddr};
use std::num::NonZeroU16;
use std::sync::Arc;

use lightbots_link::{BrokerUrl, random_id};
use rmqtt::context::ServerContext;
use rmqtt::net::{Builder, Listener};
use rmqtt::server::MqttServer;
use tokio::sync::mpsc;

pub use gate::TlsOptions;
pub use users::Users;

use crate::failure::Failure;
use door::Door;
use gate::{Gate, Peers};
use notices::Notices;
use users::Role;

/// What a broker needs to know.
#[derive(Clone, Debug)]
pub struct BrokerOptions {
    /// Where it speaks MQTT without TLS.
    pub listen: SocketAddr,
    /// Where it speaks TLS, if anywhere.
    pub tls: Option<TlsOptions>,
    /// Who may use it; with none, everybody on this machine.
    pub users: Users,
    /// How many robots there may be: queues are sized for them.
    pub robots: usize,
}

/// A broker that runs until it is dropped.
#[derive(Debug)]
pub struct Broker {
    runtime: Option<tokio::runtime::Runtime>,
    address: SocketAddr,
    tls_address: Option<SocketAddr>,
    /// How this program itself logs in; `None`: nobody needs to.
    login: Option<(String, String)>,
    notices: Option<mpsc::Receiver<String>>,
}

/// The longest message it takes; what is longer costs its sender the connection.
const LONGEST_PACKET: u32 = 2 << 20;

impl Broker {
    /// Starts to listen. Where others can reach it, users or client certificates must be wanted.
    pub fn start(options: BrokerOptions) -> Result<Self, Failure> {
        check_exposure(&options)?;
        let acceptor = options.tls.as_ref().map(TlsOptions::acceptor).transpose()?;
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .thread_name("broker")
            .enable_all()
            .build()
            .map_err(|error| Failure::problem(format!("the system gives the broker no threads: {error}")))?;
        let (notices, lines) = Notices::new();
        let (users, login) = with_ourselves(options.users);
        // From here on it is stopped as a broker is: a runtime must not be dropped where others run.
        let mut broker = Self {
            runtime: Some(runtime),
            address: options.listen,
            tls_address: None,
            login,
            notices: Some(lines),
        };
        let Some(runtime) = &broker.runtime else { return Ok(broker) };
        let _inside = runtime.enter();
        let (notices, peers) = (Arc::new(notices), Arc::new(Peers::default()));
        let plain = bind(options.listen, options.robots)?;
        broker.address = plain.local_addr().unwrap_or(options.listen);
        let mut listeners = vec![plain];
        if let (Some(tls), Some(acceptor)) = (&options.tls, acceptor) {
            let outer = listen(tls.listen)?;
            broker.tls_address = outer.local_addr().ok();
            let inside = bind((Ipv4Addr::LOCALHOST, 0).into(), options.robots)?;
            let inner = inside
                .local_addr()
                .map_err(|error| cannot_listen(tls.listen, &error.to_string(), TLS_OPTION))?;
            peers.expect_on(inner.port());
            listeners.push(inside);
            let gate = Gate { acceptor, inner, peers: peers.clone(), notices: notices.clone() };
            runtime.spawn(gate.run(outer));
        }
        runtime.spawn(serve(listeners, Door { users: Arc::new(users), notices, peers }));
        Ok(broker)
    }

    /// How this program's own parts reach it.
    pub fn url(&self) -> BrokerUrl {
        let ip = match self.address.ip() {
            ip if !ip.is_unspecified() => ip.to_string(),
            std::net::IpAddr::V4(_) => "127.0.0.1".into(),
            std::net::IpAddr::V6(_) => "::1".into(),
        };
        let (user, password) = self.login.clone().unzip();
        BrokerUrl::new(ip, self.address.port()).with_login(user, password)
    }

    /// Where it speaks TLS.
    pub fn tls_address(&self) -> Option<SocketAddr> {
        self.tls_address
    }

    /// What it refuses from now on, a line each; once.
    pub fn notices(&mut self) -> Option<mpsc::Receiver<String>> {
        self.notices.take()
    }
}

/// Refuses to be open to everybody who can reach it.
fn check_exposure(options: &BrokerOptions) -> Result<(), Failure> {
    let open = |listen: SocketAddr| {
        let line = "name who may use it with --mqtt-user USER:PASSWORD or --mqtt-users FILE";
        Err(Failure::input(format!("the broker would be open to everyone on {listen}: {line}")))
    };
    if !options.users.is_empty() {
        return Ok(());
    }
    if !options.listen.ip().is_loopback() {
        return open(options.listen);
    }
    match &options.tls {
        Some(tls) if tls.client_ca.is_none() && !tls.listen.ip().is_loopback() => open(tls.listen),
        _ => Ok(()),
    }
}

/// Where users are named, this program is one of them.
fn with_ourselves(users: Users) -> (Users, Option<(String, String)>) {
    if users.is_empty() {
        return (users, None);
    }
    let (name, password) = (format!("lightbots-{}", random_id()), random_id().to_string());
    (users.with(&name, &password, Role::Controller), Some((name, password)))
}

impl Drop for Broker {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

const PLAIN_OPTION: &str = "--mqtt-listen";
const TLS_OPTION: &str = "--mqtt-tls-listen";

fn bind(listen: SocketAddr, robots: usize) -> Result<Listener, Failure> {
    let inflight = NonZeroU16::new(100).unwrap_or(NonZeroU16::MIN);
    let builder = Builder::new()
        .name("lightbots")
        .laddr(listen)
        .backlog(4096)
        .nodelay(true)
        .reuseaddr(Some(true))
        // The door decides about everybody.
        .allow_anonymous(false)
        .max_packet_size(LONGEST_PACKET)
        .max_handshaking_limit(20_000)
        .max_inflight(inflight)
        .max_mqueue_len((robots * 2).max(100_000));
    builder
        .bind()
        .and_then(|listener| listener.tcp())
        .map_err(|error| cannot_listen(listen, &error.to_string(), PLAIN_OPTION))
}

/// The socket before the gate.
fn listen(address: SocketAddr) -> Result<tokio::net::TcpListener, Failure> {
    let socket =
        if address.is_ipv4() { tokio::net::TcpSocket::new_v4() } else { tokio::net::TcpSocket::new_v6() };
    socket
        .and_then(|socket| {
            socket.set_reuseaddr(true)?;
            socket.bind(address)?;
            socket.listen(4096)
        })
        .map_err(|error| cannot_listen(address, &error.to_string(), TLS_OPTION))
}

/// One line for an address that cannot be listened on.
fn cannot_listen(listen: SocketAddr, why: &str, option: &str) -> Failure {
    let why = why.to_ascii_lowercase();
    if why.contains("in use") {
        let line =
            format!("stop the other broker there, use it with --broker, or choose a port with {option}");
        return Failure::problem(format!("the broker's address {listen} is taken: {line}"));
    }
    Failure::problem(format!("the broker cannot listen on {listen}: {why}; choose another {option}"))
}

async fn serve(listeners: Vec<Listener>, door: Door) {
    // Whether it thinks the machine busy must not turn robots away: a noisy neighbour is no reason to lose a show.
    let context = ServerContext::new().busy_check_enable(false).build().await;
    door.hang(&context).await;
    let mut server = MqttServer::new(context);
    for listener in listeners {
        let id = listener.local_addr().map_or(1883, |address| address.port());
        server = server.listener_by_id(listener, id);
    }
    if let Err(error) = server.build().run().await {
        tracing::error!("the broker failed: {error}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn options(listen: &str) -> BrokerOptions {
        BrokerOptions { listen: listen.parse().unwrap(), tls: None, users: Users::default(), robots: 1 }
    }

    #[test]
    fn beyond_this_machine_somebody_must_be_named() {
        let refused = |options| Broker::start(options).unwrap_err();
        assert_eq!(refused(options("0.0.0.0:0")).code, 2);
        let tls = |client_ca: Option<&str>| TlsOptions {
            listen: "0.0.0.0:0".parse().unwrap(),
            cert: "no-such.pem".into(),
            key: "no-such.key".into(),
            client_ca: client_ca.map(Into::into),
        };
        let with = |client_ca| BrokerOptions { tls: Some(tls(client_ca)), ..options("127.0.0.1:0") };
        assert!(refused(with(None)).line.contains("open to everyone"));
        assert!(refused(with(Some("no-such-ca.pem"))).line.contains("no-such-ca.pem cannot be used"));
    }

    #[test]
    fn a_taken_port_is_said_in_one_line() {
        let first = Broker::start(options("127.0.0.1:0")).unwrap();
        let error = Broker::start(options(&first.address.to_string())).unwrap_err();
        assert!(error.line.contains("is taken") && !error.line.contains('\n'), "{}", error.line);
    }
}

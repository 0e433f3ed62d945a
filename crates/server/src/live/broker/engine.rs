//! The embedded broker in this process. rmqtt has a runtime of its own, because only the end of the runtime stops it.

use std::net::{Ipv4Addr, SocketAddr};
use std::num::NonZeroU16;
use std::sync::Arc;
use std::time::Duration;

use rmqtt::context::ServerContext;
use rmqtt::net::{Builder, Listener};
use rmqtt::server::MqttServer;
use tokio::sync::mpsc;

use super::admitted::Admitted;
use super::door::Door;
use super::gate::{Gate, Peers, TlsOptions};
use super::groups::Groups;
use super::keep_alive::KeepAlive;
use super::notices::Notices;
use super::retained::Retained;
use super::routing::BoundedShared;
use super::{BrokerOptions, idle, limits};
use crate::failure::Failure;
use crate::open_files;

/// A broker that runs until it is dropped.
#[derive(Debug)]
pub struct Engine {
    runtime: Option<tokio::runtime::Runtime>,
    address: SocketAddr,
    tls_address: Option<SocketAddr>,
    notices: Option<mpsc::Receiver<String>>,
}

impl Engine {
    /// Starts to listen. Without users in `options`, an error is returned if other machines can reach the broker. For the
    /// TLS address, an authority of client certificates is enough instead of users.
    pub fn start(options: BrokerOptions) -> Result<Self, Failure> {
        options.check_exposure()?;
        let acceptor = options.tls.as_ref().map(TlsOptions::acceptor).transpose()?;
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .thread_name("broker")
            .enable_all()
            .build()
            .map_err(|error| Failure::problem(format!("the system gives the broker no threads: {error}")))?;
        let (notices, lines) = Notices::new();
        // From here on, `Engine::drop` stops the runtime after an error: a runtime must not be dropped within another
        // one.
        let mut engine =
            Self { runtime: Some(runtime), address: options.listen, tls_address: None, notices: Some(lines) };
        let Some(runtime) = &engine.runtime else { return Ok(engine) };
        let _inside = runtime.enter();
        let (notices, peers) = (Arc::new(notices), Arc::new(Peers::default()));
        let plain = bind(options.listen, options.robots)?;
        engine.address = plain.local_addr().unwrap_or(options.listen);
        let mut listeners = vec![plain];
        if let (Some(tls), Some(acceptor)) = (&options.tls, acceptor) {
            let outer = listen(tls.listen)?;
            engine.tls_address = outer.local_addr().ok();
            let inside = bind((Ipv4Addr::LOCALHOST, 0).into(), options.robots)?;
            let inner = inside
                .local_addr()
                .map_err(|error| cannot_listen(tls.listen, &error.to_string(), TLS_OPTION))?;
            peers.expect_on(inner.port());
            listeners.push(inside);
            let gate = Gate { acceptor, inner, peers: peers.clone(), notices: notices.clone() };
            runtime.spawn(gate.run(outer));
        }
        runtime.spawn(serve(listeners, options, notices, peers));
        Ok(engine)
    }

    /// Address for MQTT without TLS.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Address for MQTT with TLS; `None` without TLS.
    pub fn tls_address(&self) -> Option<SocketAddr> {
        self.tls_address
    }

    /// Returns the receiver of lines about refused clients. `None` after the first call.
    pub fn notices(&mut self) -> Option<mpsc::Receiver<String>> {
        self.notices.take()
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

/// Option of the command line for the address without TLS, for error messages.
const PLAIN_OPTION: &str = "--mqtt-listen";
/// Option of the command line for the address with TLS, for error messages.
const TLS_OPTION: &str = "--mqtt-tls-listen";

fn bind(listen: SocketAddr, robots: usize) -> Result<Listener, Failure> {
    let inflight = NonZeroU16::new(100).unwrap_or(NonZeroU16::MIN);
    let builder = Builder::new()
        .name("lightbots")
        .laddr(listen)
        .backlog(4096)
        .nodelay(true)
        .reuseaddr(Some(true))
        // The door decides about every client.
        .allow_anonymous(false)
        .max_packet_size(limits::PACKET_BYTES)
        .max_topic_levels(limits::TOPIC_LEVELS)
        .max_clientid_len(limits::CLIENT_ID_BYTES)
        .max_subscriptions(limits::SUBSCRIPTIONS)
        .max_connections(limits::CONNECTIONS)
        .max_handshaking_limit(20_000)
        .handshake_timeout(limits::CONNECT_WITHIN)
        .send_timeout(limits::SEND_WITHIN)
        .session_expiry_interval(limits::SESSION_EXPIRY)
        .max_session_expiry_interval(limits::SESSION_EXPIRY)
        .max_topic_aliases(limits::TOPIC_ALIASES)
        // A message expires only if its publisher sets an expiry.
        .message_expiry_interval(Duration::ZERO)
        .max_inflight(inflight)
        .max_mqueue_len((robots * 2).max(100_000));
    builder
        .bind()
        .and_then(|listener| listener.tcp())
        .map_err(|error| cannot_listen(listen, &error.to_string(), PLAIN_OPTION))
}

/// Binds the socket of the TLS gate.
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

/// Returns the failure, one line, for an address on which the broker cannot listen.
fn cannot_listen(listen: SocketAddr, why: &str, option: &str) -> Failure {
    let why = why.to_ascii_lowercase();
    if why.contains("in use") {
        let line =
            format!("stop the other broker there, use it with --broker, or choose a port with {option}");
        return Failure::problem(format!("the broker's address {listen} is taken: {line}"));
    }
    Failure::problem(format!("the broker cannot listen on {listen}: {why}; choose another {option}"))
}

async fn serve(listeners: Vec<Listener>, options: BrokerOptions, notices: Arc<Notices>, peers: Arc<Peers>) {
    // rmqtt must not refuse robots because the machine is busy: the load of other programs is no reason to lose a show.
    let context =
        ServerContext::new().busy_check_enable(false).mqtt_max_sessions(limits::SESSIONS).build().await;
    BoundedShared::install(&context, notices.clone(), !options.users.is_empty()).await;
    *context.extends.retain_mut().await = Box::new(Retained::new(notices.clone()));
    *context.extends.shared_subscription_mut().await = Box::new(Groups::default());
    *context.extends.fitter_mgr_mut().await = Box::new(KeepAlive);
    let ports: Vec<u16> =
        listeners.iter().filter_map(|listener| Some(listener.local_addr().ok()?.port())).collect();
    let most = limits::connections(open_files::limit(), options.tls.is_some());
    if most < options.robots + SPARE {
        notices.say("", &too_few_files(most, options.robots));
    }
    let admitted = Arc::new(Admitted::new(most));
    tokio::spawn(idle::close_idle(ports, admitted.clone(), notices.clone()));
    let (users, takeovers, floods) = (Arc::new(options.users), Arc::default(), Arc::default());
    let door = Door { users, notices, peers, admitted, takeovers, floods, context: context.clone() };
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

/// Number of connections beside those of robots: controllers and tools.
const SPARE: usize = 10;

fn too_few_files(most: usize, robots: usize) -> String {
    format!(
        "The system lets the broker open {} files: at most {most} of {robots} robots can connect one by one. Raise the limit \
         with `ulimit -n`.",
        open_files::limit()
    )
}

#[cfg(test)]
mod tests {
    use super::super::Users;
    use super::*;

    fn options(listen: &str) -> BrokerOptions {
        BrokerOptions { listen: listen.parse().unwrap(), tls: None, users: Users::default(), robots: 1 }
    }

    #[test]
    fn beyond_this_machine_users_or_client_certificates_are_required() {
        let refused = |options| Engine::start(options).unwrap_err();
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
        let first = Engine::start(options("127.0.0.1:0")).unwrap();
        let error = Engine::start(options(&first.address.to_string())).unwrap_err();
        assert!(error.line.contains("is taken") && !error.line.contains('\n'), "{}", error.line);
    }
}

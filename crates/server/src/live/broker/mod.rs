//! The embedded broker. It runs in a process of its own, because a stack overflow or an exhausted memory ends a whole
//! process. `process` starts, watches and restarts this process, in which `engine` runs.
//!
//! `users` holds the users, `rights` decides what each may publish and subscribe to, and `door` applies both to every
//! client. `gate` handles TLS in front of it. `limits` holds most limits. `queues` bounds the bytes that wait for
//! clients, and `routing` puts each message into these queues. `idle` ends connections that do not log in, `flood`
//! those that publish too much. `sessions` keeps each session for the user that began it. `takeovers` finds robots that
//! share a name. `retained`, `groups` and `keep_alive` are parts of MQTT that rmqtt leaves to its embedder.

mod admitted;
mod door;
mod engine;
mod flood;
mod gate;
mod groups;
mod idle;
mod keep_alive;
mod limits;
mod notices;
mod process;
mod queues;
mod retained;
mod rights;
mod routing;
mod sessions;
mod takeovers;
mod users;

use std::net::SocketAddr;

use serde::{Deserialize, Serialize};

pub use engine::Engine;
pub use gate::TlsOptions;
pub use limits::PROCESS_BYTES;
pub use process::{EmbeddedBroker, child};
pub use users::Users;

use crate::failure::Failure;

/// Settings of a broker.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BrokerOptions {
    /// Address for MQTT without TLS.
    pub listen: SocketAddr,
    /// Address and certificates for MQTT with TLS; `None` without TLS.
    pub tls: Option<TlsOptions>,
    /// Users that may log in. If there are none, clients on this machine may connect without login, and over TLS also other
    /// clients with a certificate of the authority.
    pub users: Users,
    /// Expected number of robots, for the size of queues.
    pub robots: usize,
}

impl BrokerOptions {
    /// Checks that clients on other machines need a user or a certificate.
    fn check_exposure(&self) -> Result<(), Failure> {
        let open = |listen: SocketAddr| {
            let line = "name who may use it with --mqtt-user USER:PASSWORD or --mqtt-users FILE";
            Err(Failure::input(format!("the broker would be open to everyone on {listen}: {line}")))
        };
        if !self.users.is_empty() {
            return Ok(());
        }
        if !self.listen.ip().is_loopback() {
            return open(self.listen);
        }
        match &self.tls {
            Some(tls) if tls.client_ca.is_none() && !tls.listen.ip().is_loopback() => open(tls.listen),
            _ => Ok(()),
        }
    }
}

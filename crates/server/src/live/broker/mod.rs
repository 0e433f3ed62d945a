//! The embedded broker. It runs in a process of its own, because a stack overflow or an exhausted memory ends a whole
//! process: `process` starts it, watches it and starts it again; `engine` is what runs there.
//!
//! `users` says which users there are, `rights` what each may publish and subscribe to, `door` asks both for every
//! client; `gate` speaks TLS before it. `limits` names every limit; `queues` bounds the bytes that wait for clients,
//! `routing` puts each message into them, `idle` ends connections that do not log in, `flood` those that publish too much;
//! `sessions` keeps each session for its login, `takeovers` finds robots that share a name. `retained`, `groups` and
//! `keep_alive` are parts of MQTT that rmqtt leaves to its embedder.

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

/// What a broker needs to know.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct BrokerOptions {
    /// Where it speaks MQTT without TLS.
    pub listen: SocketAddr,
    /// Where it speaks TLS, if anywhere.
    pub tls: Option<TlsOptions>,
    /// The users it lets in; with none, every client on this machine.
    pub users: Users,
    /// How many robots there may be: queues are sized for them.
    pub robots: usize,
}

impl BrokerOptions {
    /// Refuses to be open to every machine that can reach it.
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

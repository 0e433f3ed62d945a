//! Connections whose clients have logged in.
// Only on Linux connections without a login are found.
#![cfg_attr(not(target_os = "linux"), allow(dead_code))]

use std::collections::BTreeSet;
use std::net::SocketAddr;
use std::sync::{Mutex, PoisonError};

use super::limits;

/// By the address at the other end of the connection.
#[derive(Debug, Default)]
pub struct Admitted(Mutex<BTreeSet<SocketAddr>>);

impl Admitted {
    /// Adds one; false where there are [`limits::CONNECTIONS`] already.
    pub fn add(&self, peer: SocketAddr) -> bool {
        let mut peers = self.lock();
        peers.contains(&peer) || (peers.len() < limits::CONNECTIONS && peers.insert(peer))
    }

    /// The connection has ended.
    pub fn remove(&self, peer: SocketAddr) {
        self.lock().remove(&peer);
    }

    /// Whether the client there has logged in.
    pub fn contains(&self, peer: SocketAddr) -> bool {
        self.lock().contains(&peer)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeSet<SocketAddr>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_room_for_a_bounded_number_of_connections() {
        let admitted = Admitted::default();
        let peer = |number: usize| SocketAddr::from(([10, 0, (number >> 8) as u8, number as u8], 1));
        assert!((0..limits::CONNECTIONS).all(|number| admitted.add(peer(number))));
        assert!(!admitted.add(peer(limits::CONNECTIONS)) && admitted.add(peer(0)));
        admitted.remove(peer(0));
        assert!(admitted.add(peer(limits::CONNECTIONS)) && !admitted.contains(peer(0)));
    }
}

//! Connections whose clients have logged in.
// Connections without a login are found only on Linux.
#![cfg_attr(not(target_os = "linux"), allow(dead_code))]

use std::collections::BTreeSet;
use std::net::SocketAddr;
use std::sync::{Mutex, PoisonError};

/// Logged-in connections by the address of the client.
#[derive(Debug)]
pub struct Admitted {
    most: usize,
    peers: Mutex<BTreeSet<SocketAddr>>,
}

impl Admitted {
    /// Room for `most` connections.
    pub fn new(most: usize) -> Self {
        Self { most, peers: Mutex::default() }
    }

    /// The most connections that may be logged in.
    pub fn most(&self) -> usize {
        self.most
    }

    /// Adds a connection. Returns false if `most` other connections are logged in already.
    pub fn add(&self, peer: SocketAddr) -> bool {
        let mut peers = self.lock();
        peers.contains(&peer) || (peers.len() < self.most && peers.insert(peer))
    }

    /// Removes a connection that has ended.
    pub fn remove(&self, peer: SocketAddr) {
        self.lock().remove(&peer);
    }

    /// Whether the client at this address has logged in.
    pub fn contains(&self, peer: SocketAddr) -> bool {
        self.lock().contains(&peer)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeSet<SocketAddr>> {
        self.peers.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_room_for_a_bounded_number_of_connections() {
        let admitted = Admitted::new(300);
        let peer = |number: usize| SocketAddr::from(([10, 0, (number >> 8) as u8, number as u8], 1));
        assert!((0..300).all(|number| admitted.add(peer(number))));
        assert!(!admitted.add(peer(300)) && admitted.add(peer(0)));
        admitted.remove(peer(0));
        assert!(admitted.add(peer(300)) && !admitted.contains(peer(0)));
    }
}

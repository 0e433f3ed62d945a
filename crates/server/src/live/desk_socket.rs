//! UDP sockets on which packets of desks are received.

use std::net::{IpAddr, SocketAddr};

use tokio::net::UdpSocket;

use crate::failure::Failure;
use crate::say;

/// Binds a socket for the protocol `name` and prints its address. `None` if `address` is `None`. If other machines can reach
/// the socket, prints `may`: what their packets can do. The failure is one line with a remedy.
pub async fn listen(
    name: &str,
    option: &str,
    address: Option<SocketAddr>,
    may: &str,
) -> Result<Option<UdpSocket>, Failure> {
    let Some(address) = address else { return Ok(None) };
    let socket = UdpSocket::bind(address).await.map_err(|error| {
        Failure::problem(format!("cannot receive {name} on {address}: {error}; choose another {option}"))
    })?;
    let address = socket.local_addr().unwrap_or(address);
    say::line(&format!("{name} is received on {address}"));
    if !address.ip().is_loopback() {
        say::note(&format!("{name} has no passwords: a program that reaches {address} can {may}"));
    }
    Ok(Some(socket))
}

/// Receives the next packet into `bytes` and returns its length and its sender. Without a socket, waits for ever.
/// Cancel-safe.
pub async fn receive(socket: Option<&UdpSocket>, bytes: &mut [u8]) -> std::io::Result<(usize, IpAddr)> {
    match socket {
        Some(socket) => socket.recv_from(bytes).await.map(|(length, from)| (length, from.ip())),
        None => std::future::pending().await,
    }
}

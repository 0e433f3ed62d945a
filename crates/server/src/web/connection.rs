//! Connections of browsers with the addresses of both ends.

use std::io;
use std::net::SocketAddr;

use axum::extract::connect_info::Connected;
use axum::serve::{IncomingStream, Listener};
use tokio::net::{TcpListener, TcpStream};

/// Addresses of a connection.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Address of the client.
    pub remote: SocketAddr,
    /// Address of this server that the client reached.
    pub local: SocketAddr,
}

/// Accepts connections and adds their addresses.
pub struct Connections(pub TcpListener);

impl Listener for Connections {
    type Io = TcpStream;
    type Addr = Ends;

    async fn accept(&mut self) -> (TcpStream, Ends) {
        loop {
            let (stream, remote) = Listener::accept(&mut self.0).await;
            // Without it the kernel may hold a snapshot back until the one before is acknowledged.
            let _ = stream.set_nodelay(true);
            // A closed connection has no address.
            if let Ok(local) = stream.local_addr() {
                return (stream, Ends { remote, local });
            }
        }
    }

    fn local_addr(&self) -> io::Result<Ends> {
        let local = self.0.local_addr()?;
        Ok(Ends { remote: local, local })
    }
}

impl Connected<IncomingStream<'_, Connections>> for Ends {
    fn connect_info(stream: IncomingStream<'_, Connections>) -> Self {
        *stream.remote_addr()
    }
}

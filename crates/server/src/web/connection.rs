//! Connections of browsers, with the address of this server that each came in on.

use std::io;
use std::net::SocketAddr;

use axum::extract::connect_info::Connected;
use axum::serve::{IncomingStream, Listener};
use tokio::net::{TcpListener, TcpStream};

/// Ends of a connection.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Of the client.
    pub remote: SocketAddr,
    /// Of this server: which of its addresses the client reached.
    pub local: SocketAddr,
}

/// Takes connections and keeps their ends.
pub struct Connections(pub TcpListener);

impl Listener for Connections {
    type Io = TcpStream;
    type Addr = Ends;

    async fn accept(&mut self) -> (TcpStream, Ends) {
        loop {
            let (stream, remote) = Listener::accept(&mut self.0).await;
            // Without it a snapshot may wait for the one before it to be acknowledged.
            let _ = stream.set_nodelay(true);
            // One that has gone already has no address any more.
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

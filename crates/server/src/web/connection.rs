//! Connections to the web app, with the addresses of both ends.

use std::io;
use std::net::SocketAddr;
use std::time::{Duration, Instant};

use axum::extract::connect_info::Connected;
use axum::serve::{IncomingStream, Listener};
use lightbots_api::Level;
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinSet;
use tokio_rustls::TlsAcceptor;

use super::guests::{Guest, Guests};
use super::log::ScreenLog;
use super::stream::Stream;
use crate::open_files;

/// Most connections of screens and scripts. A screen has one for its pictures and up to six for requests.
const MOST: usize = 1_000;
/// Shortest time between two lines about refused connections.
const SAY_EVERY: Duration = Duration::from_secs(10);
/// Pause after the system refused a connection.
const AGAIN_IN: Duration = Duration::from_millis(100);

/// Addresses of both ends of a connection.
#[derive(Clone, Copy, Debug)]
pub struct Ends {
    /// Address of the client.
    pub remote: SocketAddr,
    /// Address of this server that the client reached.
    pub local: SocketAddr,
    /// Whether the client speaks TLS.
    pub is_secure: bool,
}

/// Accepts a bounded number of connections, and passes on each with the addresses of both ends.
pub struct Connections {
    listener: TcpListener,
    /// Does TLS handshakes; `None` if the web app is served without TLS.
    acceptor: Option<TlsAcceptor>,
    /// Connections whose TLS handshake is under way. Each has a place in `guests`, which bounds their number.
    handshakes: JoinSet<Option<(Stream, Ends)>>,
    guests: Guests,
    log: ScreenLog,
    /// Time of the last line about refused connections.
    said: Option<Instant>,
}

impl Connections {
    /// Accepts connections of the listener: at most `MOST`, and at most half of the files that the system lets this
    /// program open. The rest is kept free, because the library and the link to the broker need files, too. Refusals
    /// are written to the log. `longest_wait`: longest time that a client waits for an answer without sending.
    pub fn new(
        listener: TcpListener,
        acceptor: Option<TlsAcceptor>,
        log: ScreenLog,
        longest_wait: Duration,
    ) -> Self {
        let guests = Guests::new(MOST.min(open_files::limit() / 2), longest_wait);
        Self { listener, acceptor, handshakes: JoinSet::new(), guests, log, said: None }
    }

    /// Gives a connection a place. If there is no room, closes the connection and returns `None`.
    fn admit(&mut self, stream: TcpStream) -> Option<Guest> {
        let place = self.guests.admit(Instant::now());
        if place.is_none() {
            let most = self.guests.most();
            self.say(&format!(
                "The web app has {most} connections, the most it takes: further ones are refused. Close pages, or \
                 find the program that opens so many."
            ));
        }
        Some(Guest::new(stream, place?))
    }

    /// Logs an error of the system, and waits for `AGAIN_IN`. If the system allows no more open files, also closes the
    /// connection that has been silent for longest. Ignores connections that broke off by themselves.
    async fn failed(&mut self, error: &io::Error) {
        use io::ErrorKind::{ConnectionAborted, ConnectionReset, Interrupted};
        if matches!(error.kind(), ConnectionAborted | ConnectionReset | Interrupted) {
            return;
        }
        if open_files::is_limit(error) {
            let limit = open_files::limit();
            self.say(&format!(
                "The system lets this program open no more files or connections (at most {limit}): pages cannot \
                 connect. Raise the limit with `ulimit -n`."
            ));
            self.guests.close_silent(Instant::now());
        } else {
            self.say(&format!("The system refuses connections of pages: {error}."));
        }
        tokio::time::sleep(AGAIN_IN).await;
    }

    fn say(&mut self, line: &str) {
        if self.said.is_some_and(|said| said.elapsed() < SAY_EVERY) {
            return;
        }
        self.said = Some(Instant::now());
        tracing::warn!("{line}");
        self.log.say(Level::Warn, line);
    }
}

impl Listener for Connections {
    type Io = Stream;
    type Addr = Ends;

    async fn accept(&mut self) -> (Stream, Ends) {
        loop {
            let accepted = tokio::select! {
                Some(opened) = self.handshakes.join_next() => match opened {
                    Ok(Some(opened)) => return opened,
                    _ => continue,
                },
                accepted = self.listener.accept() => accepted,
            };
            let (stream, remote) = match accepted {
                Ok(accepted) => accepted,
                Err(error) => {
                    self.failed(&error).await;
                    continue;
                }
            };
            // Without this, the kernel may hold a snapshot back until the one before is acknowledged.
            let _ = stream.set_nodelay(true);
            // A closed connection has no address.
            let Ok(local) = stream.local_addr() else { continue };
            let Some(guest) = self.admit(stream) else { continue };
            let ends = move |is_secure| Ends { remote, local, is_secure };
            let Some(acceptor) = self.acceptor.clone() else { return (Stream::Plain(guest), ends(false)) };
            // In a task of its own, so that a slow handshake delays no other connection.
            self.handshakes.spawn(async move {
                let stream = Stream::open(acceptor, guest).await?;
                let ends = ends(stream.is_secure());
                Some((stream, ends))
            });
        }
    }

    fn local_addr(&self) -> io::Result<Ends> {
        let local = self.listener.local_addr()?;
        Ok(Ends { remote: local, local, is_secure: self.acceptor.is_some() })
    }
}

impl Connected<IncomingStream<'_, Connections>> for Ends {
    fn connect_info(stream: IncomingStream<'_, Connections>) -> Self {
        *stream.remote_addr()
    }
}

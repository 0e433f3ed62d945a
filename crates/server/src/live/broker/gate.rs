//! TLS before the embedded broker: takes connections, opens them, and hands them over to a listener on loopback that
//! refuses all other clients.
//!
//! The broker's own TLS would bring a second set of cryptography that is built from C for minutes, and says less about
//! why a client was refused.

use std::collections::BTreeMap;
use std::io;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use serde::{Deserialize, Serialize};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_rustls::{TlsAcceptor, rustls};

use super::notices::Notices;
use crate::failure::Failure;
use crate::tls;

/// A client that has not finished its handshake after `PATIENCE` is dropped.
const PATIENCE: Duration = Duration::from_secs(10);
/// A refused client may go on sending for `LINGER`, so that it receives the reason.
const LINGER: Duration = Duration::from_secs(1);
/// Connections at once; more wait.
const CONNECTIONS: usize = 20_000;
/// First byte of MQTT without TLS.
const MQTT: u8 = 0x10;

/// Where TLS is spoken, and with which certificates (PEM files).
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TlsOptions {
    /// The address.
    pub listen: SocketAddr,
    /// Our certificate with its chain.
    pub cert: PathBuf,
    /// Its key.
    pub key: PathBuf,
    /// The authority whose certificates clients must show; `None`: they need none.
    pub client_ca: Option<PathBuf>,
}

impl TlsOptions {
    /// Certificates read and checked; one line where they cannot be used.
    pub fn acceptor(&self) -> Result<TlsAcceptor, Failure> {
        let config = tls::server_config(&self.cert, &self.key, self.client_ca.as_deref());
        let remedy = "`lightbots certs` makes certificates";
        config.map(tls::acceptor).map_err(|why| Failure::input(format!("{why}; {remedy}")))
    }
}

/// Connections that were handed over: which address at the inner listener is which client.
#[derive(Debug, Default)]
pub struct Peers {
    /// Number of the inner listener; 0: there is none.
    inner: Mutex<u16>,
    clients: Mutex<BTreeMap<SocketAddr, SocketAddr>>,
}

impl Peers {
    /// Names the listener that only the gate may use.
    pub fn expect_on(&self, listener: u16) {
        *lock(&self.inner) = listener;
    }

    /// Whether a connection came in on that listener.
    pub fn is_inner(&self, listener: u16) -> bool {
        listener != 0 && *lock(&self.inner) == listener
    }

    /// The client behind an address at the inner listener.
    pub fn of(&self, from: Option<SocketAddr>) -> Option<SocketAddr> {
        lock(&self.clients).get(&from?).copied()
    }
}

/// What is inside is replaced in one step: a panic elsewhere leaves it whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Forgets a client when its connection ends, however it ends.
struct Guest {
    peers: Arc<Peers>,
    at: SocketAddr,
}

impl Drop for Guest {
    fn drop(&mut self) {
        lock(&self.peers.clients).remove(&self.at);
    }
}

/// The gate.
pub struct Gate {
    pub acceptor: TlsAcceptor,
    /// Where connections are handed over.
    pub inner: SocketAddr,
    pub peers: Arc<Peers>,
    pub notices: Arc<Notices>,
}

impl Gate {
    /// Takes connections until the task is dropped.
    pub async fn run(self, listener: TcpListener) {
        let (gate, room) = (Arc::new(self), Arc::new(Semaphore::new(CONNECTIONS)));
        loop {
            let Ok(place) = room.clone().acquire_owned().await else { return };
            match listener.accept().await {
                Ok((stream, client)) => {
                    let gate = gate.clone();
                    tokio::spawn(async move {
                        gate.serve(stream, client).await;
                        drop(place);
                    });
                }
                Err(error) => {
                    // Such as too many open files: others may leave meanwhile.
                    tracing::warn!("the broker cannot take a TLS connection: {error}");
                    tokio::time::sleep(Duration::from_secs(1)).await;
                }
            }
        }
    }

    async fn serve(&self, stream: TcpStream, client: SocketAddr) {
        // Without it answers may wait for the ones before them to be acknowledged.
        let _ = stream.set_nodelay(true);
        match self.open(stream, client).await {
            Ok(Some((mut outer, mut inner, _guest))) => {
                // Either side may simply go.
                let _ = tokio::io::copy_bidirectional(&mut outer, &mut inner).await;
            }
            Ok(None) => {}
            Err(why) => {
                let ip = client.ip();
                self.notices
                    .say(&ip.to_string(), &format!("The broker refused TLS with a client from {ip}: {why}."));
            }
        }
    }

    /// A client and the broker behind the gate; `None`: it went without a word.
    async fn open(&self, stream: TcpStream, client: SocketAddr) -> Result<Option<Opened>, String> {
        let mut first = [0];
        let peeked = tokio::time::timeout(PATIENCE, stream.peek(&mut first)).await;
        if !matches!(peeked, Ok(Ok(1))) {
            return Ok(None);
        }
        match first[0] {
            tls::FIRST_BYTE => {}
            MQTT => {
                return Err(
                    "it speaks MQTT without TLS: say mqtts:// there, or give it the plain port".into()
                );
            }
            _ => return Err("it speaks neither TLS nor MQTT".into()),
        }
        let accepting = self.acceptor.accept(stream).into_fallible();
        let outer = match tokio::time::timeout(PATIENCE, accepting).await {
            Ok(Ok(outer)) => outer,
            Ok(Err((error, stream))) => {
                linger(stream).await;
                return Err(handshake_reason(&error));
            }
            Err(_) => return Err("its handshake took too long".into()),
        };
        let inner =
            TcpStream::connect(self.inner).await.map_err(|error| format!("the broker is away: {error}"))?;
        let _ = inner.set_nodelay(true);
        let at = inner.local_addr().map_err(|error| error.to_string())?;
        // Before a byte goes through: the broker asks who it is with the first.
        lock(&self.peers.clients).insert(at, client);
        Ok(Some((outer, inner, Guest { peers: self.peers.clone(), at })))
    }
}

/// Hears a client out that was told why it is refused: closing on what it still says would lose that on its way.
async fn linger(mut stream: TcpStream) {
    let _ = stream.shutdown().await;
    let rest = async {
        let mut bytes = [0; 512];
        for _ in 0..64 {
            if !matches!(stream.read(&mut bytes).await, Ok(1..)) {
                break;
            }
        }
    };
    let _ = tokio::time::timeout(LINGER, rest).await;
}

type Opened = (tokio_rustls::server::TlsStream<TcpStream>, TcpStream, Guest);

fn handshake_reason(error: &io::Error) -> String {
    use rustls::{AlertDescription as Alert, CertificateError, Error};
    match error.get_ref().and_then(|inner| inner.downcast_ref::<Error>()) {
        Some(Error::AlertReceived(alert)) => match alert {
            Alert::UnknownCA
            | Alert::BadCertificate
            | Alert::CertificateUnknown
            | Alert::CertificateExpired => {
                format!(
                    "it does not trust our certificate ({alert:?}): give it the authority's, and a name or address that the certificate holds"
                )
            }
            other => format!("it broke off with {other:?}"),
        },
        Some(Error::NoCertificatesPresented) => {
            "it shows no certificate: give it one with --client-cert and --client-key".into()
        }
        Some(Error::InvalidCertificate(CertificateError::UnknownIssuer | CertificateError::BadSignature)) => {
            "its certificate comes from an authority that is not the one of --client-ca".into()
        }
        Some(Error::InvalidCertificate(why)) => format!("its certificate cannot be trusted: {why}"),
        Some(other) => other.to_string(),
        None => format!("it broke off: {error}"),
    }
}

//! TLS in front of the embedded broker. The gate accepts connections, decrypts them, and hands them over to a listener
//! on loopback that refuses all other clients.
//!
//! rmqtt's own TLS would bring a second library of cryptography, whose C code takes minutes to build. It also says less
//! about why a client was refused.

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

/// Longest wait for a client's first byte, and then for the end of its TLS handshake. After that the client is dropped.
const PATIENCE: Duration = Duration::from_secs(10);
/// Longest time for which a refused client may go on sending, so that it receives the reason.
const LINGER: Duration = Duration::from_secs(1);
/// Most TLS connections at once. Further ones wait until one of these ends.
const CONNECTIONS: usize = 20_000;
/// First byte of MQTT without TLS.
const MQTT: u8 = 0x10;

/// Address and certificates (PEM files) for TLS.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TlsOptions {
    /// Address on which TLS is spoken.
    pub listen: SocketAddr,
    /// The broker's certificate with its chain.
    pub cert: PathBuf,
    /// Private key of the certificate.
    pub key: PathBuf,
    /// The authority whose certificates clients must show; `None` if clients need no certificate.
    pub client_ca: Option<PathBuf>,
}

impl TlsOptions {
    /// Reads and checks the certificates. The failure is one line with a remedy.
    pub fn acceptor(&self) -> Result<TlsAcceptor, Failure> {
        let config = tls::server_config(&self.cert, &self.key, self.client_ca.as_deref());
        let remedy = "`lightbots certs` makes certificates";
        config.map(tls::acceptor).map_err(|why| Failure::input(format!("{why}; {remedy}")))
    }
}

/// Connections that the gate has handed over. Maps the address that the inner listener sees to the client's own address.
#[derive(Debug, Default)]
pub struct Peers {
    /// Port of the inner listener; 0 if there is none.
    inner: Mutex<u16>,
    clients: Mutex<BTreeMap<SocketAddr, SocketAddr>>,
}

impl Peers {
    /// Sets the port of the listener that only the gate may use.
    pub fn expect_on(&self, listener: u16) {
        *lock(&self.inner) = listener;
    }

    /// Whether this is the port of the listener that only the gate may use.
    pub fn is_inner(&self, listener: u16) -> bool {
        listener != 0 && *lock(&self.inner) == listener
    }

    /// Returns the client's own address for the address `from`, which the inner listener sees. `None` if the gate did not
    /// hand over that connection.
    pub fn of(&self, from: Option<SocketAddr>) -> Option<SocketAddr> {
        lock(&self.clients).get(&from?).copied()
    }
}

/// Locks a mutex, also after a panic of another task: each change is one step, so that the value is whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes a client from [`Peers`] when dropped. That happens when its connection ends, however it ends.
struct Guest {
    peers: Arc<Peers>,
    at: SocketAddr,
}

impl Drop for Guest {
    fn drop(&mut self) {
        lock(&self.peers.clients).remove(&self.at);
    }
}

/// Accepts TLS connections and hands them over to the broker.
pub struct Gate {
    pub acceptor: TlsAcceptor,
    /// Address of the listener to which connections are handed over.
    pub inner: SocketAddr,
    pub peers: Arc<Peers>,
    pub notices: Arc<Notices>,
}

impl Gate {
    /// Accepts connections until the task is dropped.
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
                    // For example too many open files: other connections may end meanwhile.
                    tracing::warn!("the broker cannot take a TLS connection: {error}");
                    tokio::time::sleep(Duration::from_secs(1)).await;
                }
            }
        }
    }

    async fn serve(&self, stream: TcpStream, client: SocketAddr) {
        // Without this, an answer may wait until the answer before it is acknowledged.
        let _ = stream.set_nodelay(true);
        match self.open(stream, client).await {
            Ok(Some((mut outer, mut inner, _guest))) => {
                // Either side may end the connection without notice, which is no error.
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

    /// Does the TLS handshake with a client and connects to the broker behind the gate. `None` if the client sent nothing in
    /// time, or closed the connection before its first byte. `Err`: why the client is refused.
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
        // Before the first byte goes through, because the broker then looks the client up.
        lock(&self.peers.clients).insert(at, client);
        Ok(Some((outer, inner, Guest { peers: self.peers.clone(), at })))
    }
}

/// Reads what a refused client still sends, for up to `LINGER` and 32 KiB. If the socket were closed with unread bytes,
/// the client might not receive the reason.
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

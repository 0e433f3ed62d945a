//! A browser's connection, with TLS or without.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll};
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio_rustls::TlsAcceptor;
use tokio_rustls::server::TlsStream;

use super::guests::Guest;
use crate::tls;

/// On a server with TLS: longest time from the connection to the end of the TLS handshake, or to the first byte of a
/// client without TLS.
const PATIENCE: Duration = Duration::from_secs(10);

/// A connection that is ready for HTTP.
#[derive(Debug)]
pub enum Stream {
    /// Without TLS.
    Plain(Guest),
    /// With TLS.
    Secure(Box<TlsStream<Guest>>),
}

impl Stream {
    /// Opens a connection to a server with TLS. A client that begins without TLS becomes [`Self::Plain`], because the
    /// server tells it the right address. `None` if the connection or the handshake failed or took too long.
    pub async fn open(acceptor: TlsAcceptor, guest: Guest) -> Option<Self> {
        let opening = async {
            if guest.first_byte().await? != tls::FIRST_BYTE {
                return Ok(Self::Plain(guest));
            }
            acceptor.accept(guest).await.map(|stream| Self::Secure(Box::new(stream)))
        };
        let opened: io::Result<Self> = tokio::time::timeout(PATIENCE, opening).await.ok()?;
        opened.inspect_err(|error| tracing::debug!("a TLS handshake failed: {error}")).ok()
    }

    /// Whether the client speaks TLS.
    pub fn is_secure(&self) -> bool {
        matches!(self, Self::Secure(_))
    }
}

impl AsyncRead for Stream {
    fn poll_read(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        match self.get_mut() {
            Self::Plain(stream) => Pin::new(stream).poll_read(context, bytes),
            Self::Secure(stream) => Pin::new(stream).poll_read(context, bytes),
        }
    }
}

impl AsyncWrite for Stream {
    fn poll_write(self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        match self.get_mut() {
            Self::Plain(stream) => Pin::new(stream).poll_write(context, bytes),
            Self::Secure(stream) => Pin::new(stream).poll_write(context, bytes),
        }
    }

    fn poll_write_vectored(
        self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        match self.get_mut() {
            Self::Plain(stream) => Pin::new(stream).poll_write_vectored(context, bytes),
            Self::Secure(stream) => Pin::new(stream).poll_write_vectored(context, bytes),
        }
    }

    fn is_write_vectored(&self) -> bool {
        match self {
            Self::Plain(stream) => stream.is_write_vectored(),
            Self::Secure(stream) => stream.is_write_vectored(),
        }
    }

    fn poll_flush(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        match self.get_mut() {
            Self::Plain(stream) => Pin::new(stream).poll_flush(context),
            Self::Secure(stream) => Pin::new(stream).poll_flush(context),
        }
    }

    fn poll_shutdown(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        match self.get_mut() {
            Self::Plain(stream) => Pin::new(stream).poll_shutdown(context),
            Self::Secure(stream) => Pin::new(stream).poll_shutdown(context),
        }
    }
}

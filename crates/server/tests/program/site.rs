//! The address of a server for screens, and connections to it with or without TLS.

use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, ServerName};
use tokio_rustls::rustls::{ClientConfig, ClientConnection, RootCertStore, StreamOwned};

/// A server's address, and the certificate that its clients trust.
#[derive(Clone)]
pub struct Site {
    /// `host:port`.
    pub address: String,
    /// The certificate that a client trusts. `None` without TLS.
    root: Option<CertificateDer<'static>>,
}

impl From<&str> for Site {
    fn from(address: &str) -> Self {
        Self { address: address.to_owned(), root: None }
    }
}

impl From<&String> for Site {
    fn from(address: &String) -> Self {
        address.as_str().into()
    }
}

impl From<&Self> for Site {
    fn from(site: &Self) -> Self {
        site.clone()
    }
}

impl Site {
    /// A server with TLS. `root` is the file of its certificate or of its authority's.
    pub fn secure(address: &str, root: &str) -> Self {
        let root = CertificateDer::from_pem_file(root).unwrap_or_else(|error| panic!("{root}: {error}"));
        Self { address: address.to_owned(), root: Some(root) }
    }

    pub fn scheme(&self) -> &'static str {
        if self.root.is_some() { "https" } else { "http" }
    }

    /// Opens a connection, including the TLS handshake.
    pub fn connect(&self) -> io::Result<Line> {
        let mut stream = TcpStream::connect(&self.address)?;
        let Some(root) = &self.root else { return Ok(Line::Plain(stream)) };
        let mut roots = RootCertStore::empty();
        roots.add(root.clone()).map_err(io::Error::other)?;
        let config = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions()
            .map_err(io::Error::other)?
            .with_root_certificates(roots)
            .with_no_client_auth();
        let host = self.address.rsplit_once(':').map_or("", |(host, _)| host).to_owned();
        let name = ServerName::try_from(host).map_err(io::Error::other)?;
        let mut client = ClientConnection::new(Arc::new(config), name).map_err(io::Error::other)?;
        while client.is_handshaking() {
            client.complete_io(&mut stream)?;
        }
        Ok(Line::Secure(Box::new(StreamOwned::new(client, stream))))
    }
}

/// A connection to a site.
pub enum Line {
    Plain(TcpStream),
    Secure(Box<StreamOwned<ClientConnection, TcpStream>>),
}

impl Line {
    /// Sets how long a read waits.
    pub fn set_read_timeout(&self, time: Duration) {
        let stream = match self {
            Self::Plain(stream) => stream,
            Self::Secure(stream) => &stream.sock,
        };
        stream.set_read_timeout(Some(time)).unwrap();
    }
}

impl Read for Line {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Plain(stream) => stream.read(bytes),
            Self::Secure(stream) => stream.read(bytes),
        }
    }
}

impl Write for Line {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Plain(stream) => stream.write(bytes),
            Self::Secure(stream) => stream.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Plain(stream) => stream.flush(),
            Self::Secure(stream) => stream.flush(),
        }
    }
}

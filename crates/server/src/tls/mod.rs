//! TLS of the embedded broker and of the web app: content of certificates, and server settings from files.

mod issue;
mod key_file;

use std::path::Path;
use std::sync::Arc;

use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::server::WebPkiClientVerifier;
use tokio_rustls::rustls::{RootCertStore, ServerConfig};

pub use issue::{OWN_NAMES, params, self_signed};
pub use key_file::keep_private;

/// First byte of a TLS connection: a handshake record, RFC 8446, section 5.1.
pub const FIRST_BYTE: u8 = 0x16;

/// Returns the TLS settings of a server with the certificate `cert` (PEM, with its chain) and its key. With `client_ca`,
/// clients must show a certificate of that authority. The error names the file, without a remedy.
pub fn server_config(cert: &Path, key: &Path, client_ca: Option<&Path>) -> Result<ServerConfig, String> {
    let provider = Arc::new(ring::default_provider());
    let builder = ServerConfig::builder_with_provider(provider.clone())
        .with_safe_default_protocol_versions()
        .map_err(|error| format!("TLS cannot be set up: {error}"))?;
    let builder = match client_ca {
        None => builder.with_no_client_auth(),
        Some(path) => {
            let mut roots = RootCertStore::empty();
            roots.add_parsable_certificates(certificates(path)?);
            let verifier = WebPkiClientVerifier::builder_with_provider(Arc::new(roots), provider).build();
            builder.with_client_cert_verifier(verifier.map_err(|error| unusable(path, &error.to_string()))?)
        }
    };
    let secret = PrivateKeyDer::from_pem_file(key)
        .map_err(|error| unusable(key, &format!("{error}; it must hold a private key (PEM)")))?;
    builder.with_single_cert(certificates(cert)?, secret).map_err(|error| {
        let (cert, key) = (cert.display(), key.display());
        format!("the certificate {cert} and the key {key} do not fit together: {error}")
    })
}

/// Returns the acceptor of a TLS server.
pub fn acceptor(config: ServerConfig) -> TlsAcceptor {
    TlsAcceptor::from(Arc::new(config))
}

/// Reads the certificates of a PEM file, at least one. The error names the file, without a remedy.
pub fn certificates(path: &Path) -> Result<Vec<CertificateDer<'static>>, String> {
    let found = CertificateDer::pem_file_iter(path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    match found {
        Ok(found) if !found.is_empty() => Ok(found),
        Ok(_) => Err(unusable(path, "it holds no certificate (PEM)")),
        Err(error) => Err(unusable(path, &error.to_string())),
    }
}

fn unusable(path: &Path, why: &str) -> String {
    format!("{} cannot be used: {why}", path.display())
}

//! Trusted authorities and our own certificate for TLS.

use std::fmt;
use std::path::Path;
use std::sync::{Arc, OnceLock};

use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::{Error as PemError, PemObject};
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::{ClientConfig, RootCertStore};

/// Trusted certificate authorities, and a client certificate for brokers that ask for one. A clone shares the content
/// of the original. Two values are equal only if they share their content.
#[derive(Clone)]
pub struct TlsTrust(Arc<ClientConfig>);

/// Why certificates cannot be used: one line for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TlsTrustError(String);

/// A PEM text with a name, such as the name of its file.
#[derive(Clone, Copy, Debug)]
pub struct Pem<'a> {
    /// Name of the text in error messages.
    pub name: &'a str,
    /// The PEM text.
    pub bytes: &'a [u8],
}

impl TlsTrust {
    /// Builds the TLS settings. `ca` has the trusted certificate authorities; `None`: those of the system. `client` is
    /// the client certificate with its chain, and its key; `None`: no client certificate. An error says which text is
    /// unusable and why.
    pub fn new(ca: Option<Pem<'_>>, client: Option<(Pem<'_>, Pem<'_>)>) -> Result<Self, TlsTrustError> {
        let roots = match ca {
            Some(pem) => roots_from(pem)?,
            None => system_roots()?,
        };
        let builder = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions()
            .map_err(|error| TlsTrustError(format!("TLS cannot be set up: {error}")))?
            .with_root_certificates(roots);
        let config = match client {
            None => builder.with_no_client_auth(),
            Some((certificate, key)) => builder
                .with_client_auth_cert(certificates(certificate)?, private_key(key)?)
                .map_err(|error| {
                    let names =
                        format!("the client certificate {} and the key {}", certificate.name, key.name);
                    TlsTrustError(format!("{names} do not fit together: {error}"))
                })?,
        };
        Ok(Self(Arc::new(config)))
    }

    /// Like [`Self::new`], but reads the PEM texts from files.
    pub fn read(ca: Option<&Path>, client: Option<(&Path, &Path)>) -> Result<Self, TlsTrustError> {
        let ca = ca.map(PemFile::read).transpose()?;
        let client = match client {
            Some((certificate, key)) => Some((PemFile::read(certificate)?, PemFile::read(key)?)),
            None => None,
        };
        let client = client.as_ref().map(|(certificate, key)| (certificate.pem(), key.pem()));
        Self::new(ca.as_ref().map(PemFile::pem), client)
    }

    /// Returns the settings that trust the certificate authorities of the system, without a client certificate. The
    /// authorities are read at the first call only; later calls return the same settings or the same error.
    pub(crate) fn of_system() -> Result<Self, TlsTrustError> {
        static SYSTEM: OnceLock<Result<TlsTrust, TlsTrustError>> = OnceLock::new();
        SYSTEM.get_or_init(|| Self::new(None, None)).clone()
    }

    pub(crate) fn config(&self) -> Arc<ClientConfig> {
        self.0.clone()
    }
}

struct PemFile {
    name: String,
    bytes: Vec<u8>,
}

impl PemFile {
    fn read(path: &Path) -> Result<Self, TlsTrustError> {
        let name = path.display().to_string();
        match std::fs::read(path) {
            Ok(bytes) => Ok(Self { name, bytes }),
            Err(error) => Err(TlsTrustError(format!("{name} cannot be read: {error}"))),
        }
    }

    fn pem(&self) -> Pem<'_> {
        Pem { name: &self.name, bytes: &self.bytes }
    }
}

fn roots_from(pem: Pem<'_>) -> Result<RootCertStore, TlsTrustError> {
    let mut roots = RootCertStore::empty();
    for certificate in certificates(pem)? {
        roots.add(certificate).map_err(|error| {
            TlsTrustError(format!("{} holds a certificate nobody can read: {error}", pem.name))
        })?;
    }
    Ok(roots)
}

fn system_roots() -> Result<RootCertStore, TlsTrustError> {
    let found = rustls_native_certs::load_native_certs();
    let mut roots = RootCertStore::empty();
    roots.add_parsable_certificates(found.certs);
    if roots.is_empty() {
        let line = "this system has no certificate authorities: name the broker's own";
        return Err(TlsTrustError(line.into()));
    }
    Ok(roots)
}

fn certificates(pem: Pem<'_>) -> Result<Vec<CertificateDer<'static>>, TlsTrustError> {
    let found = CertificateDer::pem_slice_iter(pem.bytes).collect::<Result<Vec<_>, _>>();
    match found {
        Ok(found) if !found.is_empty() => Ok(found),
        Ok(_) => Err(TlsTrustError(format!("{} holds no certificate (BEGIN CERTIFICATE)", pem.name))),
        Err(error) => Err(TlsTrustError(format!("{} is no PEM text: {error}", pem.name))),
    }
}

fn private_key(pem: Pem<'_>) -> Result<PrivateKeyDer<'static>, TlsTrustError> {
    PrivateKeyDer::from_pem_slice(pem.bytes).map_err(|error| match error {
        PemError::NoItemsFound => {
            TlsTrustError(format!("{} holds no private key (BEGIN PRIVATE KEY)", pem.name))
        }
        error => TlsTrustError(format!("{} is no PEM text: {error}", pem.name)),
    })
}

impl PartialEq for TlsTrust {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for TlsTrust {}

impl fmt::Debug for TlsTrust {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Trust")
    }
}

impl fmt::Display for TlsTrustError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for TlsTrustError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_certificate_is_said_with_its_name() {
        for (bytes, why) in [
            (&b"hello"[..], "holds no certificate"),
            (b"-----BEGIN CERTIFICATE-----\n!!\n-----END CERTIFICATE-----\n", "no PEM text"),
            (b"-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n", "nobody can read"),
        ] {
            let error = TlsTrust::new(Some(Pem { name: "ca.pem", bytes }), None).unwrap_err().to_string();
            assert!(error.contains("ca.pem") && error.contains(why) && !error.contains('\n'), "{error}");
        }
        let missing = TlsTrust::read(Some(Path::new("no-such-file.pem")), None).unwrap_err().to_string();
        assert!(missing.contains("no-such-file.pem cannot be read"), "{missing}");
    }
}

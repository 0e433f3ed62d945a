//! The certificate of the web app, in the data folder.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};
use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::client::{verify_server_cert_signed_by_trust_anchor, verify_server_name};
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use tokio_rustls::rustls::server::ParsedCertificate;
use tokio_rustls::rustls::{CertificateError, Error, RootCertStore};

use crate::disk::{self, Readers};
use crate::failure::Failure;
use crate::tls::{self, OWN_NAMES};

/// Name of the folder in the data folder. A certificate that `lightbots certs --out` writes there is used.
const FOLDER: &str = "certs";
/// Validity of a certificate that the program makes by itself, days. Browsers reject a longer one from an authority that
/// people installed (Apple's rule of 2019).
const DAYS: u32 = 825;

/// A certificate that is ready for use.
pub struct WebCertificate {
    pub acceptor: TlsAcceptor,
    /// SHA-256 of the certificate as browsers show it, such as `AB:01:…`.
    pub fingerprint: String,
    /// Path of the certificate's file.
    pub file: PathBuf,
    /// Names of the server that the certificate does not hold: browsers warn people that use one of these names.
    pub missing: Vec<String>,
    /// A line for people if other users of the machine had rights to the private key, or still have them.
    pub key_note: Option<String>,
}

impl WebCertificate {
    /// Reads the certificate in the data folder, for a server of these names. Makes a new one if there is neither
    /// certificate nor key. The failure is one line with a remedy.
    pub fn take(data: &Path, names: &[String]) -> Result<Self, Failure> {
        let folder = data.join(FOLDER);
        let (file, key) = (folder.join("server.pem"), folder.join("server.key"));
        let is_there = |path: &Path| path.symlink_metadata().is_ok();
        match (is_there(&file), is_there(&key)) {
            (false, false) => make(&file, &key, names)?,
            (false, true) => return Err(without_certificate(&file, &key)),
            _ => {}
        }
        let key_note = tls::keep_private(&key);
        let wrong = |why: String| unusable(&folder, &why);
        let mut config = tls::server_config(&file, &key, None).map_err(wrong)?;
        config.alpn_protocols = vec![b"http/1.1".to_vec()];
        let certificate = tls::certificates(&file).map_err(wrong)?.remove(0);
        let parsed = ParsedCertificate::try_from(&certificate).map_err(|error| wrong(error.to_string()))?;
        check_time(&parsed).map_err(|why| wrong(format!("{} {why}", file.display())))?;
        let missing = names.iter().filter(|name| !holds(&parsed, name)).cloned().collect();
        let fingerprint = fingerprint(&certificate);
        Ok(Self { acceptor: tls::acceptor(config), fingerprint, file, missing, key_note })
    }

    /// Returns the command that makes a certificate with the missing names.
    pub fn remedy(&self) -> String {
        let folder = self.file.parent().unwrap_or(Path::new("."));
        format!("lightbots certs --out {} --name {}", folder.display(), self.missing.join(" "))
    }
}

/// Makes a self-signed certificate and its key, and writes their files.
fn make(file: &Path, key: &Path, names: &[String]) -> Result<(), Failure> {
    let all: Vec<String> = OWN_NAMES.iter().map(ToString::to_string).chain(names.iter().cloned()).collect();
    let common = names.first().map_or("LightBots", String::as_str);
    let made = tls::self_signed(&all, common, DAYS);
    let (certificate, secret) = made.map_err(|error| {
        Failure::problem(format!("no certificate of {} can be made: {error}", all.join(", ")))
    })?;
    // The key is written first. If the program is killed in between, the next start finds a key without a certificate,
    // which it refuses with a remedy.
    for (path, text, readers) in [(key, secret, Readers::Owner), (file, certificate, Readers::All)] {
        disk::replace(path, text.as_bytes(), readers).map_err(|error| {
            Failure::problem(format!(
                "{} cannot be written: {error}; name another folder with --data DIR",
                path.display()
            ))
        })?;
    }
    Ok(())
}

/// Checks that a certificate is valid at present. Its authority is not checked, because each client decides whether to trust
/// it. `Err`: what is wrong with the time.
fn check_time(certificate: &ParsedCertificate<'_>) -> Result<(), &'static str> {
    use CertificateError::{Expired, ExpiredContext, NotValidYet, NotValidYetContext};
    let algorithms = ring::default_provider().signature_verification_algorithms.all;
    let (roots, now) = (RootCertStore::empty(), UnixTime::now());
    // The library checks the times before it looks for the issuer, which is unknown here.
    match verify_server_cert_signed_by_trust_anchor(certificate, &roots, &[], now, algorithms) {
        Err(Error::InvalidCertificate(Expired | ExpiredContext { .. })) => Err("has expired"),
        Err(Error::InvalidCertificate(NotValidYet | NotValidYetContext { .. })) => {
            Err("is not valid yet, or the clock of this machine is wrong")
        }
        _ => Ok(()),
    }
}

fn holds(certificate: &ParsedCertificate<'_>, name: &str) -> bool {
    ServerName::try_from(name).is_ok_and(|name| verify_server_name(certificate, &name).is_ok())
}

fn fingerprint(certificate: &CertificateDer<'_>) -> String {
    let digest = Sha256::digest(certificate);
    digest.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(":")
}

/// Returns the failure for a key without its certificate. That key is not replaced, because an authority may have
/// signed it.
fn without_certificate(file: &Path, key: &Path) -> Failure {
    let (file, key) = (file.display(), key.display());
    Failure::input(format!(
        "the web app has no certificate: {key} is there, and {file} is missing; put the certificate of that key there, \
         or move the key away, and the next start makes a new pair"
    ))
}

fn unusable(folder: &Path, why: &str) -> Failure {
    let folder = folder.display();
    Failure::input(format!(
        "the web app has no certificate: {why}; remove server.pem and server.key in {folder}, and the next start makes \
         new ones, or make them with lightbots certs --out {folder} --name HOST"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("lightbots-certificate-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        folder
    }

    fn take(data: &Path, names: &[&str]) -> Result<WebCertificate, Failure> {
        let names: Vec<_> = names.iter().map(ToString::to_string).collect();
        WebCertificate::take(data, &names)
    }

    #[test]
    fn a_certificate_is_made_once_and_says_which_names_it_lacks() {
        let data = folder("once");
        let first = take(&data, &["stage.local", "192.0.2.7"]).unwrap();
        assert_eq!((first.fingerprint.len(), first.missing.len()), (95, 0), "{}", first.fingerprint);
        let second = take(&data, &["stage.local", "192.0.2.8", "other.local"]).unwrap();
        assert_eq!(second.fingerprint, first.fingerprint);
        assert_eq!(second.missing, ["192.0.2.8", "other.local"]);
        assert!(second.remedy().ends_with("certs --name 192.0.2.8 other.local"), "{}", second.remedy());
        std::fs::remove_dir_all(data).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn only_the_owner_may_read_the_key() {
        use std::os::unix::fs::PermissionsExt;
        let data = folder("mode");
        take(&data, &[]).unwrap();
        let mode = std::fs::metadata(data.join("certs/server.key")).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
        std::fs::remove_dir_all(data).unwrap();
    }

    #[test]
    fn a_certificate_that_cannot_be_used_names_its_file_and_the_remedy() {
        let data = folder("unusable");
        take(&data, &[]).unwrap();
        let (file, key) = (data.join("certs/server.pem"), data.join("certs/server.key"));
        let (other, _) = tls::self_signed(&["localhost".into()], "other", 1).unwrap();
        let good = std::fs::read(&file).unwrap();
        let cases = [
            (&file, b"nonsense".to_vec(), "server.pem cannot be used: it holds no certificate"),
            (&file, other.into_bytes(), "do not fit together"),
            (&key, b"nonsense".to_vec(), "server.key cannot be used"),
        ];
        for (path, bytes, expected) in cases {
            std::fs::write(path, bytes).unwrap();
            let failure = take(&data, &[]).err().unwrap();
            assert_eq!(failure.code, 2);
            assert!(
                failure.line.contains(expected) && failure.line.contains("the next start makes"),
                "{failure:?}"
            );
            std::fs::write(&file, &good).unwrap();
        }
        std::fs::remove_file(&key).unwrap();
        assert!(take(&data, &[]).err().unwrap().line.contains("server.key"));
        std::fs::write(&key, b"of an authority").unwrap();
        std::fs::remove_file(&file).unwrap();
        let failure = take(&data, &[]).err().unwrap();
        assert!(
            failure.code == 2 && failure.line.contains("server.pem is missing; put the certificate"),
            "{failure:?}"
        );
        assert_eq!(std::fs::read(&key).unwrap(), b"of an authority", "the key stays as it is");
        assert!(!file.exists());
        std::fs::remove_dir_all(data).unwrap();
    }

    #[test]
    fn a_certificate_of_another_time_is_refused() {
        let of = |from: i64, days: i64| {
            let day = std::time::Duration::from_secs(86_400);
            let at = |days: i64| match u32::try_from(days) {
                Ok(days) => std::time::SystemTime::now() + day * days,
                Err(_) => std::time::SystemTime::now() - day * days.unsigned_abs() as u32,
            };
            let mut params = tls::params(&["localhost".into()], "test", 1).unwrap();
            (params.not_before, params.not_after) = (at(from).into(), at(from + days).into());
            let signed = params.self_signed(&rcgen::KeyPair::generate().unwrap()).unwrap();
            let der = signed.der().clone();
            check_time(&ParsedCertificate::try_from(&der).unwrap())
        };
        assert_eq!(of(-1, 2), Ok(()));
        assert_eq!(of(-3, 2), Err("has expired"));
        assert!(of(1, 2).unwrap_err().contains("not valid yet"));
    }
}

//! Certificates of `lightbots certs`, and some that are wrong.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use rcgen::{BasicConstraints, CertificateParams, DnType, IsCa, Issuer, KeyPair};

use crate::child::run;
use crate::shows;

/// One day.
const DAY: Duration = Duration::from_secs(86_400);

/// A folder with certificates.
pub struct Certificates(PathBuf);

impl Certificates {
    /// Makes the certificates of `lightbots certs` for this machine and a client. Adds two that no broker should have:
    /// `expired`, and `elsewhere` for another name.
    pub fn make() -> Self {
        let folder = PathBuf::from(shows::file("certs", "")).with_extension("d");
        let out = folder.to_str().unwrap();
        let (code, said, err) = run(&["certs", "--out", out, "--name", "stage.example", "--client", "r7"]);
        assert_eq!((code, err.as_str()), (0, ""), "{said}");
        let made = Self(folder);
        let mut ca = CertificateParams::default();
        ca.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        ca.distinguished_name.push(DnType::CommonName, "LightBots authority");
        let key = std::fs::read_to_string(made.file("ca.key")).unwrap();
        let authority = Issuer::new(ca, KeyPair::from_pem(&key).unwrap());
        let now = SystemTime::now();
        made.wrong("expired", "127.0.0.1", now - DAY, &authority);
        made.wrong("elsewhere", "elsewhere.example", now + DAY, &authority);
        made
    }

    /// Path of a file in the folder.
    pub fn file(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }

    fn wrong(&self, stem: &str, host: &str, until: SystemTime, authority: &Issuer<'static, KeyPair>) {
        let mut params = CertificateParams::new([host.to_owned()]).unwrap();
        params.not_before = (SystemTime::now() - 2 * DAY).into();
        params.not_after = until.into();
        let pair = KeyPair::generate().unwrap();
        let signed = params.signed_by(&pair, authority).unwrap();
        std::fs::write(self.file(&format!("{stem}.pem")), signed.pem()).unwrap();
        std::fs::write(self.file(&format!("{stem}.key")), pair.serialize_pem()).unwrap();
    }
}

#[test]
fn certificates_are_made_and_keys_stay_private() {
    let made = Certificates::make();
    for name in ["ca.pem", "server.pem", "client-r7.pem"] {
        assert!(std::fs::read_to_string(made.file(name)).unwrap().contains("BEGIN CERTIFICATE"), "{name}");
    }
    #[cfg(unix)]
    for name in ["ca.key", "server.key", "client-r7.key"] {
        use std::os::unix::fs::PermissionsExt;
        let mode = std::fs::metadata(made.file(name)).unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600, "{name}");
    }
    // A second call in the same folder makes another server certificate, and keeps the authority.
    let ca = std::fs::read(made.file("ca.pem")).unwrap();
    let out = Path::new(&made.file("ca.pem")).parent().unwrap().to_str().unwrap().to_owned();
    let (code, said, _) = run(&["certs", "--out", &out, "--name", "10.0.0.7"]);
    assert_eq!((code, std::fs::read(made.file("ca.pem")).unwrap() == ca), (0, true));
    assert!(said.contains("10.0.0.7") && said.contains("--cert"), "{said}");
}

#[test]
fn an_authority_that_does_not_fit_is_one_line() {
    let (one, other) = (Certificates::make(), Certificates::make());
    std::fs::copy(one.file("ca.pem"), other.file("ca.pem")).unwrap();
    let out = Path::new(&other.file("ca.pem")).parent().unwrap().to_str().unwrap().to_owned();
    for arguments in [
        &["certs", "--out", &out][..],
        &["certs", "--out", &one.file("ca.pem")],
        &["certs", "--out", &out, "--name", "a b\u{e4}"],
        &["certs", "--out", &out, "--client", "../r7"],
    ] {
        let (code, _, err) = run(arguments);
        assert!(code != 0 && err.lines().count() == 1, "{arguments:?}: {code} {err}");
    }
}

//! `certs`: a certificate authority, and certificates that it signs.

use std::path::Path;
use std::sync::Arc;

use rcgen::{
    BasicConstraints, CertificateParams, ExtendedKeyUsagePurpose, IsCa, Issuer, KeyPair, KeyUsagePurpose,
};
use tokio_rustls::rustls::RootCertStore;
use tokio_rustls::rustls::client::WebPkiServerVerifier;
use tokio_rustls::rustls::client::danger::ServerCertVerifier;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, ServerName, UnixTime};

use crate::cli::CertsArguments;
use crate::disk::{self, Readers};
use crate::failure::{Failure, Outcome};
use crate::say;
use crate::tls::{self, OWN_NAMES};

/// Validity of the authority, days: ten years, the longest validity that `--days` allows for certificates. A shorter
/// one would end certificates before their time.
const AUTHORITY_DAYS: u32 = 3650;

/// A certificate authority with its key, which signs certificates.
type Authority = Issuer<'static, KeyPair>;

pub fn run(arguments: &CertsArguments) -> Outcome {
    let out = &arguments.out;
    std::fs::create_dir_all(out).map_err(|error| {
        Failure::problem(format!("{} cannot be made: {error}; choose another --out", out.display()))
    })?;
    let authority = authority(out)?;
    let mut names: Vec<String> = OWN_NAMES.map(str::to_owned).into();
    names.extend(arguments.name.iter().cloned());
    issue(out, "server", &authority, &names, ExtendedKeyUsagePurpose::ServerAuth, arguments.days)?;
    check(out)?;
    for client in &arguments.client {
        let stem = format!("client-{}", file_name(client)?);
        let names = std::slice::from_ref(client);
        issue(out, &stem, &authority, names, ExtendedKeyUsagePurpose::ClientAuth, arguments.days)?;
    }
    let show = |name: &str| out.join(name).display().to_string();
    say::line(&format!("Names in the certificate: {}", names.join(", ")));
    say::line(&format!("Broker: --cert {} --key {}", show("server.pem"), show("server.key")));
    say::line("Web app: `lightbots run` takes server.pem and server.key from the folder certs of its --data");
    say::line(&format!(
        "Robots and controllers: --ca {} with mqtts:// and one of these names",
        show("ca.pem")
    ));
    say::line(&format!("Keep {} secret: with it, anyone can sign certificates for any name", show("ca.key")));
    Ok(true)
}

/// Reads the authority in the folder `out`, or makes a new one and saves it there.
fn authority(out: &Path) -> Result<Authority, Failure> {
    let (certificate, key) = (out.join("ca.pem"), out.join("ca.key"));
    let mut params = params(&[], "LightBots authority", AUTHORITY_DAYS)?;
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    params.key_usages = vec![KeyUsagePurpose::KeyCertSign, KeyUsagePurpose::CrlSign];
    if certificate.exists() || key.exists() {
        let kept = std::fs::read_to_string(&key).map_err(|error| unusable(out, &error.to_string()))?;
        let pair = KeyPair::from_pem(&kept).map_err(|error| unusable(out, &error.to_string()))?;
        return Ok(Issuer::new(params, pair));
    }
    let pair = KeyPair::generate().map_err(failed)?;
    let signed = params.self_signed(&pair).map_err(failed)?;
    save(&key, pair.serialize_pem().as_bytes())?;
    std::fs::write(&certificate, signed.pem()).map_err(|error| cannot_write(&certificate, &error))?;
    Ok(Issuer::new(params, pair))
}

/// Verifies `server.pem` with the authority in the folder, as a client does. Fails if another program made the authority,
/// because the authority's name then differs from the issuer that [`issue`] writes.
fn check(out: &Path) -> Result<(), Failure> {
    let wrong = |error: &dyn std::fmt::Display| unusable(out, &error.to_string());
    let read = |name: &str| CertificateDer::from_pem_file(out.join(name)).map_err(|error| wrong(&error));
    let mut roots = RootCertStore::empty();
    roots.add(read("ca.pem")?).map_err(|error| wrong(&error))?;
    let provider = Arc::new(ring::default_provider());
    let verifier = WebPkiServerVerifier::builder_with_provider(Arc::new(roots), provider).build();
    let name = ServerName::try_from(OWN_NAMES[0]).map_err(|error| wrong(&error))?;
    verifier
        .map_err(|error| wrong(&error))?
        .verify_server_cert(&read("server.pem")?, &[], &name, &[], UnixTime::now())
        .map_err(|error| wrong(&error))?;
    Ok(())
}

/// Makes a key and a certificate for `names`, and writes them to `<stem>.key` and `<stem>.pem`.
fn issue(
    out: &Path,
    stem: &str,
    authority: &Authority,
    names: &[String],
    purpose: ExtendedKeyUsagePurpose,
    days: u32,
) -> Result<(), Failure> {
    let common = names.last().map_or("LightBots", String::as_str);
    let mut params = params(names, common, days)?;
    params.use_authority_key_identifier_extension = true;
    params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    params.extended_key_usages = vec![purpose];
    let pair = KeyPair::generate().map_err(failed)?;
    let signed = params.signed_by(&pair, authority).map_err(failed)?;
    save(&out.join(format!("{stem}.key")), pair.serialize_pem().as_bytes())?;
    let certificate = out.join(format!("{stem}.pem"));
    std::fs::write(&certificate, signed.pem()).map_err(|error| cannot_write(&certificate, &error))
}

fn params(names: &[String], common: &str, days: u32) -> Result<CertificateParams, Failure> {
    tls::params(names, common, days)
        .map_err(|error| Failure::input(format!("a name that certificates cannot hold: {error}")))
}

/// Returns `client` if it can be part of a file name, else an error.
fn file_name(client: &str) -> Result<&str, Failure> {
    let fits = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '-' | '_' | '.');
    if (1..=64).contains(&client.len()) && client.chars().all(fits) && !client.starts_with('.') {
        return Ok(client);
    }
    Err(Failure::input(format!("--client '{client}': say 1 to 64 letters, digits and - _ .")))
}

fn save(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    disk::replace(path, bytes, Readers::Owner).map_err(|error| cannot_write(path, &error))
}

fn cannot_write(path: &Path, error: &std::io::Error) -> Failure {
    Failure::problem(format!("{} cannot be written: {error}; choose another --out", path.display()))
}

fn unusable(out: &Path, why: &str) -> Failure {
    let line = "mend or remove ca.pem and ca.key there, or choose another --out";
    Failure::problem(format!("the authority in {} cannot be used: {why}; {line}", out.display()))
}

fn failed(error: rcgen::Error) -> Failure {
    Failure::problem(format!("the certificate cannot be made: {error}"))
}

//! What our certificates hold.

use std::time::{Duration, SystemTime};

use rcgen::{CertificateParams, DnType, Error, ExtendedKeyUsagePurpose, KeyPair, KeyUsagePurpose};

/// Names of the own machine, in every server certificate.
pub const OWN_NAMES: [&str; 3] = ["localhost", "127.0.0.1", "::1"];
/// A day of certificates, by definition 86,400 s.
const DAY: Duration = Duration::from_secs(86_400);

/// A certificate of these names and addresses that is good for `days` days. `common` is its common name.
pub fn params(names: &[String], common: &str, days: u32) -> Result<CertificateParams, Error> {
    let mut params = CertificateParams::new(names)?;
    params.distinguished_name.remove(DnType::CommonName);
    params.distinguished_name.push(DnType::CommonName, common);
    // Valid since yesterday, because clocks of other machines may be behind.
    params.not_before = (SystemTime::now() - DAY).into();
    params.not_after = (SystemTime::now() + DAY * days).into();
    Ok(params)
}

/// A server certificate that no authority signed, and its key, both PEM.
pub fn self_signed(names: &[String], common: &str, days: u32) -> Result<(String, String), Error> {
    let mut params = params(names, common, days)?;
    params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    let pair = KeyPair::generate()?;
    Ok((params.self_signed(&pair)?.pem(), pair.serialize_pem()))
}

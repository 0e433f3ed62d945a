//! Makes the content of our certificates.

use std::time::{Duration, SystemTime};

use rcgen::{CertificateParams, DnType, Error, ExtendedKeyUsagePurpose, KeyPair, KeyUsagePurpose};

/// Names by which a machine calls itself, for server certificates.
pub const OWN_NAMES: [&str; 3] = ["localhost", "127.0.0.1", "::1"];
/// One day, the unit of a certificate's validity.
const DAY: Duration = Duration::from_secs(86_400);

/// Returns the parameters of a certificate for these names and addresses, valid for `days` days. `common` is its common
/// name.
pub fn params(names: &[String], common: &str, days: u32) -> Result<CertificateParams, Error> {
    let mut params = CertificateParams::new(names)?;
    params.distinguished_name.remove(DnType::CommonName);
    params.distinguished_name.push(DnType::CommonName, common);
    // Valid since yesterday, because clocks of other machines may be behind.
    params.not_before = (SystemTime::now() - DAY).into();
    params.not_after = (SystemTime::now() + DAY * days).into();
    Ok(params)
}

/// Makes a self-signed server certificate. Returns the certificate and its key, both PEM.
pub fn self_signed(names: &[String], common: &str, days: u32) -> Result<(String, String), Error> {
    let mut params = params(names, common, days)?;
    params.key_usages = vec![KeyUsagePurpose::DigitalSignature];
    params.extended_key_usages = vec![ExtendedKeyUsagePurpose::ServerAuth];
    let pair = KeyPair::generate()?;
    Ok((params.self_signed(&pair)?.pem(), pair.serialize_pem()))
}

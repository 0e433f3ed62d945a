//! Settings of the broker that was chosen on the screen, kept in a file that only its owner can read.

use std::path::{Path, PathBuf};

use lightbots_api::BrokerSettings;
use lightbots_link::{BrokerArguments, BrokerUrl, Pem, TlsTrust};
use serde::{Deserialize, Serialize};

use crate::disk::{self, Readers};
use crate::failure::Failure;

/// Address in the settings that means the server's own broker.
pub const EMBEDDED: &str = "embedded";
/// Name of the file in the data folder.
const FILE: &str = "broker.json";
/// Longest text of a certificate or key in the settings, bytes; a chain of certificates fits.
const LONGEST: usize = 32 << 10;
/// Longest file of certificates, bytes; all authorities of a system (0.2 MB) fit.
const PEM_MAX: u64 = 1 << 20;
/// Longest file of settings that is read, bytes: room for seven texts of `LONGEST`, escaped. A longer file counts as
/// missing.
const FILE_MAX: u64 = 14 * LONGEST as u64;

/// Settings of a broker, as they were entered on the screen or on the command line.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// Addresses, or [`EMBEDDED`]. [`Settings::broker`] moves a login in them to `user` and `password`.
    pub address: String,
    /// User name.
    pub user: Option<String>,
    /// Password.
    pub password: Option<String>,
    /// Trusted authority: PEM text, or the path of a file.
    pub ca: Option<String>,
    /// Client certificate: PEM text, or the path of a file.
    pub client_cert: Option<String>,
    /// Key of the client certificate: PEM text, or the path of a file.
    pub client_key: Option<String>,
    /// Whether later starts connect to this broker. `false` after a person disconnected from it: later starts then use the
    /// embedded broker.
    #[serde(default)]
    pub connect: bool,
}

impl Settings {
    /// Returns the settings of the server's own broker.
    pub fn embedded() -> Self {
        Self { address: EMBEDDED.into(), connect: true, ..Self::default() }
    }

    /// Returns the settings of a broker that the command line names.
    pub fn of(broker: &BrokerUrl, login: &BrokerArguments) -> Self {
        let file = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
        Self {
            address: broker.to_string(),
            user: broker.user.clone(),
            password: broker.password.clone(),
            ca: file(&login.ca),
            client_cert: file(&login.client_cert),
            client_key: file(&login.client_key),
            connect: true,
        }
    }

    /// Whether the settings name the server's own broker.
    pub fn is_embedded(&self) -> bool {
        self.address == EMBEDDED
    }

    /// Returns the external broker that the settings describe. A login in the address is moved to the fields `user` and
    /// `password`. The error is one line for people.
    pub fn broker(&mut self) -> Result<BrokerUrl, String> {
        for text in [&self.ca, &self.client_cert, &self.client_key].into_iter().flatten() {
            if text.len() > LONGEST {
                return Err(format!("a certificate here may have {} kB", LONGEST >> 10));
            }
        }
        let broker = BrokerUrl::parse(&self.address).map_err(|error| error.to_string())?;
        if broker.user.is_some() {
            (self.user, self.password) = (broker.user.clone(), broker.password.clone());
        }
        self.address = broker.to_string();
        let trust = self.trust()?;
        Ok(broker.with_login(self.user.clone(), self.password.clone()).with_trust(trust))
    }

    fn trust(&self) -> Result<Option<TlsTrust>, String> {
        let client = match (&self.client_cert, &self.client_key) {
            (None, None) => None,
            (Some(certificate), Some(key)) => {
                Some((Text::read("the client certificate", certificate)?, Text::read("its key", key)?))
            }
            _ => return Err("a client certificate and its key come together: state both, or neither".into()),
        };
        let ca = self.ca.as_ref().map(|ca| Text::read("the authority", ca)).transpose()?;
        if ca.is_none() && client.is_none() {
            return Ok(None);
        }
        let client = client.as_ref().map(|(certificate, key)| (certificate.pem(), key.pem()));
        TlsTrust::new(ca.as_ref().map(Text::pem), client).map(Some).map_err(|error| error.to_string())
    }

    /// Returns what a screen may show of the settings: everything but the password and the key. `embedded` is the address of
    /// the server's own broker; `None` if that broker does not run.
    pub fn shown(&self, embedded: Option<&BrokerUrl>) -> BrokerSettings {
        BrokerSettings {
            address: self.address.clone(),
            user: self.user.clone(),
            has_password: self.password.is_some(),
            ca: self.ca.clone(),
            client_cert: self.client_cert.clone(),
            has_client_key: self.client_key.is_some(),
            embedded: embedded.map(ToString::to_string),
        }
    }

    /// Reads the settings from the data folder; `None` if the file is missing, cannot be read or is invalid.
    pub fn load(folder: &Path) -> Option<Self> {
        let path = folder.join(FILE);
        let bytes = disk::read_regular(&path, FILE_MAX).ok()?;
        serde_json::from_slice(&bytes)
            .inspect_err(|error| tracing::warn!("{} is left aside: {error}", path.display()))
            .ok()
    }

    /// Writes the settings to a file in the data folder that only its owner can read. A failure leaves the old file.
    pub fn save(&self, folder: &Path) -> Result<(), String> {
        let path = folder.join(FILE);
        let text = serde_json::to_vec_pretty(self).map_err(|error| error.to_string())?;
        disk::replace(&path, &text, Readers::Owner)
            .map_err(|error| format!("the broker's settings cannot be kept in {}: {error}", path.display()))
    }
}

/// Returns the external broker that the command line of `run` names. `None` if it names none, or says [`EMBEDDED`].
/// Error if it says both, or if an address is wrong.
pub fn other_broker(addresses: &[String], login: &BrokerArguments) -> Result<Option<BrokerUrl>, Failure> {
    let embedded = addresses.iter().filter(|address| address.trim() == EMBEDDED).count();
    if embedded == addresses.len() {
        return Ok(None);
    }
    if embedded > 0 {
        return Err(Failure::input("--broker: say embedded, or addresses, not both"));
    }
    Ok(Some(login.broker(addresses)?))
}

/// A certificate or a key as PEM, and what error messages call it.
struct Text {
    name: String,
    bytes: Vec<u8>,
}

impl Text {
    fn read(what: &str, stated: &str) -> Result<Self, String> {
        if stated.contains("-----BEGIN") {
            return Ok(Self { name: what.to_owned(), bytes: stated.as_bytes().to_vec() });
        }
        let name = stated.trim().to_owned();
        let bytes = disk::read_regular(Path::new(&name), PEM_MAX)
            .map_err(|error| format!("{what}: {name} cannot be read on the server's machine: {error}"))?;
        Ok(Self { name, bytes })
    }

    fn pem(&self) -> Pem<'_> {
        Pem { name: &self.name, bytes: &self.bytes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lightbots-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn settings_come_back_and_only_the_owner_reads_them() {
        let folder = folder("settings");
        let mut settings = Settings { address: "mqtts://me:secret@a,b".into(), ..Settings::default() };
        let broker = settings.broker().unwrap();
        assert_eq!((broker.user.as_deref(), broker.password.as_deref()), (Some("me"), Some("secret")));
        assert_eq!(settings.address, "mqtts://a:8883,mqtts://b:8883");
        settings.save(&folder).unwrap();
        settings.save(&folder).unwrap();
        assert_eq!(Settings::load(&folder), Some(settings.clone()));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = std::fs::metadata(folder.join(FILE)).unwrap().permissions().mode();
            assert_eq!(mode & 0o777, 0o600);
        }
        let shown = serde_json::to_string(&settings.shown(None)).unwrap();
        assert!(shown.contains("\"has_password\":true") && !shown.contains("secret"), "{shown}");
        std::fs::write(folder.join(FILE), "{").unwrap();
        assert_eq!(Settings::load(&folder), None);
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn embedded_and_no_address_are_the_own_broker() {
        let asked = |texts: &[&str]| {
            let texts: Vec<String> = texts.iter().map(ToString::to_string).collect();
            other_broker(&texts, &BrokerArguments::default())
        };
        assert_eq!((asked(&[]).unwrap(), asked(&["embedded"]).unwrap()), (None, None));
        assert_eq!(asked(&["a"]).unwrap().unwrap().to_string(), "mqtt://a:1883");
        assert_eq!(asked(&["embedded", "a"]).unwrap_err().code, 2);
    }

    #[test]
    fn impossible_settings_are_reported_before_a_client_connects() {
        let with = |ca: Option<&str>, cert: Option<&str>| {
            let (ca, client_cert) = (ca.map(str::to_owned), cert.map(str::to_owned));
            Settings { address: "mqtts://a".into(), ca, client_cert, ..Settings::default() }
                .broker()
                .unwrap_err()
        };
        assert!(with(Some("no-such-file.pem"), None).contains("no-such-file.pem"));
        assert!(with(Some("-----BEGIN NOTHING-----"), None).contains("authority"));
        assert!(with(None, Some("x.pem")).contains("come together"));
        assert!(with(Some(&"x".repeat(LONGEST + 1)), None).contains("kB"));
    }
}

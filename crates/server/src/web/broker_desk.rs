//! The broker settings in use, and how screens change them.

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

use lightbots_api::BrokerSettings;
use lightbots_link::BrokerUrl;

use crate::broker_settings::Settings;
use crate::live::conductor::Handle;

/// The broker settings and the file that keeps them.
#[derive(Debug)]
pub struct BrokerDesk {
    folder: PathBuf,
    settings: Mutex<Settings>,
    /// The embedded broker, if there is one.
    embedded: Option<BrokerUrl>,
}

impl BrokerDesk {
    /// Holds the settings in use. Changed settings are kept in `folder`.
    pub fn new(folder: PathBuf, settings: Settings, embedded: Option<BrokerUrl>) -> Self {
        Self { folder, settings: Mutex::new(settings), embedded }
    }

    /// Returns the settings for a form, without secrets.
    pub fn shown(&self) -> BrokerSettings {
        self.lock().shown(self.embedded.as_ref())
    }

    /// Connects to the broker of other settings, and keeps these settings. `Err`: one line that says what is wrong with
    /// them.
    pub async fn connect(&self, wanted: Settings, handle: &Handle) -> Result<(), String> {
        let wanted = self.completed(wanted);
        let (settings, broker) = if wanted.is_embedded() {
            let embedded = self.embedded.clone();
            (
                Settings::embedded(),
                embedded.ok_or("This server runs no broker of its own: name another one.")?,
            )
        } else {
            let mut wanted = wanted;
            // On a blocking thread, because certificates may be read from files.
            let read = tokio::task::spawn_blocking(move || wanted.broker().map(|broker| (wanted, broker)));
            read.await.map_err(|error| error.to_string())??
        };
        self.keep(settings);
        handle.connect(broker).await;
        Ok(())
    }

    /// Disconnects from the broker. The settings are kept with `connect` false, so that later starts do not connect to that
    /// broker.
    pub async fn disconnect(&self, handle: &Handle) {
        let settings = Settings { connect: false, ..self.lock().clone() };
        self.keep(settings);
        handle.disconnect().await;
    }

    /// Adds the kept secrets that a form leaves out, because forms never get them. The password is added for the same user
    /// and broker, the key for the same certificate.
    fn completed(&self, mut wanted: Settings) -> Settings {
        let kept = self.lock();
        let address = BrokerUrl::parse(&wanted.address).map(|url| url.to_string()).unwrap_or_default();
        if wanted.password.is_none() && wanted.user == kept.user && address == kept.address {
            wanted.password.clone_from(&kept.password);
        }
        if wanted.client_key.is_none()
            && wanted.client_cert.is_some()
            && wanted.client_cert == kept.client_cert
        {
            wanted.client_key.clone_from(&kept.client_key);
        }
        wanted
    }

    fn keep(&self, settings: Settings) {
        if let Err(line) = settings.save(&self.folder) {
            tracing::warn!("{line}");
        }
        *self.lock() = settings;
    }

    fn lock(&self) -> MutexGuard<'_, Settings> {
        // Settings are replaced in one step, so that a panic of another thread leaves no half-written ones.
        self.settings.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

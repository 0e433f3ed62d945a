//! What the command line says about a broker of others.

use std::path::{Path, PathBuf};

use clap::Args;
use lightbots_link::{BrokerUrl, Trust, UrlError};

use crate::failure::Failure;

/// User, where neither address nor option names one.
const USER: &str = "LIGHTBOTS_BROKER_USER";
/// Password, where neither address nor option names one.
const PASSWORD: &str = "LIGHTBOTS_BROKER_PASSWORD";

/// How to get in there, and whom to believe.
#[derive(Clone, Debug, Default, Args)]
pub struct BrokerArguments {
    /// User at the broker, where its URL names none [default: $LIGHTBOTS_BROKER_USER]
    #[arg(long, value_name = "NAME", requires = "broker")]
    pub broker_user: Option<String>,
    /// File whose first line is the password [default: $LIGHTBOTS_BROKER_PASSWORD]
    #[arg(long, value_name = "FILE", requires = "broker")]
    pub broker_password_file: Option<PathBuf>,
    /// Certificate of the authority to trust for mqtts:// instead of the system's, PEM
    #[arg(long, value_name = "FILE", requires = "broker")]
    pub ca: Option<PathBuf>,
    /// Certificate to show a broker that asks for one, PEM
    #[arg(long, value_name = "FILE", requires = "client_key")]
    pub client_cert: Option<PathBuf>,
    /// Key of that certificate, PEM
    #[arg(long, value_name = "FILE", requires = "client_cert")]
    pub client_key: Option<PathBuf>,
}

/// A broker, as `run` takes it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BrokerChoice {
    /// The one of this program.
    Embedded,
    /// Another one.
    Other(BrokerUrl),
}

impl BrokerChoice {
    /// Reads `embedded` or an address.
    pub fn parse(text: &str) -> Result<Self, UrlError> {
        if text.trim() == "embedded" {
            return Ok(Self::Embedded);
        }
        BrokerUrl::parse(text).map(Self::Other)
    }

    /// The broker of others that `choices` name; `None`: the embedded one.
    pub fn other(choices: &[Self], login: &BrokerArguments) -> Result<Option<BrokerUrl>, Failure> {
        let urls: Vec<BrokerUrl> = choices
            .iter()
            .filter_map(|choice| match choice {
                Self::Embedded => None,
                Self::Other(url) => Some(url.clone()),
            })
            .collect();
        if urls.is_empty() {
            return Ok(None);
        }
        if urls.len() < choices.len() {
            return Err(Failure::input("--broker: say embedded, or addresses, not both"));
        }
        login.broker(&urls).map(Some)
    }
}

impl BrokerArguments {
    /// The broker at all of `urls`, with login and trust.
    pub fn broker(&self, urls: &[BrokerUrl]) -> Result<BrokerUrl, Failure> {
        let set = |name| std::env::var(name).ok().filter(|value: &String| !value.is_empty());
        self.broker_given(urls, set(USER), set(PASSWORD))
    }

    /// The same, with what the environment says.
    fn broker_given(
        &self,
        urls: &[BrokerUrl],
        user: Option<String>,
        password: Option<String>,
    ) -> Result<BrokerUrl, Failure> {
        let wrong = |error: UrlError| Failure::input(format!("--broker: {error}"));
        let mut all = urls.iter().cloned();
        let first =
            all.next().ok_or_else(|| Failure::input("--broker is missing: say --broker mqtt://HOST"))?;
        let mut broker = all.try_fold(first, BrokerUrl::and).map_err(wrong)?;
        broker.user = broker.user.or_else(|| self.broker_user.clone()).or(user);
        if broker.password.is_none() {
            let kept = self.broker_password_file.as_deref().map(read_password).transpose()?;
            broker.password = kept.or(password);
        }
        if broker.user.is_none() && self.broker_password_file.is_some() {
            let line = "--broker-password-file: whose password is it? Say --broker-user, or mqtt://USER@HOST";
            return Err(Failure::input(line));
        }
        Ok(broker.with_trust(self.trust()?))
    }

    fn trust(&self) -> Result<Option<Trust>, Failure> {
        let client = self.client_cert.as_deref().zip(self.client_key.as_deref());
        if self.ca.is_none() && client.is_none() {
            return Ok(None);
        }
        Trust::read(self.ca.as_deref(), client).map(Some).map_err(|error| Failure::input(error.to_string()))
    }
}

/// The first line of a file.
fn read_password(path: &Path) -> Result<String, Failure> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        Failure::input(format!("the password in {} cannot be read: {error}", path.display()))
    })?;
    match text.lines().next().filter(|line| !line.is_empty()) {
        Some(line) => Ok(line.to_owned()),
        None => Err(Failure::input(format!("{} holds no password in its first line", path.display()))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn urls(texts: &[&str]) -> Vec<BrokerUrl> {
        texts.iter().map(|text| BrokerUrl::parse(text).unwrap()).collect()
    }

    #[test]
    fn the_address_knows_best_then_options_then_the_environment() {
        let options = BrokerArguments { broker_user: Some("option".into()), ..BrokerArguments::default() };
        let env = || (Some("env".to_owned()), Some("secret".to_owned()));
        let of = |options: &BrokerArguments, texts: &[&str]| {
            let broker = options.broker_given(&urls(texts), env().0, env().1).unwrap();
            (broker.user.unwrap(), broker.password.unwrap())
        };
        assert_eq!(of(&options, &["mqtt://u:p@a"]), ("u".into(), "p".into()));
        assert_eq!(of(&options, &["a", "b"]), ("option".into(), "secret".into()));
        assert_eq!(of(&BrokerArguments::default(), &["a"]), ("env".into(), "secret".into()));
    }

    #[test]
    fn several_options_are_several_addresses() {
        let broker =
            BrokerArguments::default().broker_given(&urls(&["a", "mqtts://b,c"]), None, None).unwrap();
        assert_eq!(broker.to_string(), "mqtt://a:1883,mqtts://b:8883,mqtts://c:8883");
        let mixed = [BrokerChoice::Embedded, BrokerChoice::parse("a").unwrap()];
        assert_eq!(BrokerChoice::other(&mixed, &BrokerArguments::default()).unwrap_err().code, 2);
    }
}

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

/// The embedded broker, as `--broker` of `run` names it.
const EMBEDDED: &str = "embedded";

impl BrokerArguments {
    /// The broker at all of `addresses`, with login and trust. They are read here and not by the command line's
    /// parser, which would repeat a password in its complaint.
    pub fn broker(&self, addresses: &[String]) -> Result<BrokerUrl, Failure> {
        let set = |name| std::env::var(name).ok().filter(|value: &String| !value.is_empty());
        self.broker_given(addresses, set(USER), set(PASSWORD))
    }

    /// The same for `run`; `None`: the embedded broker.
    pub fn broker_or_embedded(&self, addresses: &[String]) -> Result<Option<BrokerUrl>, Failure> {
        let embedded = addresses.iter().filter(|address| address.trim() == EMBEDDED).count();
        if embedded == addresses.len() {
            return Ok(None);
        }
        if embedded > 0 {
            return Err(Failure::input("--broker: say embedded, or addresses, not both"));
        }
        self.broker(addresses).map(Some)
    }

    /// The same with what the environment says.
    fn broker_given(
        &self,
        addresses: &[String],
        user: Option<String>,
        password: Option<String>,
    ) -> Result<BrokerUrl, Failure> {
        let wrong = |error: UrlError| Failure::input(format!("--broker: {error}"));
        let mut all = addresses.iter().map(|address| BrokerUrl::parse(address).map_err(wrong));
        let first =
            all.next().ok_or_else(|| Failure::input("--broker is missing: say --broker mqtt://HOST"))?;
        let mut broker = all.try_fold(first?, |broker, more| broker.and(more?).map_err(wrong))?;
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

    fn urls(texts: &[&str]) -> Vec<String> {
        texts.iter().map(ToString::to_string).collect()
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
        let or_embedded = |texts| BrokerArguments::default().broker_or_embedded(&urls(texts));
        assert_eq!((or_embedded(&[]).unwrap(), or_embedded(&["embedded"]).unwrap()), (None, None));
        assert_eq!(or_embedded(&["embedded", "a"]).unwrap_err().code, 2);
    }
}

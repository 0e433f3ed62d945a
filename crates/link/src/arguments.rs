//! Options of the command line for a broker.

use std::fmt;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::{BrokerUrl, TlsTrust};

/// Name of the environment variable with the user. It counts if neither an address nor the option `--broker-user` has
/// one.
const USER: &str = "LIGHTBOTS_BROKER_USER";
/// Name of the environment variable with the password. It counts if neither an address nor the option
/// `--broker-password-file` has one.
const PASSWORD: &str = "LIGHTBOTS_BROKER_PASSWORD";

/// Login and certificates for a broker.
#[derive(Clone, Debug, Default, Args)]
pub struct BrokerArguments {
    /// User at the broker, if its URL states none [default: $LIGHTBOTS_BROKER_USER]
    #[arg(long, value_name = "NAME", requires = "broker")]
    pub broker_user: Option<String>,
    /// File whose first line is the password [default: $LIGHTBOTS_BROKER_PASSWORD]
    #[arg(long, value_name = "FILE", requires = "broker")]
    pub broker_password_file: Option<PathBuf>,
    /// Certificate of the authority to trust for mqtts://, PEM; replaces the authorities of the system
    #[arg(long, value_name = "FILE", requires = "broker")]
    pub ca: Option<PathBuf>,
    /// Client certificate, for a broker that asks for one, PEM
    #[arg(long, value_name = "FILE", requires = "client_key")]
    pub client_cert: Option<PathBuf>,
    /// Key of the client certificate, PEM
    #[arg(long, value_name = "FILE", requires = "client_cert")]
    pub client_key: Option<PathBuf>,
}

/// Why the options do not describe a usable broker: one line for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArgumentsError(String);

impl fmt::Display for ArgumentsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for ArgumentsError {}

/// The error that `option` is wrong, because of `why`.
fn wrong(option: &str, why: &dyn fmt::Display) -> ArgumentsError {
    ArgumentsError(format!("{option}: {why}"))
}

impl BrokerArguments {
    /// Returns one broker with all of `addresses`, the login and the certificates. Addresses are parsed here. The
    /// parser of the command line does not parse them, because its error messages would show a password in an address.
    pub fn broker(&self, addresses: &[String]) -> Result<BrokerUrl, ArgumentsError> {
        let set = |name| std::env::var(name).ok().filter(|value: &String| !value.is_empty());
        self.broker_given(addresses, set(USER), set(PASSWORD))
    }

    /// Like [`Self::broker`]. `user` and `password` are the values of the environment variables; `None`: not set.
    fn broker_given(
        &self,
        addresses: &[String],
        user: Option<String>,
        password: Option<String>,
    ) -> Result<BrokerUrl, ArgumentsError> {
        let stated = |error| wrong("--broker", &error);
        let mut all = addresses.iter().map(|address| BrokerUrl::parse(address).map_err(stated));
        let first = all
            .next()
            .ok_or_else(|| ArgumentsError("--broker is missing: state --broker mqtt://HOST".into()))?;
        let mut broker = all.try_fold(first?, |broker, more| broker.and(more?).map_err(stated))?;
        broker.user = broker.user.or_else(|| self.broker_user.clone()).or(user);
        if broker.password.is_none() {
            let kept = self.broker_password_file.as_deref().map(read_password).transpose()?;
            broker.password = kept.or(password);
        }
        if broker.user.is_none() && broker.password.is_some() {
            // An address never has a password without a user.
            let source =
                if self.broker_password_file.is_some() { "--broker-password-file" } else { PASSWORD };
            let why = format!("the user is missing: state --broker-user, {USER} or mqtt://USER@HOST");
            return Err(wrong(source, &why));
        }
        Ok(broker.with_trust(self.trust()?))
    }

    fn trust(&self) -> Result<Option<TlsTrust>, ArgumentsError> {
        let client = self.client_cert.as_deref().zip(self.client_key.as_deref());
        if self.ca.is_none() && client.is_none() {
            return Ok(None);
        }
        let read = TlsTrust::read(self.ca.as_deref(), client);
        read.map(Some).map_err(|error| ArgumentsError(error.to_string()))
    }
}

/// Returns the first line of a password file. A missing or empty line is an error.
fn read_password(path: &Path) -> Result<String, ArgumentsError> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        ArgumentsError(format!("the password in {} cannot be read: {error}", path.display()))
    })?;
    match text.lines().next().filter(|line| !line.is_empty()) {
        Some(line) => Ok(line.to_owned()),
        None => Err(ArgumentsError(format!("{} holds no password in its first line", path.display()))),
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
    fn a_password_without_a_user_is_an_error() {
        let given = BrokerArguments::default().broker_given(&urls(&["a"]), None, Some("secret".into()));
        let line = given.unwrap_err().to_string();
        assert!(line.starts_with("LIGHTBOTS_BROKER_PASSWORD: the user is missing"), "{line}");
    }

    #[test]
    fn several_options_are_several_addresses() {
        let broker =
            BrokerArguments::default().broker_given(&urls(&["a", "mqtts://b,c"]), None, None).unwrap();
        assert_eq!(broker.to_string(), "mqtt://a:1883,mqtts://b:8883,mqtts://c:8883");
        let none = BrokerArguments::default().broker_given(&[], None, None);
        assert!(none.unwrap_err().to_string().starts_with("--broker is missing"));
    }
}

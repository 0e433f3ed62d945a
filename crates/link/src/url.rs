//! Addresses and login of a broker.

use std::fmt;

use crate::{BrokerAddress, TlsTrust};

/// The addresses of a broker, which are tried in turn, and the login for all of them. As text:
/// `[mqtt[s]://][user[:password]@]host[:port]`, with more addresses after commas.
#[derive(Clone, PartialEq, Eq)]
pub struct BrokerUrl {
    /// Addresses in the order of attempts; never empty.
    pub addresses: Vec<BrokerAddress>,
    /// User name; `None`: no login.
    pub user: Option<String>,
    /// Password; without a user it is not sent.
    pub password: Option<String>,
    /// Certificates for TLS; `None`: the certificate authorities of the system are trusted.
    pub trust: Option<TlsTrust>,
}

/// Why a text is not an address of a broker: one line for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UrlError(String);

/// User and password in an address.
type Login = (Option<String>, Option<String>);

impl BrokerUrl {
    /// Returns a broker with one address, without TLS and login.
    pub fn new(host: impl Into<String>, port: u16) -> Self {
        let addresses = vec![BrokerAddress { host: host.into(), port, tls: false }];
        Self { addresses, user: None, password: None, trust: None }
    }

    /// Reads addresses separated by commas. The default port is 1883, or 8883 with TLS. A later address without a
    /// scheme uses TLS if the first address does. `tcp://` counts as `mqtt://`, and `ssl://` as `mqtts://`.
    pub fn parse(text: &str) -> Result<Self, UrlError> {
        let mut parts = text.split(',').map(str::trim);
        let mut broker = Self::parse_one(parts.next().unwrap_or_default(), None)?;
        let tls = broker.has_tls();
        for part in parts {
            broker = broker.and(Self::parse_one(part, Some(tls))?)?;
        }
        Ok(broker)
    }

    fn parse_one(text: &str, tls_by_default: Option<bool>) -> Result<Self, UrlError> {
        // Error messages show only the part after `@`, because the part before it may hold a password.
        let shown = text.rsplit_once('@').map_or(text, |(_, address)| address);
        let fail =
            |why: &str| UrlError(format!("'{shown}' is no broker address: {why}; say mqtt://HOST:1883"));
        let (scheme, rest) = match text.split_once("://") {
            Some((scheme, rest)) => (Some(scheme), rest),
            None => (None, text),
        };
        let tls = match scheme.map(str::to_ascii_lowercase).as_deref() {
            None => tls_by_default.unwrap_or(false),
            Some("mqtt" | "tcp") => false,
            Some("mqtts" | "ssl") => true,
            Some(_) => return Err(fail("it starts with neither mqtt:// nor mqtts://")),
        };
        let rest = rest.strip_suffix('/').unwrap_or(rest);
        let (login, address) =
            rest.rsplit_once('@').map_or((None, rest), |(login, address)| (Some(login), address));
        let address = BrokerAddress::parse(address, tls).map_err(fail)?;
        let (user, password) = match login {
            None => (None, None),
            Some(login) => {
                read_login(login).ok_or_else(|| fail("its user or password is not percent-encoded text"))?
            }
        };
        Ok(Self { addresses: vec![address], user, password, trust: None })
    }

    /// Adds the addresses of `more` to this broker. A login that only one of the two has counts for all addresses; two
    /// different logins are an error. The certificates of `self`, or else those of `more`, count for all addresses.
    pub fn and(mut self, more: Self) -> Result<Self, UrlError> {
        if self.user.is_none() {
            (self.user, self.password) = (more.user, more.password);
        } else if more.user.is_some() && (&self.user, &self.password) != (&more.user, &more.password) {
            let why = "state user and password once, they go to every address";
            return Err(UrlError(format!("'{self}' has several logins: {why}")));
        }
        self.addresses.extend(more.addresses);
        self.trust = self.trust.or(more.trust);
        Ok(self)
    }

    /// Returns the broker with this login instead of its own. If `user` is `None`, returns the broker unchanged.
    pub fn with_login(self, user: Option<String>, password: Option<String>) -> Self {
        if user.is_none() {
            return self;
        }
        Self { user, password, ..self }
    }

    /// Returns the broker with these certificates instead of its own. `None`: the certificate authorities of the
    /// system.
    pub fn with_trust(self, trust: Option<TlsTrust>) -> Self {
        Self { trust, ..self }
    }

    /// Returns the broker with its addresses rotated, so that the address with the index `first` is tried first. The
    /// index counts from 0, modulo the number of addresses.
    pub fn starting_at(mut self, first: usize) -> Self {
        let addresses = self.addresses.len().max(1);
        self.addresses.rotate_left(first % addresses);
        self
    }

    /// Whether any address uses TLS.
    pub fn has_tls(&self) -> bool {
        self.addresses.iter().any(|address| address.tls)
    }
}

fn read_login(login: &str) -> Option<Login> {
    let (user, password) = match login.split_once(':') {
        Some((user, password)) => (user, Some(decode(password)?)),
        None => (login, None),
    };
    Some((Some(decode(user)?), password))
}

/// Decodes percent-encoded text; `None` if the encoding is invalid, or the result is not UTF-8.
fn decode(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        if first == b'%' {
            let hex = std::str::from_utf8(after.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(hex, 16).ok()?);
            rest = &after[2..];
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    String::from_utf8(bytes).ok()
}

impl fmt::Display for BrokerUrl {
    /// Writes the addresses, separated by commas, without user and password, for logs and screens.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, address) in self.addresses.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            write!(f, "{comma}{address}")?;
        }
        Ok(())
    }
}

impl fmt::Debug for BrokerUrl {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl fmt::Display for UrlError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for UrlError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_read_as_people_write_them() {
        for (text, shown) in [
            ("localhost", "mqtt://localhost:1883"),
            ("localhost:2883", "mqtt://localhost:2883"),
            ("mqtt://10.0.0.1/", "mqtt://10.0.0.1:1883"),
            ("tcp://a:1", "mqtt://a:1"),
            ("mqtts://a", "mqtts://a:8883"),
            ("mqtt://[::1]:2000", "mqtt://[::1]:2000"),
            ("::1", "mqtt://[::1]:1883"),
            ("mqtt://u:p@a:7", "mqtt://a:7"),
            ("mqtts://u:p@a, b:7,mqtt://c", "mqtts://a:8883,mqtts://b:7,mqtt://c:1883"),
        ] {
            assert_eq!(BrokerUrl::parse(text).unwrap().to_string(), shown, "{text}");
        }
    }

    #[test]
    fn logins_are_decoded_and_never_shown() {
        let broker = BrokerUrl::parse("mqtt://me%40home:p%3Aw%25@host").unwrap();
        assert_eq!(broker.user.as_deref(), Some("me@home"));
        assert_eq!(broker.password.as_deref(), Some("p:w%"));
        assert!(!format!("{broker:?} {broker}").contains("me"));
        assert_eq!(BrokerUrl::parse("mqtt://me@host").unwrap().password, None);
        let wrong = BrokerUrl::parse("mqtt://me:secret@host:x").unwrap_err().to_string();
        assert!(!wrong.contains("secret"), "{wrong}");
    }

    #[test]
    fn one_login_goes_to_every_address() {
        for text in ["a,mqtt://u:p@b", "mqtt://u:p@a,b", "mqtt://u:p@a,mqtt://u:p@b"] {
            assert_eq!(BrokerUrl::parse(text).unwrap().user.as_deref(), Some("u"), "{text}");
        }
        let error = BrokerUrl::parse("mqtt://u:p@a,mqtt://v:q@b").unwrap_err().to_string();
        assert!(error.contains("once") && !error.contains("u:p"), "{error}");
    }

    #[test]
    fn the_first_address_can_be_chosen() {
        let broker = BrokerUrl::parse("a,b,c").unwrap().starting_at(4);
        assert_eq!(broker.to_string(), "mqtt://b:1883,mqtt://c:1883,mqtt://a:1883");
    }

    #[test]
    fn what_is_no_address_is_said_in_one_line() {
        for text in [
            "",
            "http://a",
            "mqtt://",
            "a:0",
            "a:99999",
            "a:x",
            "mqtt://%zz@a",
            "[::1",
            "[::1]x",
            "a b",
            "a,",
            "a,,b",
            "a,http://b",
        ] {
            let error = BrokerUrl::parse(text).unwrap_err().to_string();
            assert!(error.contains("no broker address") && !error.contains('\n'), "{text}: {error}");
        }
    }
}

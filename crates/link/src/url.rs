//! Where a broker is.

use std::fmt;

/// The address of a broker and how to log in: `[mqtt[s]://][user[:password]@]host[:port]`.
#[derive(Clone, PartialEq, Eq)]
pub struct BrokerUrl {
    /// Name or address of its machine; IPv6 without brackets.
    pub host: String,
    /// Its TCP port.
    pub port: u16,
    /// Whether to speak TLS.
    pub tls: bool,
    /// User name; `None`: log in without.
    pub user: Option<String>,
    /// Password; only with a user.
    pub password: Option<String>,
}

/// Why a text is no broker's address: one line for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UrlError(String);

impl BrokerUrl {
    /// A plain broker without login.
    pub fn new(host: impl Into<String>, port: u16) -> Self {
        Self { host: host.into(), port, tls: false, user: None, password: None }
    }

    /// Reads an address. The port is 1883, with TLS 8883, unless stated. `tcp://` and `ssl://` are understood too.
    pub fn parse(text: &str) -> Result<Self, UrlError> {
        let fail =
            |why: &str| UrlError(format!("'{text}' is no broker address: {why}; say mqtt://HOST:1883"));
        let text = text.trim();
        let (scheme, rest) = text.split_once("://").unwrap_or(("mqtt", text));
        let tls = match scheme.to_ascii_lowercase().as_str() {
            "mqtt" | "tcp" => false,
            "mqtts" | "ssl" => true,
            _ => return Err(fail("it starts with neither mqtt:// nor mqtts://")),
        };
        let rest = rest.strip_suffix('/').unwrap_or(rest);
        let (login, place) =
            rest.rsplit_once('@').map_or((None, rest), |(login, place)| (Some(login), place));
        let (host, port) = split_port(place).ok_or_else(|| fail("its port is no number from 1 to 65535"))?;
        if host.is_empty() || host.contains(['/', ' ', '?', '#']) {
            return Err(fail("it names no host"));
        }
        let (user, password) = match login {
            None => (None, None),
            Some(login) => {
                read_login(login).ok_or_else(|| fail("its user or password is not percent-encoded text"))?
            }
        };
        let port = port.unwrap_or(if tls { 8883 } else { 1883 });
        Ok(Self { host: host.to_owned(), port, tls, user, password })
    }

    /// The same broker with this login, where one is given.
    pub fn with_login(self, user: Option<String>, password: Option<String>) -> Self {
        if user.is_none() {
            return self;
        }
        Self { user, password, ..self }
    }
}

/// `host`, `host:port`, `[v6]`, `[v6]:port` or a bare IPv6 address; `None` where the port is no port.
fn split_port(place: &str) -> Option<(&str, Option<u16>)> {
    if let Some(rest) = place.strip_prefix('[') {
        let (host, after) = rest.split_once(']')?;
        return match after.strip_prefix(':') {
            Some(port) => Some((host, Some(read_port(port)?))),
            None => after.is_empty().then_some((host, None)),
        };
    }
    match place.split_once(':') {
        Some((host, port)) if !port.contains(':') => Some((host, Some(read_port(port)?))),
        _ => Some((place, None)),
    }
}

fn read_port(text: &str) -> Option<u16> {
    text.parse().ok().filter(|port| *port != 0)
}

fn read_login(login: &str) -> Option<(Option<String>, Option<String>)> {
    let (user, password) = match login.split_once(':') {
        Some((user, password)) => (user, Some(decode(password)?)),
        None => (login, None),
    };
    Some((Some(decode(user)?), password))
}

/// Percent-decodes; `None` where that is impossible.
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
    /// The address without its login, fit for logs and screens.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = if self.tls { "mqtts" } else { "mqtt" };
        let host = &self.host;
        if host.contains(':') {
            write!(f, "{scheme}://[{host}]:{}", self.port)
        } else {
            write!(f, "{scheme}://{host}:{}", self.port)
        }
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
    }

    #[test]
    fn what_is_no_address_is_said_in_one_line() {
        for text in
            ["", "http://a", "mqtt://", "a:0", "a:99999", "a:x", "mqtt://%zz@a", "[::1", "[::1]x", "a b"]
        {
            let error = BrokerUrl::parse(text).unwrap_err().to_string();
            assert!(error.contains("no broker address") && !error.contains('\n'), "{text}: {error}");
        }
    }
}

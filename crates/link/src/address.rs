//! One address of a broker.

use std::fmt;

/// An address of a broker: `[mqtt[s]://]host[:port]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BrokerAddress {
    /// Name or IP address of the machine; IPv6 without brackets.
    pub host: String,
    /// TCP port.
    pub port: u16,
    /// Whether to use TLS.
    pub tls: bool,
}

impl BrokerAddress {
    /// Reads `host`, `host:port`, `[v6]`, `[v6]:port` or a bare IPv6 address. Without a port, it is 8883 if `tls` is
    /// set, otherwise 1883. An error is a text for people with the reason.
    pub(crate) fn parse(text: &str, tls: bool) -> Result<Self, &'static str> {
        let (host, port) = split_port(text).ok_or("its port is no number from 1 to 65535")?;
        if host.is_empty() || host.contains(['/', ' ', '?', '#', '@']) {
            return Err("it names no host");
        }
        Ok(Self { host: host.to_owned(), port: port.unwrap_or(if tls { 8883 } else { 1883 }), tls })
    }
}

/// Splits an address into its host and, if it has one, its port. `None` if the port or the brackets are invalid.
fn split_port(address: &str) -> Option<(&str, Option<u16>)> {
    if let Some(rest) = address.strip_prefix('[') {
        let (host, after) = rest.split_once(']')?;
        return match after.strip_prefix(':') {
            Some(port) => Some((host, Some(read_port(port)?))),
            None => after.is_empty().then_some((host, None)),
        };
    }
    match address.split_once(':') {
        Some((host, port)) if !port.contains(':') => Some((host, Some(read_port(port)?))),
        _ => Some((address, None)),
    }
}

fn read_port(text: &str) -> Option<u16> {
    text.parse().ok().filter(|port| *port != 0)
}

impl fmt::Display for BrokerAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = if self.tls { "mqtts" } else { "mqtt" };
        let (host, port) = (&self.host, self.port);
        if host.contains(':') {
            write!(f, "{scheme}://[{host}]:{port}")
        } else {
            write!(f, "{scheme}://{host}:{port}")
        }
    }
}

//! Names under which the web app is served, and whether the network may reach it.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use crate::failure::Failure;

/// Port of a URL or `Host` header without a port: that of HTTP, RFC 9110, section 4.2.1.
const USUAL_PORT: u16 = 80;

/// Where the web app is served: on this machine only, or on the network because the user asked for it.
#[derive(Clone, Debug)]
pub struct Exposure {
    listen: SocketAddr,
    host_names: Vec<String>,
}

/// A host and a port in canonical spelling.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Authority {
    host: Host,
    port: u16,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Host {
    Address(IpAddr),
    /// A DNS name in lower case.
    Name(String),
}

/// Names under which requests are answered.
#[derive(Clone, Debug)]
pub struct Names {
    port: u16,
    is_open: bool,
    others: Vec<Authority>,
}

impl Exposure {
    /// Serves on `listen`. Without `open_to_network` it must be a loopback address. `host_names` are further names of this
    /// machine: DNS names or IP addresses, with a port if it differs from that of `listen`. The failure is one line, exit
    /// code 2.
    pub fn new(listen: SocketAddr, open_to_network: bool, host_names: Vec<String>) -> Result<Self, Failure> {
        if !listen.ip().to_canonical().is_loopback() && !open_to_network {
            return Err(Failure::input(format!(
                "on {listen} anyone on the network can reach the sign-in, and read passwords on the way: leave \
                 --listen out, or add --open-to-network if that is what you want"
            )));
        }
        let exposure = Self { listen, host_names };
        exposure.names(listen.port())?;
        Ok(exposure)
    }

    /// Address that the server listens on; port 0: any.
    pub fn listen(&self) -> SocketAddr {
        self.listen
    }

    /// The names, once `port` is known. The failure is one line, exit code 2.
    pub fn names(&self, port: u16) -> Result<Names, Failure> {
        let others = self.host_names.iter().map(|text| {
            Authority::read(text, port).ok_or_else(|| {
                let line = "a name such as stage.local or an address, with :PORT where it is another";
                Failure::input(format!("--host-name {text}: this is no {line}"))
            })
        });
        let is_open = !self.listen.ip().to_canonical().is_loopback();
        Ok(Names { port, is_open, others: others.collect::<Result<_, _>>()? })
    }
}

impl Names {
    /// Whether the network can reach the web app.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Whether a request to `host` is for this server; `local` is the server's end of the connection. A DNS name counts
    /// only if the user gave it, because anyone can point other names at this address (DNS rebinding).
    pub fn hold(&self, authority: &Authority, local: IpAddr) -> bool {
        let is_own = match &authority.host {
            Host::Address(ip) => ip.is_loopback() || self.is_open && *ip == local.to_canonical(),
            Host::Name(name) => name == "localhost",
        };
        is_own && authority.port == self.port || self.others.contains(authority)
    }
}

impl Authority {
    /// Reads the value of a `Host` header.
    pub fn of_host(text: &str) -> Option<Self> {
        Self::read(text, USUAL_PORT)
    }

    /// Reads the value of an `Origin` header. `None` also for pages that HTTP did not serve.
    pub fn of_origin(text: &str) -> Option<Self> {
        let (scheme, rest) = text.split_once("://")?;
        scheme.eq_ignore_ascii_case("http").then(|| Self::read(rest, USUAL_PORT))?
    }

    /// Reads `HOST` or `HOST:PORT`. An IPv6 address is in brackets.
    fn read(text: &str, usual_port: u16) -> Option<Self> {
        let (host, port) = match text.strip_prefix('[') {
            Some(rest) => {
                let (address, port) = rest.split_once(']')?;
                (Host::Address(IpAddr::V6(address.parse::<Ipv6Addr>().ok()?).to_canonical()), port)
            }
            None => {
                let (name, port) = text.split_at(text.find(':').unwrap_or(text.len()));
                (Host::of(name)?, port)
            }
        };
        let port = match port.strip_prefix(':') {
            None if port.is_empty() => usual_port,
            Some(digits) if digits.bytes().all(|byte| byte.is_ascii_digit()) => digits.parse().ok()?,
            _ => return None,
        };
        Some(Self { host, port })
    }
}

impl Host {
    fn of(text: &str) -> Option<Self> {
        let may_hold = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'.' | b'_');
        if text.is_empty() || !text.bytes().all(may_hold) {
            return None;
        }
        let address = text.parse::<Ipv4Addr>().map(|ip| Self::Address(ip.into()));
        Some(address.unwrap_or_else(|_| Self::Name(text.to_ascii_lowercase())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exposure(listen: &str, open_to_network: bool, host_names: &[&str]) -> Result<Exposure, Failure> {
        let host_names = host_names.iter().map(ToString::to_string).collect();
        Exposure::new(listen.parse().unwrap(), open_to_network, host_names)
    }

    fn names(listen: &str, open_to_network: bool, host_names: &[&str]) -> Names {
        let exposure = exposure(listen, open_to_network, host_names).unwrap();
        exposure.names(exposure.listen().port()).unwrap()
    }

    #[test]
    fn the_network_is_served_only_where_that_was_asked_for() {
        for listen in
            ["0.0.0.0:8420", "192.168.0.7:8420", "[::]:8420", "[fd00::7]:8420", "[::ffff:10.0.0.1]:1"]
        {
            let refused = exposure(listen, false, &[]).unwrap_err();
            assert_eq!(refused.code, 2);
            assert!(
                refused.line.contains(listen) && refused.line.contains("--open-to-network"),
                "{refused:?}"
            );
            assert!(names(listen, true, &[]).is_open());
        }
        for listen in ["127.0.0.1:8420", "127.3.2.1:0", "[::1]:8420", "[::ffff:127.0.0.1]:8420"] {
            assert!(!names(listen, false, &[]).is_open());
            assert!(!names(listen, true, &[]).is_open());
        }
    }

    #[test]
    fn requests_are_answered_under_exact_names() {
        let closed = names("127.0.0.1:8420", false, &["Stage.local", "tunnel.example:9000"]);
        let open = names("0.0.0.0:8420", true, &["stage.local"]);
        let own: IpAddr = "192.168.0.7".parse().unwrap();
        // Host header, accepted on loopback, accepted on the network.
        let cases = [
            ("127.0.0.1:8420", true, true),
            ("127.0.0.2:8420", true, true),
            ("localhost:8420", true, true),
            ("LocalHost:8420", true, true),
            ("[::1]:8420", true, true),
            ("[0:0::1]:8420", true, true),
            ("[::ffff:127.0.0.1]:8420", true, true),
            ("192.168.0.7:8420", false, true),
            ("[::ffff:192.168.0.7]:8420", false, true),
            ("192.168.0.8:8420", false, false),
            ("stage.local:8420", true, true),
            ("STAGE.local:8420", true, true),
            ("tunnel.example:9000", true, false),
            ("tunnel.example:8420", false, false),
            // Another port means another server.
            ("127.0.0.1", false, false),
            ("localhost:80", false, false),
            ("localhost:8421", false, false),
            ("stage.local", false, false),
            // Names that a stranger may point at this address.
            ("evil.example:8420", false, false),
            ("localhost.:8420", false, false),
            ("a.localhost:8420", false, false),
            ("localhost.evil.example:8420", false, false),
            ("0.0.0.0:8420", false, false),
            ("127.1:8420", false, false),
            ("2130706433:8420", false, false),
        ];
        for (host, on_loopback, on_network) in cases {
            let read = Authority::of_host(host).unwrap_or_else(|| panic!("{host}"));
            assert_eq!(closed.hold(&read, own), on_loopback, "{host} on loopback");
            assert_eq!(open.hold(&read, own), on_network, "{host} on the network");
        }
        let usual = names("127.0.0.1:80", false, &[]);
        assert!(usual.hold(&Authority::of_host("localhost").unwrap(), own));
    }

    #[test]
    fn what_is_no_name_is_none() {
        for host in [
            "",
            ":8420",
            "127.0.0.1:",
            "127.0.0.1:+8420",
            "a:b:1",
            "::1",
            "[::1",
            "[]:1",
            "[::1]8420",
            "a b",
            "a@b:1",
            "a:99999",
            "http://a",
            "[127.0.0.1]:1",
        ] {
            assert_eq!(Authority::of_host(host), None, "{host}");
        }
        assert_eq!(exposure("127.0.0.1:1", false, &["a b"]).unwrap_err().code, 2);
        for origin in ["null", "", "127.0.0.1:8420", "https://127.0.0.1:8420", "file://", "http://a:1/"] {
            assert_eq!(Authority::of_origin(origin), None, "{origin}");
        }
        assert_eq!(Authority::of_origin("http://A:81"), Authority::of_host("a:81"));
    }
}

//! Names under which the web app is served, and whether the network may reach it.

use std::fmt;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use super::address::reachable;
use super::scheme::Scheme;
use crate::failure::Failure;

/// Where and how the web app is served: on this machine only, or on the network.
#[derive(Clone, Debug)]
pub struct Exposure {
    listen: SocketAddr,
    plain_http: bool,
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
    scheme: Scheme,
    others: Vec<Authority>,
}

impl Exposure {
    /// Settings for a server on `listen`. A loopback address is served without TLS, any other address with TLS unless
    /// `plain_http` is set. `host_names` are further names of this machine: DNS names or IP addresses, with a port if
    /// it differs from that of `listen`. The failure is one line, exit code 2.
    pub fn new(listen: SocketAddr, plain_http: bool, host_names: Vec<String>) -> Result<Self, Failure> {
        let exposure = Self { listen, plain_http, host_names };
        exposure.names(listen.port())?;
        Ok(exposure)
    }

    /// Address that the server listens on. With port 0 the system chooses the port.
    pub fn listen(&self) -> SocketAddr {
        self.listen
    }

    /// Whether the network can reach the web app.
    pub fn is_open(&self) -> bool {
        !self.listen.ip().to_canonical().is_loopback()
    }

    /// How the web app is served.
    pub fn scheme(&self) -> Scheme {
        if self.is_open() && !self.plain_http { Scheme::Https } else { Scheme::Http }
    }

    /// Returns the names under which other machines reach the web app, for a certificate: those that the user gave, and this
    /// machine's address.
    pub fn hosts(&self) -> Vec<String> {
        let given = self.host_names.iter().filter_map(|text| Authority::read(text, 0));
        let mut hosts: Vec<String> = given.map(|authority| authority.host.to_string()).collect();
        hosts.push(reachable(self.listen.ip()).to_string());
        hosts
    }

    /// Returns the names under which requests are answered. `port` is the port that the server listens on. The failure is
    /// one line, exit code 2.
    pub fn names(&self, port: u16) -> Result<Names, Failure> {
        let others = self.host_names.iter().map(|text| {
            Authority::read(text, port).ok_or_else(|| {
                let line = "a name such as stage.local or an address, with :PORT where it is another";
                Failure::input(format!("--host-name {text}: this is no {line}"))
            })
        });
        let others = others.collect::<Result<_, _>>()?;
        Ok(Names { port, is_open: self.is_open(), scheme: self.scheme(), others })
    }
}

impl Names {
    /// Whether the network can reach the web app.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// How the web app is served.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Reads the value of a `Host` header of a request over `scheme`. `None` if it is no host.
    pub fn host(scheme: Scheme, text: &str) -> Option<Authority> {
        Authority::read(text, scheme.usual_port())
    }

    /// Reads the value of an `Origin` header. `None` if it is no origin, or if its scheme is not that of this server.
    pub fn origin(&self, text: &str) -> Option<Authority> {
        let (scheme, rest) = text.split_once("://")?;
        let is_ours = scheme.eq_ignore_ascii_case(self.scheme.name());
        is_ours.then(|| Authority::read(rest, self.scheme.usual_port()))?
    }

    /// Whether a request to `authority` is for this server. `local` is the address of the server's end of the connection. A
    /// DNS name other than localhost counts only if the user gave it. The reason is DNS rebinding: anyone can let other
    /// names point to this address.
    pub fn hold(&self, authority: &Authority, local: IpAddr) -> bool {
        let is_own = match &authority.host {
            Host::Address(ip) => ip.is_loopback() || self.is_open && *ip == local.to_canonical(),
            Host::Name(name) => name == "localhost",
        };
        is_own && authority.port == self.port || self.others.contains(authority)
    }
}

impl Authority {
    /// Reads `HOST` or `HOST:PORT`. Without a port in the text, the port is `usual_port`. An IPv6 address is in brackets.
    /// `None` for other text.
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

impl fmt::Display for Host {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Address(ip) => ip.fmt(out),
            Self::Name(name) => name.fmt(out),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exposure(listen: &str, plain_http: bool, host_names: &[&str]) -> Result<Exposure, Failure> {
        let host_names = host_names.iter().map(ToString::to_string).collect();
        Exposure::new(listen.parse().unwrap(), plain_http, host_names)
    }

    fn names(listen: &str, plain_http: bool, host_names: &[&str]) -> Names {
        let exposure = exposure(listen, plain_http, host_names).unwrap();
        exposure.names(exposure.listen().port()).unwrap()
    }

    fn host(text: &str) -> Option<Authority> {
        Names::host(Scheme::Http, text)
    }

    #[test]
    fn the_network_is_served_with_tls_unless_that_is_turned_off() {
        for listen in
            ["0.0.0.0:8420", "192.168.0.7:8420", "[::]:8420", "[fd00::7]:8420", "[::ffff:10.0.0.1]:1"]
        {
            assert_eq!(
                (names(listen, false, &[]).is_open(), names(listen, true, &[]).is_open()),
                (true, true)
            );
            assert_eq!(names(listen, false, &[]).scheme(), Scheme::Https);
            assert_eq!(names(listen, true, &[]).scheme(), Scheme::Http);
        }
        for listen in ["127.0.0.1:8420", "127.3.2.1:0", "[::1]:8420", "[::ffff:127.0.0.1]:8420"] {
            for plain_http in [false, true] {
                let names = names(listen, plain_http, &[]);
                assert_eq!((names.is_open(), names.scheme()), (false, Scheme::Http));
            }
        }
    }

    #[test]
    fn a_certificate_is_for_given_names_and_a_reachable_address() {
        let given = ["Stage.local", "tunnel.example:9000", "[fd00::7]:1"];
        let hosts = exposure("192.0.2.7:8420", false, &given).unwrap().hosts();
        assert_eq!(hosts, ["stage.local", "tunnel.example", "fd00::7", "192.0.2.7"]);
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
            // Names that anyone may point at this address.
            ("evil.example:8420", false, false),
            ("localhost.:8420", false, false),
            ("a.localhost:8420", false, false),
            ("localhost.evil.example:8420", false, false),
            ("0.0.0.0:8420", false, false),
            ("127.1:8420", false, false),
            ("2130706433:8420", false, false),
        ];
        for (host, on_loopback, on_network) in cases {
            let read = self::host(host).unwrap_or_else(|| panic!("{host}"));
            assert_eq!(closed.hold(&read, own), on_loopback, "{host} on loopback");
            assert_eq!(open.hold(&read, own), on_network, "{host} on the network");
        }
        let usual = names("127.0.0.1:80", false, &[]);
        assert!(usual.hold(&host("localhost").unwrap(), own));
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
            assert_eq!(self::host(host), None, "{host}");
        }
        assert_eq!(exposure("127.0.0.1:1", false, &["a b"]).unwrap_err().code, 2);
        let (plain, secure) = (names("127.0.0.1:1", false, &[]), names("0.0.0.0:1", false, &[]));
        for origin in ["null", "", "127.0.0.1:8420", "file://", "http://a:1/", "https://a:1/"] {
            assert_eq!((plain.origin(origin), secure.origin(origin)), (None, None), "{origin}");
        }
        assert_eq!((plain.origin("http://A:81"), secure.origin("http://A:81")), (host("a:81"), None));
        assert_eq!((plain.origin("https://A:81"), secure.origin("https://A:81")), (None, host("a:81")));
        assert_eq!((plain.origin("http://a"), secure.origin("https://a")), (host("a:80"), host("a:443")));
    }
}

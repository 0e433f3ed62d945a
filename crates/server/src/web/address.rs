//! The address at which people open the web app.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};

use super::scheme::Scheme;

/// An address outside this network (RFC 5737). The path from this machine to that address begins at this machine's own
/// address, which is found in this way. Nothing is sent.
const ELSEWHERE: (Ipv4Addr, u16) = (Ipv4Addr::new(192, 0, 2, 1), 9);

/// Returns the URL of the web app for other machines. Its host is the name that the user gave, or this machine's own
/// address.
pub fn url(scheme: Scheme, listen: SocketAddr, host_name: Option<&str>) -> String {
    let port = listen.port();
    let authority = match host_name {
        // A name may have a port of its own.
        Some(name) if name.rsplit_once(':').is_some_and(|(_, port)| port.parse::<u16>().is_ok()) => {
            name.to_owned()
        }
        Some(name) => format!("{name}:{port}"),
        None => SocketAddr::new(reachable(listen.ip()), port).to_string(),
    };
    format!("{}://{authority}", scheme.name())
}

/// Returns an address at which other machines reach this one. If the server listens on all addresses, this is its address on
/// the path to other networks, or loopback without a network.
pub fn reachable(listen: IpAddr) -> IpAddr {
    if !listen.is_unspecified() {
        return listen;
    }
    let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0));
    let local = socket.and_then(|socket| socket.connect(ELSEWHERE).and_then(|()| socket.local_addr()));
    let loopback: IpAddr =
        if listen.is_ipv6() { Ipv6Addr::LOCALHOST.into() } else { Ipv4Addr::LOCALHOST.into() };
    local.map_or(loopback, |local| local.ip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_address_is_one_that_others_reach() {
        let of = |listen: &str, name| url(Scheme::Https, listen.parse().unwrap(), name);
        assert_eq!(of("192.0.2.7:8420", None), "https://192.0.2.7:8420");
        assert_eq!(of("0.0.0.0:8420", Some("stage.local")), "https://stage.local:8420");
        assert_eq!(of("0.0.0.0:8420", Some("stage.local:80")), "https://stage.local:80");
        assert!(!of("0.0.0.0:8420", None).contains("0.0.0.0"));
    }
}

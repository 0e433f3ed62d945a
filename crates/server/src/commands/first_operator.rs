//! The one-time address with which the first operator chooses name and password.

use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, UdpSocket};

use qrcode::QrCode;
use qrcode::render::unicode::Dense1x2;

use crate::say;

/// An address of another network (RFC 5737). Nothing is sent there.
const ELSEWHERE: (Ipv4Addr, u16) = (Ipv4Addr::new(192, 0, 2, 1), 9);

/// Prints the address, and as a QR code for a phone. The token is behind `#`, so that browsers do not send it with the
/// request of the page and no log holds it.
pub fn invite(listen: SocketAddr, host_name: Option<&String>, token: &str) {
    let url = url(listen, host_name.map(String::as_str), token);
    say::line(&format!("There are no accounts yet. Make the first operator at {url}"));
    if let Ok(code) = QrCode::new(&url) {
        say::line(&code.render::<Dense1x2>().build());
    }
}

fn url(listen: SocketAddr, host_name: Option<&str>, token: &str) -> String {
    let port = listen.port();
    let authority = match host_name {
        // A name may bring its own port.
        Some(name) if name.rsplit_once(':').is_some_and(|(_, port)| port.parse::<u16>().is_ok()) => {
            name.to_owned()
        }
        Some(name) => format!("{name}:{port}"),
        None => SocketAddr::new(reachable(listen.ip()), port).to_string(),
    };
    format!("http://{authority}/#first={token}")
}

/// An address at which other machines reach this one: on all addresses, the one that leads to other networks.
fn reachable(listen: IpAddr) -> IpAddr {
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
        let of = |listen: &str, name| url(listen.parse().unwrap(), name, "t");
        assert_eq!(of("192.0.2.7:8420", None), "http://192.0.2.7:8420/#first=t");
        assert_eq!(of("0.0.0.0:8420", Some("stage.local")), "http://stage.local:8420/#first=t");
        assert_eq!(of("0.0.0.0:8420", Some("stage.local:80")), "http://stage.local:80/#first=t");
        assert!(!of("0.0.0.0:8420", None).contains("0.0.0.0"));
    }
}

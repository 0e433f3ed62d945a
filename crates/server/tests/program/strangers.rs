//! Requests from pages of other origins and for other host names are refused.

use crate::alone;
use crate::http;
use crate::run::start;
use crate::screen::Screen;
use crate::sign_in::start as start_on_network;
use crate::site::Site;

/// Header lines that request a WebSocket.
const UPGRADE: [&str; 3] =
    ["Upgrade: websocket", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="];

/// The status of a request with these header lines and `Connection: close`. An opened WebSocket is closed at once.
fn status(site: impl Into<Site>, path: &str, lines: &[String]) -> u16 {
    let lines: String = lines.iter().map(|line| format!("{line}\r\n")).collect();
    let answer = http::send(site, &format!("GET {path} HTTP/1.1\r\nConnection: close\r\n{lines}\r\n"));
    if answer.status != 200 {
        let error = answer.json()["error"].as_str().unwrap().to_owned();
        assert!(!error.is_empty() && !error.contains('\n'), "{error}");
    }
    answer.status
}

#[test]
fn pages_of_other_servers_and_foreign_names_are_turned_away() {
    let _turn = alone();
    let (_server, address, _) = start(&["--robots", "0", "--host-name", "stage.local"]);
    let (host, port) = address.rsplit_once(':').unwrap();
    assert_eq!(host, "127.0.0.1");
    let named = |name: &str| format!("Host: {name}:{port}");
    let of = |name: &str| format!("Origin: http://{name}:{port}");
    let cases = [
        (vec![named("127.0.0.1")], 200),
        (vec![named("LocalHost")], 200),
        (vec![named("[::1]")], 200),
        (vec![named("stage.local")], 200),
        (vec![named("127.0.0.1"), of("127.0.0.1")], 200),
        (vec![named("stage.local"), of("STAGE.local")], 200),
        // No host name, two of them, and an empty one.
        (vec![], 400),
        (vec![named("127.0.0.1"), named("127.0.0.1")], 400),
        (vec![named("127.0.0.1"), named("evil.example")], 400),
        (vec!["Host: ".into()], 400),
        // Host names that DNS may point to this machine, and ports of other servers.
        (vec![named("evil.example")], 421),
        (vec![named("evil.example"), of("evil.example")], 421),
        (vec![named("localhost.")], 421),
        (vec!["Host: 127.0.0.1".into()], 421),
        (vec!["Host: 127.0.0.1:1".into()], 421),
        // Pages of other servers, also on this machine.
        (vec![named("127.0.0.1"), of("localhost")], 403),
        (vec![named("127.0.0.1"), "Origin: http://127.0.0.1:5173".into()], 403),
        (vec![named("127.0.0.1"), format!("Origin: https://127.0.0.1:{port}")], 403),
        (vec![named("127.0.0.1"), "Origin: null".into()], 403),
        (vec![named("127.0.0.1"), of("127.0.0.1"), of("127.0.0.1")], 403),
    ];
    for path in ["/", "/api/shows", "/api/plan"] {
        for (lines, expected) in &cases {
            assert_eq!(status(&address, path, lines), *expected, "{path} {lines:?}");
        }
    }
    for (lines, expected) in cases.iter().filter(|(_, expected)| *expected != 200) {
        let lines = [lines.clone(), UPGRADE.map(str::to_owned).to_vec()].concat();
        assert_eq!(status(&address, "/ws", &lines), *expected, "{lines:?}");
    }
    assert!(Screen::try_open(&address, "evil.example").is_err());
    assert!(Screen::try_open(&address, &format!("localhost:{port}")).is_err());
    let mut screen = Screen::open(&address);
    screen.until("the greeting", |screen| (screen.get("hello")["plain_http"] == false).then_some(()));
}

#[test]
fn names_of_others_are_turned_away_on_the_network_too() {
    let _turn = alone();
    let (_server, _, site) = start_on_network(&[]);
    let (_, port) = site.address.rsplit_once(':').unwrap();
    let (host, origin) = (format!("Host: {}", site.address), format!("Origin: https://{}", site.address));
    let other = format!("Origin: http://{}", site.address);
    let upgrade = UPGRADE.map(str::to_owned);
    for (lines, expected) in [
        (vec![host.clone()], 401),
        (vec![host.clone(), origin.clone()], 401),
        (vec![format!("Host: evil.example:{port}")], 421),
        // The host is an address of another machine.
        (vec![format!("Host: 192.0.2.1:{port}")], 421),
        (vec![format!("Host: evil.example:{port}"), format!("Origin: https://evil.example:{port}")], 421),
        (vec![host.clone(), "Origin: https://evil.example".into()], 403),
        // The same address without TLS is another origin.
        (vec![host.clone(), other], 403),
        (vec![host, "Origin: null".into()], 403),
    ] {
        assert_eq!(status(&site, "/api/shows", &lines), expected, "{lines:?}");
        assert_eq!(status(&site, "/ws", &[lines.clone(), upgrade.to_vec()].concat()), expected, "{lines:?}");
    }
}

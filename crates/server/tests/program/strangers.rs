//! Requests of pages and names that are not this server's.

use crate::child;
use crate::http;
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, shows};

/// The status of a request with these header lines and no others but what closes the connection. An opened WebSocket is
/// left at once.
fn status(address: &str, path: &str, lines: &[String]) -> u16 {
    let lines: String = lines.iter().map(|line| format!("{line}\r\n")).collect();
    let answer = http::send(address, &format!("GET {path} HTTP/1.1\r\nConnection: close\r\n{lines}\r\n"));
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
        // No name, two names, and what is none.
        (vec![], 400),
        (vec![named("127.0.0.1"), named("127.0.0.1")], 400),
        (vec![named("127.0.0.1"), named("evil.example")], 400),
        (vec!["Host: ".into()], 400),
        // Names that DNS may point here, and ports of other servers.
        (vec![named("evil.example")], 421),
        (vec![named("evil.example"), of("evil.example")], 421),
        (vec![named("localhost.")], 421),
        (vec!["Host: 127.0.0.1".into()], 421),
        (vec!["Host: 127.0.0.1:1".into()], 421),
        // Pages of other servers, on this machine too.
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
    let upgrade =
        ["Upgrade: websocket", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ=="];
    for (lines, expected) in cases.iter().filter(|(_, expected)| *expected != 200) {
        let lines = [lines.clone(), upgrade.map(str::to_owned).to_vec()].concat();
        assert_eq!(status(&address, "/ws", &lines), *expected, "{lines:?}");
    }
    assert!(Screen::try_open(&address, "evil.example").is_err());
    assert!(Screen::try_open(&address, &format!("localhost:{port}")).is_err());
    let mut screen = Screen::open(&address);
    screen.until("the greeting", |screen| (screen.get("hello")["open_to_network"] == false).then_some(()));
}

#[test]
fn the_network_is_served_only_where_that_was_asked_for() {
    let _turn = alone();
    let data = shows::folder().join("nothing");
    let all = ["run", "--robots", "0", "--listen", "0.0.0.0:0", "--mqtt-listen", "127.0.0.1:0"];
    let all = [&all[..], &["--data", data.to_str().unwrap()]].concat();
    let (code, out, err) = child::run(&all);
    assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
    assert!(err.contains("--open-to-network"), "{err}");
    let mut server = child::Child::lightbots(&[&all[..], &["--open-to-network"]].concat());
    let address = server.said("http://");
    server.said("sign-in is required");
    assert!(Screen::try_open(&address, &address).is_err(), "a screen has to sign in");
    let port = address.rsplit_once(':').unwrap().1;
    assert_eq!(status(&address, "/api/shows", &[format!("Host: evil.example:{port}")]), 421);
    // An address of another machine.
    assert_eq!(status(&address, "/api/shows", &[format!("Host: 192.0.2.1:{port}")]), 421);
}

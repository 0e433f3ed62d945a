//! The screen over TLS: certificates, sockets, and clients that speak other protocols.

use std::io::{Read, Write};
use std::net::TcpStream;

use crate::certificates::Certificates;
use crate::child::{self, Child};
use crate::http;
use crate::screen::Screen;
use crate::sign_in::{session, start, start_on};
use crate::site::Site;
use crate::{DEADLINE, alone, shows};

/// Sends bytes without TLS and returns the answer. It is empty if the server closes the connection. `is_all` ends the
/// client's side after the bytes.
fn plainly(address: &str, bytes: &[u8], is_all: bool) -> String {
    let mut stream = TcpStream::connect(address).unwrap();
    stream.set_read_timeout(Some(DEADLINE)).unwrap();
    stream.write_all(bytes).unwrap();
    if is_all {
        let _ = stream.shutdown(std::net::Shutdown::Write);
    }
    let mut answer = Vec::new();
    // A server that closes a connection with unread bytes resets it.
    let _ = stream.read_to_end(&mut answer);
    String::from_utf8_lossy(&answer).into_owned()
}

#[test]
fn the_network_is_served_over_tls_with_a_certificate_of_the_first_start() {
    let _turn = alone();
    let (mut server, data, site) = start(&[("ann", "operator")]);
    let (file, key) = (format!("{data}/certs/server.pem"), format!("{data}/certs/server.key"));
    server.said("sign-in is required");
    server.said(&file);
    assert!(
        server.out().lines().any(|line| line.len() == 95 && line.split(':').count() == 32),
        "a fingerprint"
    );
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        assert_eq!(std::fs::metadata(&key).unwrap().permissions().mode() & 0o777, 0o600);
    }
    let cookie = session(&site, "ann", "password of ann");
    let shown = http::request(&site, "GET", "/api/shows", &[("Cookie", &cookie)], "");
    assert_eq!(shown.status, 200);
    let origin = site.address.clone();
    let mut screen = Screen::try_open_with(&site, &origin, &[("Cookie", &cookie)]).unwrap();
    screen.until("the greeting", |screen| (screen.get("hello")["plain_http"] == false).then_some(()));
    screen.wait_for_broker("connected");
    screen.must(serde_json::json!({"do": "stop_all"}));
    // A client that trusts another authority does not connect.
    let other = Certificates::make();
    assert!(Site::secure(&site.address, &other.file("ca.pem")).connect().is_err());
    // The next start uses the same certificate.
    let before = std::fs::read(&file).unwrap();
    server.kill();
    let (_server, site) = start_on(&data, &[]);
    assert_eq!(std::fs::read(&file).unwrap(), before);
    session(&site, "ann", "password of ann");
}

#[test]
fn clients_without_tls_are_told_the_right_address() {
    let _turn = alone();
    let (server, _, site) = start(&[("ann", "operator")]);
    let address = &site.address;
    let request = |line: &str, more: &str| {
        plainly(
            address,
            format!("{line} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{more}\r\n").as_bytes(),
            false,
        )
    };
    let page = request("GET /edit?show=a", "");
    assert!(page.starts_with("HTTP/1.1 307"), "{page}");
    assert!(page.to_lowercase().contains(&format!("location: https://{address}/edit?show=a\r\n")), "{page}");
    for refused in [
        request("POST /api/session", "Content-Length: 0\r\n"),
        request("GET /api/shows", "Authorization: Bearer 0\r\n"),
        plainly(address, b"GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n", false),
    ] {
        assert!(refused.starts_with("HTTP/1.1 400") && refused.contains("https://"), "{refused}");
        assert!(!refused.to_lowercase().contains("location:") && !refused.contains("evil"), "{refused}");
    }
    for noise in [&b"\x16\x03\x01\xff\xff nonsense"[..], b"\x10\x1a\x00\x04MQTT", b"\x16", b"", &[0; 3000]] {
        let answer = plainly(address, noise, true);
        assert!(!answer.contains(" 200 "), "{answer}");
    }
    // The server still works, and no thread of it panicked.
    session(&site, "ann", "password of ann");
    assert!(!server.err().contains("panicked"), "{}", server.err());
}

#[test]
fn certificates_of_an_own_authority_are_taken() {
    let _turn = alone();
    let data = shows::own_folder().to_str().unwrap().to_owned();
    let certs = format!("{data}/certs");
    let (code, out, err) = child::run(&["certs", "--out", &certs, "--name", "stage.example"]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    let made = std::fs::read(format!("{certs}/server.pem")).unwrap();
    let (server, site) = start_on(&data, &["--host-name", "stage.example", "--host-name", "other.example"]);
    assert_eq!(std::fs::read(format!("{certs}/server.pem")).unwrap(), made);
    let trusting = Site::secure(&site.address, &format!("{certs}/ca.pem"));
    assert_eq!(http::request(&trusting, "GET", "/", &[], "").status, 401);
    let said = server.err();
    assert!(said.contains("not for other.example") && said.contains("certs --out"), "{said}");
}

#[test]
fn certificates_that_cannot_be_used_are_one_line_with_the_remedy() {
    let wrong = Certificates::make();
    for (stem, expected) in [("expired", "has expired"), ("ca", "do not fit together")] {
        let data = shows::own_folder();
        std::fs::create_dir_all(data.join("certs")).unwrap();
        let key = if stem == "ca" { "server" } else { stem };
        std::fs::copy(wrong.file(&format!("{stem}.pem")), data.join("certs/server.pem")).unwrap();
        std::fs::copy(wrong.file(&format!("{key}.key")), data.join("certs/server.key")).unwrap();
        let data = data.to_str().unwrap();
        let (code, out, err) = child::run(&["run", "--robots", "0", "--listen", "0.0.0.0:0", "--data", data]);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{err}");
        assert!(err.contains(expected) && err.contains("server.pem"), "{err}");
        assert!(err.contains("remove server.pem") && err.contains("lightbots certs --out"), "{err}");
    }
}

#[test]
fn without_tls_the_program_says_what_fails() {
    let _turn = alone();
    let data = shows::own_folder().to_str().unwrap().to_owned();
    let (code, out, err) = child::run_with_input(&["passwd", "ann", "--data", &data], "a long password\n");
    assert_eq!(code, 0, "{out}{err}");
    let network = ["run", "--robots", "0", "--listen", "0.0.0.0:0", "--mqtt-listen", "127.0.0.1:0"];
    let mut server = Child::lightbots(&[&network[..], &["--plain-http", "--data", &data]].concat());
    let address = server.said("LightBots is at http://");
    server.said("passwords can be read on the way, and browsers refuse film and MIDI");
    let cookie = session(&address, "ann", "a long password");
    let mut screen = Screen::try_open_with(&address, &address, &[("Cookie", &cookie)]).unwrap();
    screen.until("the greeting", |screen| (screen.get("hello")["plain_http"] == true).then_some(()));
    assert!(!std::path::Path::new(&data).join("certs").exists());
}

//! The broker that the operator chooses on the screen.

use serde_json::json;

use crate::alone;
use crate::certificates::Certificates;
use crate::mosquitto::Mosquitto;
use crate::run::start;
use crate::screen::Screen;
use crate::{http, shows};

/// Waits until the controller has connected this number of times. The first connection is to the embedded broker.
fn connected_times(screen: &mut Screen, times: usize) {
    screen.until(&format!("{times} connections"), |screen| {
        let lines = screen.log.iter().filter(|line| line.starts_with("Connected to the broker"));
        (lines.count() == times).then_some(())
    });
}

#[test]
fn a_broker_is_chosen_lost_left_and_remembered() {
    let _turn = alone();
    let Some(mut broker) = Mosquitto::start() else { return };
    let data = shows::file("data", "") + ".d";
    let arguments = ["--robots", "0", "--data", &data];
    let (mut server, address, _) = start(&arguments);
    let mut screen = Screen::open(&address);
    screen.wait_for_broker("connected");
    let settings = || http::request(&address, "GET", "/api/broker", &[], "").json();
    assert_eq!(settings()["address"], "embedded");
    assert!(settings()["embedded"].as_str().unwrap().starts_with("mqtt://127.0.0.1"));

    // Nothing answers at the first of two addresses. It is port 1, because the restarted server might get any free
    // port.
    let two = format!("127.0.0.1:1,{}", broker.url());
    screen.must(json!({"do": "connect", "address": two, "user": "me", "password": "secret"}));
    let url = broker.url();
    screen.until("the second address", |screen| (screen.get("state")["broker"]["node"] == url).then_some(()));
    assert_eq!(settings()["has_password"], true);
    broker.restart();
    screen.wait_for_log("closed the connection");
    screen.wait_for_broker("connected");
    drop(broker);
    let lost = screen.wait_for_broker("retrying");
    assert!(!lost["reason"].as_str().unwrap().is_empty() && lost["node"].is_null(), "{lost}");

    // At the next start the chosen broker is used again, until the operator leaves it.
    server.terminate();
    server.end();
    let (mut server, address, _) = start(&arguments);
    let mut screen = Screen::open(&address);
    let again = screen.wait_for_broker("retrying");
    assert!(again["address"].as_str().unwrap().starts_with("mqtt://127.0.0.1"), "{again}");
    screen.must(json!({"do": "disconnect"}));
    assert_eq!(screen.wait_for_broker("off")["address"], "");
    screen.must(json!({"do": "connect", "address": "embedded"}));
    screen.wait_for_broker("connected");
    server.terminate();
    server.end();
}

#[test]
fn what_a_form_may_hold_and_what_is_refused() {
    let _turn = alone();
    let made = Certificates::make();
    let (cert, key) = (made.file("server.pem"), made.file("server.key"));
    let tls = ["--mqtt-tls-listen", "127.0.0.1:0", "--cert", &cert, "--key", &key];
    let data = shows::file("data", "") + ".d";
    let (mut server, address, _) =
        start(&[&["--robots", "0", "--data", &data, "--mqtt-user", "me:secret"][..], &tls].concat());
    let tls = server.said("mqtts://");
    let mut screen = Screen::open(&address);
    let connect = |ca: Option<&str>, password: Option<&str>| json!({"do": "connect", "address": format!("mqtts://{tls}"), "user": "me", "password": password, "ca": ca});
    let pasted = std::fs::read_to_string(made.file("ca.pem")).unwrap();
    connected_times(&mut screen, 1);
    screen.must(connect(Some(&pasted), Some("secret")));
    connected_times(&mut screen, 2);
    // The screen's form never receives the password, so a connection without one uses the saved password.
    screen.must(connect(Some(&made.file("ca.pem")), None));
    connected_times(&mut screen, 3);
    screen.must(connect(Some(&pasted), Some("wrong")));
    let refused = screen.wait_for_broker("retrying");
    assert!(refused["reason"].as_str().unwrap().contains("user and password"), "{refused}");
    for (wish, part) in [
        (json!({"do": "connect", "address": "http://x"}), "no broker address"),
        (json!({"do": "connect", "address": "mqtts://x", "ca": "no-such.pem"}), "no-such.pem"),
        (json!({"do": "connect", "address": "mqtts://x", "client_cert": "x.pem"}), "come together"),
    ] {
        let answer = screen.operate(wish);
        assert_eq!(answer["ok"], false);
        assert!(answer["error"].as_str().unwrap().contains(part), "{answer}");
    }
    let settings = http::request(&address, "GET", "/api/broker", &[], "");
    assert!(
        !settings.body.contains("wrong") && settings.body.contains("BEGIN CERTIFICATE"),
        "{}",
        settings.body
    );
}

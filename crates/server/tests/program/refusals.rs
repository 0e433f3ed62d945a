//! Messages about brokers that cannot be used: one line with place, cause and remedy. The brokers are the embedded one
//! and Mosquitto, both with TLS and passwords.

use crate::alone;
use crate::certificates::Certificates;
use crate::child::{Child, run};
use crate::mosquitto::{Mosquitto, free_port};
use crate::run::start;
use crate::{http, shows};

/// Ports of brokers: without TLS, with a good certificate, with an expired one and with one for another name.
struct Ports {
    plain: u16,
    good: u16,
    expired: u16,
    elsewhere: u16,
    /// Port of a broker that requires a client certificate.
    choosy: u16,
}

/// A robot that connects to a broker, and the text that it must print.
struct Attempt {
    robot: Child,
    says: &'static str,
}

fn attempt(url: &str, options: &[&str], says: &'static str) -> Attempt {
    let all = [&["robots", "--count", "1", "--log", "info", "--broker", url][..], options].concat();
    Attempt { robot: Child::lightbots(&all), says }
}

/// Makes all attempts at the same time, and waits for every line.
fn check(ports: &Ports, made: &Certificates) {
    let (ca, other) = (made.file("ca.pem"), Certificates::make());
    let (cert, key) = (made.file("client-r7.pem"), made.file("client-r7.key"));
    let (wrong_cert, wrong_key) = (other.file("client-r7.pem"), other.file("client-r7.key"));
    let tls = |port: u16| format!("mqtts://me:secret@127.0.0.1:{port}");
    let trusted = ["--ca", ca.as_str()];
    let shown = ["--ca", &ca, "--client-cert", &cert, "--client-key", &key];
    let wrong = ["--ca", &ca, "--client-cert", &wrong_cert, "--client-key", &wrong_key];
    let attempts = [
        attempt(&tls(ports.good), &trusted, "connected to mqtts://127.0.0.1"),
        attempt(
            &format!("mqtts://me:secret@localhost:{}", ports.good),
            &trusted,
            "connected to mqtts://localhost",
        ),
        attempt(&format!("mqtt://me:secret@127.0.0.1:{}", ports.plain), &[], "connected to mqtt://127.0.0.1"),
        attempt(
            &tls(ports.good).replace("secret", "wrong"),
            &trusted,
            "refuses this user and password: check both",
        ),
        attempt(
            &tls(ports.good),
            &["--ca", &other.file("ca.pem")],
            "comes from no authority we trust: name its own",
        ),
        attempt(&tls(ports.expired), &trusted, "has expired: give the broker a new one"),
        attempt(
            &tls(ports.elsewhere),
            &trusted,
            "is made for elsewhere.example, not for 127.0.0.1: use one of its",
        ),
        attempt(&tls(ports.choosy), &shown, "connected to mqtts://127.0.0.1"),
        attempt(
            &tls(ports.choosy),
            &trusted,
            "wants to see a certificate of ours: name it with --client-cert",
        ),
        attempt(&tls(ports.choosy), &wrong, "refuses our client certificate"),
        attempt(&tls(ports.plain), &trusted, "is this its port for TLS (mqtt:// is the one without)"),
        attempt(
            &format!("mqtt://me:secret@127.0.0.1:{}", ports.good),
            &[],
            "say mqtts:// where this is its port for TLS",
        ),
        attempt(&tls(free_port()), &trusted, "no broker answers at mqtts://127.0.0.1"),
    ];
    for Attempt { mut robot, says } in attempts {
        robot.complains(says);
        let line = robot.err().lines().find(|line| line.contains(says)).unwrap().to_owned();
        assert!(line.contains("://127.0.0.1") || line.contains("://localhost"), "no place in {line}");
        assert!(!robot.err().contains("secret"), "{}", robot.err());
    }
}

#[test]
fn mosquitto_with_tls_and_passwords() {
    let _turn = alone();
    let made = Certificates::make();
    let passwords = shows::file("passwords", "me:secret\n");
    let hashed = std::process::Command::new("mosquitto_passwd").args(["-U", &passwords]).status();
    let settings = |ports: [u16; 5]| {
        let tls = |port: u16, stem: &str| {
            let (ca, cert, key) =
                (made.file("ca.pem"), made.file(&format!("{stem}.pem")), made.file(&format!("{stem}.key")));
            format!("listener {port} 127.0.0.1\ncafile {ca}\ncertfile {cert}\nkeyfile {key}\n")
        };
        let [plain, good, expired, elsewhere, choosy] = ports;
        // Mosquitto drops root's rights at its start, and with them access to the private keys.
        let user = std::env::var("USER").unwrap_or_else(|_| "root".into());
        format!(
            "user {user}\nallow_anonymous false\npassword_file {passwords}\nlistener {plain} 127.0.0.1\n{}{}{}{}require_certificate true\n",
            tls(good, "server"),
            tls(expired, "expired"),
            tls(elsewhere, "elsewhere"),
            tls(choosy, "server"),
        )
    };
    assert!(hashed.is_ok_and(|status| status.success()), "mosquitto_passwd comes with Mosquitto");
    let Some((_broker, [plain, good, expired, elsewhere, choosy])) = Mosquitto::with_settings(settings)
    else {
        return;
    };
    check(&Ports { plain, good, expired, elsewhere, choosy }, &made);
}

#[test]
fn the_embedded_broker_with_tls_and_passwords() {
    let _turn = alone();
    let made = Certificates::make();
    let serve = |stem: &str, more: &[&str]| {
        let (cert, key) = (made.file(&format!("{stem}.pem")), made.file(&format!("{stem}.key")));
        let tls = ["--mqtt-tls-listen", "127.0.0.1:0", "--cert", &cert, "--key", &key];
        let all = [&["--robots", "0", "--mqtt-user", "me:secret"][..], &tls, more].concat();
        let (mut server, _, plain) = start(&all);
        let port = |address: &str| address.rsplit(':').next().unwrap().parse::<u16>().unwrap();
        let tls = server.said("mqtts://");
        (server, port(&plain), port(&tls))
    };
    let ca = made.file("ca.pem");
    let (mut one, plain, good) = serve("server", &[]);
    let (_two, _, expired) = serve("expired", &[]);
    let (_three, _, elsewhere) = serve("elsewhere", &[]);
    let (mut four, _, choosy) = serve("server", &["--client-ca", &ca]);
    check(&Ports { plain, good, expired, elsewhere, choosy }, &made);
    // The broker's own log names the refused client too. It names a client only once in a while.
    one.complains("The broker refused TLS with a client from 127.0.0.1");
    four.complains("The broker refused TLS with a client from 127.0.0.1");
}

#[test]
fn what_cannot_be_right_is_said_at_once() {
    let made = Certificates::make();
    let (ca, key, cert) = (made.file("ca.pem"), made.file("ca.key"), made.file("server.pem"));
    let robots = |options: &[&str]| [&["robots", "--count", "1"][..], options].concat().join("\u{1}");
    let run_ = |options: &[&str]| {
        let all = ["run", "--robots", "0", "--listen", "127.0.0.1:0", "--mqtt-listen", "127.0.0.1:0"];
        [&all[..], &["--mqtt-tls-listen", "127.0.0.1:0"], options].concat().join("\u{1}")
    };
    for (line, part) in [
        (robots(&["--broker", "mqtts://a", "--ca", "no-such.pem"]), "no-such.pem cannot be read"),
        (robots(&["--broker", "mqtts://a", "--ca", &key]), "holds no certificate"),
        (robots(&["--broker", "mqtts://a", "--client-cert", &cert]), "--client-key"),
        (
            robots(&["--broker", "mqtts://a", "--client-cert", &cert, "--client-key", &key]),
            "do not fit together",
        ),
        (robots(&["--broker", "mqtt://u:secret@a,mqtt://v:secret@b"]), "several logins"),
        (robots(&["--broker", "a", "--broker-password-file", &ca]), "the user is missing"),
        (run_(&["--cert", &cert]), "--key"),
        (run_(&["--cert", &cert, "--key", &key]), "do not fit together"),
        (run_(&["--cert", "no-such.pem", "--key", &key]), "no-such.pem cannot be used"),
        (run_(&["--cert", &cert, "--key", &ca]), "must hold a private key"),
        (run_(&["--cert", &cert, "--key", &made.file("server.key"), "--mqtt-user", "me"]), "user:password"),
    ] {
        let arguments: Vec<&str> = line.split('\u{1}').collect();
        let (code, out, err) = run(&arguments);
        assert_eq!((code, out.as_str(), err.lines().count()), (2, "", 1), "{arguments:?}: {err}");
        assert!(err.contains(part) && !err.contains("secret"), "{part}: {err}");
    }
}

#[test]
fn the_next_address_is_used_where_one_dies() {
    let _turn = alone();
    let (Some(first), Some(second)) = (Mosquitto::start(), Mosquitto::start()) else { return };
    let urls = format!("mqtt://127.0.0.1:{},{},{}", free_port(), first.url(), second.url());
    let mut robots = Child::lightbots(&["robots", "--count", "3", "--log", "info", "--broker", &urls]);
    robots.complains("no broker answers");
    robots.complains(&format!("connected to {}", first.url()));
    drop(first);
    robots.complains(&format!("connected to {}", second.url()));
}

#[test]
fn a_screen_reads_no_password() {
    let _turn = alone();
    let data = shows::file("data", "") + ".d";
    let (_server, address, _) =
        start(&["--robots", "0", "--data", &data, "--broker", "mqtt://me:secret@127.0.0.1:1"]);
    let answer = http::request(&address, "GET", "/api/broker", &[], "");
    assert_eq!(answer.status, 200);
    assert_eq!(answer.json()["user"], "me");
    assert!(!answer.body.contains("secret"), "{}", answer.body);
}

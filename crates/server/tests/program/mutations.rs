//! Seeded mutations of what clients send to the sockets of `run`: MQTT, HTTP and WebSocket. The program, its broker and
//! its screens must keep running.
//!
//! `LIGHTBOTS_MUTATIONS=5000 cargo test -p lightbots-server --test program mutations` tries more than the usual run.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::time::Duration;

use crate::raw_mqtt::{RawMqtt, connect, packet, publish, subscribe, text};
use crate::run::start;
use crate::screen::Screen;
use crate::{alone, http, shows};

#[path = "../../../exchange/tests/mutator/mod.rs"]
mod mutator;
#[path = "../../../exchange/tests/numbers/mod.rs"]
mod numbers;

use mutator::{corpus_files, mutant, rounds};
use numbers::Numbers;

/// Number of mutations of each message in a usual run.
const USUAL: usize = 40;

/// How long a mutant waits for an answer. Many get none.
const ANSWER: Duration = Duration::from_millis(20);

/// Number of mutations between two checks that everything works.
const BATCH: usize = 20;

/// Sequences of packets that MQTT clients send to the broker.
fn mqtt() -> Vec<Vec<u8>> {
    let robot = connect("LightBot/mutant");
    let report = publish("Position", b"LightBot/mutant 0.5 -1.25 state=idle bat=87");
    let will =
        [&text("MQTT")[..], &[4, 0xee, 0, 5], &text("w"), &text("a"), &text("b"), &text("u"), &text("p")]
            .concat();
    let five = [&text("MQTT")[..], &[5, 2, 0, 0, 3, 0x21, 0, 10], &text("five")].concat();
    vec![
        [&robot[..], &subscribe("T/LightBot/mutant"), &report, &packet(0xc0, &[]), &packet(0xe0, &[])]
            .concat(),
        [&packet(0x10, &will)[..], &packet(0x32, &[&text("a/b")[..], &[0, 7], b"x"].concat())].concat(),
        [&packet(0x10, &five)[..], &packet(0x82, &[&[0, 1, 0][..], &text("$share/g/#"), &[1]].concat())]
            .concat(),
    ]
}

/// Requests as pages and programs send them, in bytes.
fn http_requests(address: &str) -> Vec<Vec<u8>> {
    let head = |first: &str, more: &str| {
        format!("{first} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{more}\r\n").into_bytes()
    };
    let body = |first: &str, body: &str| {
        [head(first, &format!("Content-Length: {}\r\n", body.len())), body.as_bytes().to_vec()].concat()
    };
    let show = r##"{"lightbots":1,"name":"x","stage":{"width_m":3,"depth_m":3},"frames":[{"name":"1","pixels":[{"id":0,"place":[0,1],"color":"#ff8c00"}]}]}"##;
    vec![
        head("GET /api/shows", "Accept: application/json\r\n"),
        head("GET /api/plan?x=%20", "Range: bytes=0-9\r\nIf-None-Match: \"1\"\r\n"),
        body("POST /api/check", show),
        body("PUT /api/shows/Mutant", show),
        body("POST /api/convert?to=original", show),
        head("POST /api/check", "Transfer-Encoding: chunked\r\n")
            .into_iter()
            .chain(*b"5\r\nhello\r\n0\r\n\r\n")
            .collect(),
    ]
}

/// What a screen sends: a request for a WebSocket, and frames with messages.
fn websocket(address: &str) -> Vec<Vec<u8>> {
    let head = format!(
        "GET /ws HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    );
    let frame = |kind: u8, payload: &[u8]| {
        // A mask of zeros leaves the payload as it is.
        [&[0x80 | kind, 0x80 | 126, (payload.len() >> 8) as u8, payload.len() as u8, 0, 0, 0, 0], payload]
            .concat()
    };
    let talk = |frames: &[Vec<u8>]| [head.as_bytes(), &frames.concat()].concat();
    vec![
        talk(&[frame(1, br#"{"type":"took"}"#), frame(9, b"ping"), frame(8, &[3, 232])]),
        talk(&[frame(1, br#"{"type":"do","id":7,"operation":{"do":"play","from":0,"missing":"refuse"}}"#)]),
        talk(&[frame(2, &[0, 1, 2, 255]), frame(0, b"rest"), frame(1, br#"{"type":"open","name":"x"}"#)]),
    ]
}

/// Sends these bytes on a new connection and ignores the outcome.
fn send(address: &str, bytes: &[u8]) {
    let Ok(mut stream) = TcpStream::connect(address) else { return };
    let _ = stream.set_read_timeout(Some(ANSWER));
    let _ = stream.set_write_timeout(Some(ANSWER));
    let _ = stream.write_all(bytes);
    let _ = stream.read(&mut [0; 512]);
}

fn corpus(kind: &str) -> Vec<Vec<u8>> {
    corpus_files(&PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(kind))
}

#[cfg(target_os = "linux")]
#[test]
fn no_mutation_breaks_the_program_its_broker_or_its_screens() {
    let _turn = alone();
    let (mut server, address, broker) = start(&["--robots", "2", &shows::row_file(2, &[0.1])]);
    let mut screen = Screen::open(&address);
    screen.wait_for_robots(2);
    let children = server.children();
    let mut numbers = Numbers(1);
    let kinds = [
        ("mqtt", &broker, mqtt()),
        ("http", &address, http_requests(&address)),
        ("websocket", &address, websocket(&address)),
    ];
    for (kind, target, good) in kinds {
        let broken = corpus(kind);
        assert!(!broken.is_empty(), "{kind} has a corpus");
        let mutants = good
            .iter()
            .flat_map(|good| std::iter::repeat_n(good, rounds(USUAL)))
            .map(|good| mutant(good, 4, &mut numbers));
        let all: Vec<Vec<u8>> = broken.into_iter().chain(mutants).collect();
        for batch in all.chunks(BATCH) {
            batch.iter().for_each(|bytes| send(target, bytes));
            let about = || {
                format!(
                    "{kind}: {:?}",
                    batch.iter().map(|b| b.escape_ascii().to_string()).collect::<Vec<_>>()
                )
            };
            assert_eq!(server.exit_code(), None, "{}", about());
            assert_eq!(server.children(), children, "the broker's process ended; {}", about());
            assert_eq!(http::request(&address, "GET", "/api/shows", &[], "").status, 200, "{}", about());
        }
        assert!(RawMqtt::open(&broker, "after").is_answered());
    }
    // A mutant may have played the show or opened another one. The screen must still show the robots.
    screen.wait_for_robots(2);
    server.terminate();
    assert_eq!(server.end(), 0);
}

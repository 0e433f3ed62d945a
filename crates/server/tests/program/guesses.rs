//! Ten thousand guesses at passwords over HTTP.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::UdpSocket;
use std::thread;
use std::time::Instant;

use serde_json::json;

use crate::child::Child;
use crate::sign_in::{session, sign_in, start, token};
use crate::site::{Line, Site};
use crate::{DEADLINE, alone, http};

/// Number of guesses of each test.
const GUESSES: usize = 10_000;
/// Wrong passwords for one name from one address before a pause, as SECURITY.md states.
const TRIES: usize = 5;
/// Wrong passwords for all names together that are allowed at once, and seconds for each further one, as SECURITY.md
/// states.
const IN_WHOLE: (usize, u64) = (60, 10);
/// Most memory that the server may gain from refused guesses, kB: less than 1 kB for each.
const GROWTH_KB_MAX: u64 = 8_000;
/// Memory that the allocator may keep for each concurrent password hash, kB: its 19 MiB.
const HASH_KB: u64 = 20_000;
/// Number of connections that guess at the same time.
const CONNECTIONS: usize = 4;

/// A connection that stays open for many guesses.
struct Guesser {
    stream: BufReader<Line>,
    host: String,
}

impl Guesser {
    fn open(site: &Site) -> Self {
        let stream = site.connect().unwrap();
        stream.set_read_timeout(DEADLINE);
        Self { stream: BufReader::new(stream), host: site.address.clone() }
    }

    /// Sends a guess. Returns status, `Retry-After` in seconds and body of the answer.
    fn guess(&mut self, name: &str, password: &str) -> (u16, Option<u64>, String) {
        let body = json!({"name": name, "password": password}).to_string();
        let request = format!(
            "POST /api/session HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            self.host,
            body.len()
        );
        self.stream.get_mut().write_all(request.as_bytes()).unwrap();
        let (mut status, mut length, mut retry_after) = (0, 0, None);
        loop {
            let mut line = String::new();
            self.stream.read_line(&mut line).unwrap();
            let line = line.trim_end().to_lowercase();
            if line.is_empty() {
                break;
            }
            match line.split_once(": ") {
                Some(("content-length", value)) => length = value.parse().unwrap(),
                Some(("retry-after", value)) => retry_after = value.parse().ok(),
                _ if line.starts_with("http/1.1 ") => status = line[9..12].parse().unwrap(),
                _ => {}
            }
        }
        let mut body = vec![0; length];
        self.stream.read_exact(&mut body).unwrap();
        (status, retry_after, String::from_utf8(body).unwrap())
    }
}

/// Resident memory of a process, kB. `None` if the system does not report it.
fn memory_kb(server: &Child) -> Option<u64> {
    let status = std::fs::read_to_string(format!("/proc/{}/status", server.id())).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}

/// Fails if the server's memory grew by more than refused guesses and `hashes` concurrent hashes may take.
fn assert_memory(server: &Child, before: Option<u64>, hashes: usize) {
    if let (Some(before), Some(after)) = (before, memory_kb(server)) {
        assert!(after < before + GROWTH_KB_MAX + HASH_KB * hashes as u64, "from {before} kB to {after} kB");
    }
}

/// Asserts that a refusal states its pause in seconds and in words. `most` bounds it, seconds.
fn assert_is_pause((status, retry_after, body): &(u16, Option<u64>, String), most: u64) {
    assert_eq!(*status, 429, "{body}");
    assert!(retry_after.is_some_and(|seconds| (1..=most).contains(&seconds)), "{retry_after:?}");
    assert!(body.contains("Too many wrong passwords. Try again in "), "{body}");
}

/// Guesses ann's password on all connections at the same time. Returns how many guesses were tried, and not refused.
fn guess_at_ann(site: &Site, guesses: usize) -> usize {
    let guess = |thread: usize| {
        let mut guesser = Guesser::open(site);
        let count = guesses / CONNECTIONS;
        let answers = (0..count).map(|number| guesser.guess("ann", &format!("guess {thread} {number}")));
        let refused = answers.filter(|answer| answer.0 != 401).inspect(|answer| assert_is_pause(answer, 61));
        count - refused.count()
    };
    thread::scope(|scope| {
        let threads: Vec<_> = (0..CONNECTIONS).map(|thread| scope.spawn(move || guess(thread))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap()).sum()
    })
}

#[test]
fn ten_thousand_guesses_at_one_name_are_five_tries() {
    let _turn = alone();
    let (server, _, site) = start(&[("ann", "operator"), ("bob", "viewer")]);
    let bearer = token(&site, &session(&site, "ann", "password of ann"), "lights", "viewer");
    let first = GUESSES / 10;
    let tried = thread::scope(|scope| {
        let guessing = scope.spawn(|| guess_at_ann(&site, first));
        // Meanwhile another user signs in, and a program with a token is served.
        session(&site, "bob", "password of bob");
        let shows = http::request(&site, "GET", "/api/shows", &[("Authorization", &bearer)], "");
        assert_eq!(shows.status, 200);
        guessing.join().unwrap()
    });
    assert_eq!(tried, TRIES, "guesses in parallel do not pass the bound");
    let before = memory_kb(&server);
    assert_eq!(guess_at_ann(&site, GUESSES - first), 0);
    assert_memory(&server, before, 0);
    let right = sign_in(&site, "ann", "password of ann");
    assert_eq!(right.status, 429, "the right password has to wait too");
    session(&site, "bob", "password of bob");
}

/// A non-loopback address of this machine. Packets to it do not leave the machine.
fn own_address() -> Option<String> {
    // Connecting a UDP socket chooses a route and sends nothing.
    let socket = UdpSocket::bind("0.0.0.0:0").ok()?;
    socket.connect("192.0.2.1:9").ok()?;
    let address = socket.local_addr().ok()?.ip();
    (!address.is_loopback() && !address.is_unspecified()).then(|| address.to_string())
}

#[test]
fn ten_thousand_guesses_at_as_many_names_are_sixty_tries() {
    let _turn = alone();
    let Some(own) = own_address() else { return };
    let (server, data, site) = start(&[("ann", "operator"), ("bob", "viewer")]);
    let port = site.address.rsplit_once(':').unwrap().1;
    let outside = Site::secure(&format!("{own}:{port}"), &format!("{data}/certs/server.pem"));
    session(&outside, "bob", "password of bob");
    let began = Instant::now();
    let mut guesser = Guesser::open(&outside);
    let (mut tried, mut before) = (0_usize, None);
    for number in 0..GUESSES {
        let answer = guesser.guess(&format!("name{number}"), "a guess");
        if answer.0 == 401 {
            tried += 1;
        } else {
            assert_is_pause(&answer, IN_WHOLE.1 + 1);
            before = before.or_else(|| memory_kb(&server));
        }
    }
    assert_memory(&server, before, tried.saturating_sub(IN_WHOLE.0));
    let refilled = (began.elapsed().as_secs() / IN_WHOLE.1) as usize + 1;
    assert!((IN_WHOLE.0..=IN_WHOLE.0 + refilled).contains(&tried), "{tried}");
    let ann = sign_in(&outside, "ann", "password of ann");
    assert_eq!(ann.status, 429, "an address from which ann never signed in has to wait");
    session(&outside, "bob", "password of bob");
    session(&site, "ann", "password of ann");
}

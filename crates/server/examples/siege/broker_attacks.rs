//! Attacks of hostile clients on the broker.

use std::io::{Read, Result, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

use crate::Target;
use crate::packets::{connect, packet, publish, subscribe, text};

/// Pause between two attacks of a frequent kind.
const SHORT: Duration = Duration::from_millis(5);
/// Pause between two attacks of a rare kind.
const LONG: Duration = Duration::from_secs(1);
/// How long an attacker waits for an answer.
const ANSWER: Duration = Duration::from_millis(500);

/// Starts all attacks.
pub fn begin(target: &Arc<Target>) {
    let mut dice = 0x9e37_79b9_7f4a_7c15;
    target.repeat(SHORT, move |target| mutated(target, &mut dice));
    target.repeat(LONG / 20, deep);
    let mut readers = Vec::new();
    target.repeat(LONG, move |target| refill(&mut readers, 20, || slow_reader(target)));
    let mut publisher = None;
    target.repeat(SHORT, move |target| flood(target, &mut publisher));
    let mut silent = Vec::new();
    target.repeat(LONG, move |target| refill(&mut silent, 800, || half_open(target)));
    let mut uploads = Vec::new();
    target.repeat(LONG, move |target| refill(&mut uploads, 200, || endless_packet(target)));
}

/// Keeps `count` connections open, and replaces those that the broker has closed.
fn refill(open: &mut Vec<TcpStream>, count: usize, connect: impl Fn() -> Result<TcpStream>) -> Result<()> {
    open.retain(|stream| {
        let _ = stream.set_nonblocking(true);
        let mut byte = [0];
        // An open connection has nothing to read, or the unread data of a slow reader.
        stream
            .peek(&mut byte)
            .map_or_else(|error| error.kind() == std::io::ErrorKind::WouldBlock, |read| read > 0)
    });
    while open.len() < count {
        open.push(connect()?);
    }
    Ok(())
}

/// Sends a login, a subscription and a message with some bytes changed.
fn mutated(target: &Target, dice: &mut u64) -> Result<()> {
    let mut bytes = connect("mutant");
    bytes.extend(subscribe("a/b"));
    bytes.extend(publish("a/b", b"0123456789"));
    for _ in 0..1 + roll(dice, 4) {
        let place = roll(dice, bytes.len());
        bytes[place] = roll(dice, 256) as u8;
    }
    let mut stream = connection(target)?;
    stream.write_all(&bytes)?;
    let _ = stream.read(&mut [0; 64]);
    Ok(())
}

/// Sends a subscription, a message and a will whose topics have ten thousand levels.
fn deep(target: &Target) -> Result<()> {
    let deep = "/".repeat(10_000);
    let mut stream = logged_in(target, "deep")?;
    for bytes in [subscribe(&deep), publish(&deep, b"x")] {
        stream.write_all(&bytes)?;
    }
    let _ = stream.read(&mut [0; 64]);
    let mut with_will = connection(target)?;
    let will = [&text("MQTT")[..], &[4, 6, 0, 0], &text("will"), &text(&deep), &text("x")].concat();
    with_will.write_all(&packet(0x10, &will))
}

/// A client that subscribes to everything and reads nothing.
fn slow_reader(target: &Target) -> Result<TcpStream> {
    let name = format!("slow-{:?}", std::time::Instant::now());
    let mut stream = logged_in(target, &name)?;
    stream.write_all(&subscribe("#"))?;
    Ok(stream)
}

/// Publishes a message of 60 kB. The repetitions make about 10 MB a second.
fn flood(target: &Target, publisher: &mut Option<TcpStream>) -> Result<()> {
    if publisher.is_none() {
        *publisher = Some(logged_in(target, "flood")?);
    }
    let sent =
        publisher.as_mut().map_or(Ok(()), |stream| stream.write_all(&publish("flood", &[b'x'; 60_000])));
    if sent.is_err() {
        *publisher = None;
    }
    sent
}

/// A connection that has sent only half of its login.
fn half_open(target: &Target) -> Result<TcpStream> {
    let mut stream = connection(target)?;
    stream.write_all(&connect("half")[..9])?;
    Ok(stream)
}

/// A client that has sent a message without its last byte.
fn endless_packet(target: &Target) -> Result<TcpStream> {
    let mut stream = logged_in(target, &format!("upload-{:?}", std::time::Instant::now()))?;
    let message = publish("upload", &[b'x'; 65_000]);
    stream.write_all(&message[..message.len() - 1])?;
    Ok(stream)
}

fn connection(target: &Target) -> Result<TcpStream> {
    let stream = TcpStream::connect(&target.broker)?;
    stream.set_read_timeout(Some(ANSWER))?;
    stream.set_write_timeout(Some(ANSWER))?;
    Ok(stream)
}

fn logged_in(target: &Target, client_id: &str) -> Result<TcpStream> {
    let mut stream = connection(target)?;
    stream.write_all(&connect(client_id))?;
    stream.read_exact(&mut [0; 4])?;
    Ok(stream)
}

/// A random number below `sides`, by xorshift.
fn roll(dice: &mut u64, sides: usize) -> usize {
    *dice ^= *dice << 13;
    *dice ^= *dice >> 7;
    *dice ^= *dice << 17;
    (*dice % sides as u64) as usize
}

//! Attacks of hostile clients on the web server.

use std::io::{Read, Result, Write};
use std::net::TcpStream;
use std::sync::Arc;
use std::time::Duration;

use crate::Target;

/// Pause between two attacks of the same kind.
const PAUSE: Duration = Duration::from_secs(1);
/// Longest wait of an attacker for sending or for an answer.
const ANSWER: Duration = Duration::from_secs(30);

/// Starts all attacks.
pub fn begin(target: &Arc<Target>) {
    let mut half_open = Vec::new();
    target
        .repeat(PAUSE, move |target| keep(&mut half_open, 200, target, "GET /api/shows HTTP/1.1\r\nHost: "));
    let mut endless = Vec::new();
    let head = "POST /api/check HTTP/1.1\r\nContent-Length: 60000000\r\nHost: ";
    target.repeat(PAUSE, move |target| {
        let head = format!("{head}{}\r\n\r\n[", target.web);
        keep(&mut endless, 20, target, &head)
    });
    target.repeat(PAUSE, |target| upload(target, "POST", "/api/check", &"[".repeat(60_000_000)));
    target.repeat(PAUSE, |target| upload(target, "PUT", "/api/shows/Siege", &crowd(400)));
    target.repeat(PAUSE, |target| upload(target, "POST", "/api/check", &crowd(3_000)));
    target
        .repeat(PAUSE / 20, |target| upload(target, "POST", "/api/convert?to=original", "{\"lightbots\":1}"));
}

/// Keeps `count` connections open that have sent only `head`, and replaces those that the server has closed or
/// answered.
fn keep(open: &mut Vec<TcpStream>, count: usize, target: &Target, head: &str) -> Result<()> {
    open.retain(|stream| {
        let _ = stream.set_nonblocking(true);
        stream.peek(&mut [0]).is_err_and(|error| error.kind() == std::io::ErrorKind::WouldBlock)
    });
    while open.len() < count {
        let mut stream = TcpStream::connect(&target.web)?;
        stream.write_all(head.as_bytes())?;
        open.push(stream);
    }
    Ok(())
}

fn upload(target: &Target, method: &str, path: &str, body: &str) -> Result<()> {
    let mut stream = TcpStream::connect(&target.web)?;
    stream.set_read_timeout(Some(ANSWER))?;
    stream.set_write_timeout(Some(ANSWER))?;
    let (host, length) = (&target.web, body.len());
    let head = format!(
        "{method} {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(body.as_bytes())?;
    stream.read_to_end(&mut Vec::new())?;
    Ok(())
}

/// A show of two frames, in which a square of robots is mirrored.
fn crowd(robots: usize) -> String {
    let side = (robots as f64).sqrt().ceil() as usize;
    let frame = |sign: f64| {
        let pixel = |id: usize| {
            let (x, y) = (sign * 0.08 * (id % side) as f64, sign * 0.08 * (id / side) as f64);
            format!(r##"{{"id":{id},"place":[{x:.3},{y:.3}],"color":"#ff8000"}}"##)
        };
        let pixels: Vec<String> = (0..robots).map(pixel).collect();
        format!(r#"{{"pixels":[{}]}}"#, pixels.join(","))
    };
    format!(
        r#"{{"lightbots":1,"name":"Siege","stage":{{"width_m":20,"depth_m":20}},"frames":[{},{}]}}"#,
        frame(1.0),
        frame(-1.0)
    )
}

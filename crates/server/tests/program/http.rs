//! A minimal HTTP client.

use std::io::{ErrorKind, Read, Write};

use crate::DEADLINE;
use crate::site::Site;

pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: String,
}

impl Answer {
    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.body).unwrap_or_else(|error| panic!("{error} in {}", self.body))
    }

    pub fn header(&self, name: &str) -> String {
        let line = self
            .head
            .lines()
            .find_map(|line| line.split_once(':').filter(|(key, _)| key.eq_ignore_ascii_case(name)));
        line.map(|(_, value)| value.trim().to_owned()).unwrap_or_default()
    }
}

/// Sends a request to a site, such as `host:port`. Returns the answer.
pub fn request(
    site: impl Into<Site>,
    method: &str,
    path: &str,
    headers: &[(&str, &str)],
    body: &str,
) -> Answer {
    let site = site.into();
    let address = &site.address;
    let headers: String = headers.iter().map(|(key, value)| format!("{key}: {value}\r\n")).collect();
    let length = if headers.contains("Content-Length") {
        String::new()
    } else {
        format!("Content-Length: {}\r\n", body.len())
    };
    send(
        &site,
        &format!(
            "{method} {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n{length}{headers}\r\n{body}"
        ),
    )
}

/// Sends these bytes and returns the answer. The request must make the server close the connection.
pub fn send(site: impl Into<Site>, bytes: &str) -> Answer {
    let mut stream = site.into().connect().unwrap();
    stream.set_read_timeout(DEADLINE);
    stream.write_all(bytes.as_bytes()).unwrap();
    let mut bytes = Vec::new();
    let read = stream.read_to_end(&mut bytes);
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
    let answer = Answer { status, head: head.to_owned(), body: body.to_owned() };
    // hyper drops a connection with a refused upgrade without closing TLS. Then `Content-Length` shows that the answer
    // is whole.
    let is_whole = answer.header("Content-Length") == answer.body.len().to_string();
    if !read.as_ref().is_err_and(|error| error.kind() == ErrorKind::UnexpectedEof && is_whole) {
        read.unwrap();
    }
    answer
}

//! MQTT 3.1.1 byte by byte: what no client library sends.

use std::io::{Read, Write};
use std::net::TcpStream;

use crate::DEADLINE;

pub struct RawMqtt {
    pub stream: TcpStream,
}

impl RawMqtt {
    /// A connection that has not said anything.
    pub fn silent(address: &str) -> Self {
        let stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(DEADLINE)).unwrap();
        Self { stream }
    }

    /// A client that has logged in, with no keep-alive.
    pub fn open(address: &str, client_id: &str) -> Self {
        let mut client = Self::silent(address);
        client.send(&connect(client_id));
        assert_eq!(client.read(4), [0x20, 2, 0, 0], "{client_id} is refused");
        client
    }

    pub fn send(&mut self, bytes: &[u8]) {
        self.stream.write_all(bytes).unwrap();
    }

    pub fn read(&mut self, length: usize) -> Vec<u8> {
        let mut bytes = vec![0; length];
        self.stream.read_exact(&mut bytes).unwrap();
        bytes
    }

    /// Subscribes; whether that was granted.
    pub fn subscribe(&mut self, filter: &str) -> bool {
        let rest = [&[0, 1][..], &text(filter), &[0]].concat();
        self.send(&packet(0x82, &rest));
        self.read(5)[4] == 0
    }

    /// Whether the broker answers a ping.
    pub fn is_answered(&mut self) -> bool {
        self.send(&packet(0xc0, &[]));
        self.read(2) == [0xd0, 0]
    }

    /// Waits until the broker closes the connection.
    pub fn wait_for_close(mut self) {
        let mut rest = Vec::new();
        // A reset is an end as well.
        let _ = self.stream.read_to_end(&mut rest);
    }
}

/// A whole packet.
pub fn packet(kind: u8, rest: &[u8]) -> Vec<u8> {
    let mut bytes = vec![kind];
    let mut length = rest.len();
    loop {
        let more = if length > 127 { 0x80 } else { 0 };
        bytes.push((length % 128) as u8 | more);
        length /= 128;
        if length == 0 {
            break;
        }
    }
    bytes.extend_from_slice(rest);
    bytes
}

pub fn connect(client_id: &str) -> Vec<u8> {
    packet(0x10, &[&text("MQTT")[..], &[4, 2, 0, 0], &text(client_id)].concat())
}

/// A message without acknowledgement.
pub fn publish(topic: &str, payload: &[u8]) -> Vec<u8> {
    packet(0x30, &[&text(topic)[..], payload].concat())
}

/// A string with its length before it.
pub fn text(text: &str) -> Vec<u8> {
    [&(text.len() as u16).to_be_bytes()[..], text.as_bytes()].concat()
}

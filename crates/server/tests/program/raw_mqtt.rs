//! A client of MQTT that writes packets byte by byte, to send what no client library sends.

use std::io::{Read, Write};
use std::net::TcpStream;

use crate::DEADLINE;
pub use packets::{connect, packet, publish, subscribe, text};

#[path = "../../examples/common/packets.rs"]
mod packets;

pub struct RawMqtt {
    pub stream: TcpStream,
}

impl RawMqtt {
    /// Opens a connection without sending anything.
    pub fn silent(address: &str) -> Self {
        let stream = TcpStream::connect(address).unwrap();
        stream.set_read_timeout(Some(DEADLINE)).unwrap();
        Self { stream }
    }

    /// Connects and logs in without keep-alive.
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

    /// Reads the next packet: its first byte, and the bytes after its length. Panics if these are more than 127.
    pub fn read_packet(&mut self) -> (u8, Vec<u8>) {
        let header = self.read(2);
        assert!(header[1] < 128, "a packet of kind {:#x} is too long", header[0]);
        (header[0], self.read(header[1].into()))
    }

    /// Sends a subscription. Returns whether the broker granted it.
    pub fn subscribe(&mut self, filter: &str) -> bool {
        self.send(&subscribe(filter));
        self.read(5)[4] == 0
    }

    /// Sends a ping. Returns whether the broker answered it.
    pub fn is_answered(&mut self) -> bool {
        self.send(&packet(0xc0, &[]));
        self.read(2) == [0xd0, 0]
    }

    /// Waits until the broker closes the connection.
    pub fn wait_for_close(mut self) {
        let mut rest = Vec::new();
        // A reset of the connection counts as its end.
        let _ = self.stream.read_to_end(&mut rest);
    }
}

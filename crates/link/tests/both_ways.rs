//! Brokers that read slowly, because they write at the same time or have much to read.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};

use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent};

/// Number of messages: with `PAYLOAD` bytes each, more than the buffers of two sockets hold.
const MESSAGES: usize = 6000;
/// Length of a payload, bytes.
const PAYLOAD: usize = 2048;

/// A broker that accepts a client, writes many messages, and only then reads.
fn serve(listener: &TcpListener) {
    let (mut stream, _) = listener.accept().unwrap();
    let mut bytes = [0; 512];
    assert!(stream.read(&mut bytes).unwrap() > 0, "CONNECT");
    stream.write_all(&[0x20, 2, 0, 0]).unwrap();
    assert!(stream.read(&mut bytes).unwrap() > 0, "SUBSCRIBE");
    stream.write_all(&[0x90, 3, bytes[2], bytes[3], 0]).unwrap();
    let message = publish();
    for _ in 0..2 * MESSAGES {
        stream.write_all(&message).unwrap();
    }
    hear(&mut stream, MESSAGES * message.len());
    stream.write_all(&[0x30, 3, 0, 1, b'e']).unwrap();
    // Waits until the client closes the connection.
    let _ = stream.read(&mut bytes);
}

/// A message at QoS 0 to the topic `t`.
fn publish() -> Vec<u8> {
    let length = 3 + PAYLOAD;
    let head = [0x30, (length % 128) as u8 | 0x80, (length / 128) as u8, 0, 1, b't'];
    head.into_iter().chain([7; PAYLOAD]).collect()
}

fn hear(stream: &mut TcpStream, mut bytes: usize) {
    let mut buffer = [0; 65_536];
    while bytes > 0 {
        let wanted = bytes.min(buffer.len());
        let read = stream.read(&mut buffer[..wanted]).unwrap();
        assert!(read > 0, "the client left {bytes} bytes before the end");
        bytes -= read;
    }
}

#[tokio::test]
async fn a_flood_in_both_directions_breaks_no_connection() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let broker = std::thread::spawn(move || serve(&listener));
    let mut link = Link::open(LinkConfig {
        broker: BrokerUrl::new("127.0.0.1", port),
        client_id: "LightBot/controller".into(),
        filters: vec!["t".into()],
        queue: 4 * MESSAGES,
    });
    assert_eq!(link.next().await, Some(LinkEvent::Connected));
    let sender = link.sender();
    for _ in 0..MESSAGES {
        sender.send("t", vec![7; PAYLOAD]);
    }
    let mut heard = 0;
    loop {
        match link.next().await {
            Some(LinkEvent::Message { topic, .. }) if topic == "t" => heard += 1,
            Some(LinkEvent::Message { .. }) => break,
            other => panic!("after {heard} messages: {other:?}"),
        }
    }
    assert_eq!((heard, sender.dropped()), (2 * MESSAGES, 0));
    link.close().await;
    broker.join().unwrap();
}

/// Number of messages before a disconnect: with `PAYLOAD` bytes each, more than a socket's buffer holds.
const LAST_WORDS: usize = 6000;

#[tokio::test]
async fn what_is_said_before_the_end_gets_out() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let broker = std::thread::spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        let mut bytes = Vec::new();
        assert!(stream.read(&mut [0; 512]).unwrap() > 0, "CONNECT");
        stream.write_all(&[0x20, 2, 0, 0]).unwrap();
        stream.read_to_end(&mut bytes).unwrap();
        bytes
    });
    let mut link = Link::open(LinkConfig {
        broker: BrokerUrl::new("127.0.0.1", port),
        client_id: "LightBot/controller".into(),
        filters: Vec::new(),
        queue: 2 * LAST_WORDS,
    });
    assert_eq!(link.next().await, Some(LinkEvent::Connected));
    let sender = link.sender();
    for _ in 0..LAST_WORDS {
        assert!(sender.send("t", vec![7; PAYLOAD]));
    }
    link.close().await;
    let heard = broker.join().unwrap();
    assert_eq!(heard.len(), LAST_WORDS * publish().len() + 2);
    assert!(heard.ends_with(&[0xe0, 0]), "no goodbye");
}

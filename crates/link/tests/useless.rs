//! Brokers that accept the login but cannot be used.

use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};

use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent};

/// A minimal broker: accepts any login, and answers a subscription of two filters with these return codes, one for each
/// filter.
fn serve(listener: &TcpListener, granted: [u8; 2]) {
    while let Ok((mut stream, _)) = listener.accept() {
        let mut bytes = [0; 512];
        // CONNECT arrives first, then SUBSCRIBE. Each is one read, because the client sends nothing else meanwhile.
        if matches!(stream.read(&mut bytes), Ok(1..)) && stream.write_all(&[0x20, 2, 0, 0]).is_ok() {
            let _ = stream.read(&mut bytes);
            let _ = stream.write_all(&[0x90, 4, bytes[2], bytes[3], granted[0], granted[1]]);
            let _ = stream.read(&mut bytes);
        }
    }
}

/// Opens a link with two filters to brokers that answer with these codes. Returns the link and the brokers' addresses.
fn open(granted: [u8; 2], brokers: usize) -> (Link, Vec<String>) {
    let listeners: Vec<_> = (0..brokers).map(|_| TcpListener::bind("127.0.0.1:0").unwrap()).collect();
    let ports: Vec<u16> = listeners.iter().map(|listener| listener.local_addr().unwrap().port()).collect();
    for listener in listeners {
        std::thread::spawn(move || serve(&listener, granted));
    }
    let mut broker = BrokerUrl::new("127.0.0.1", ports[0]);
    broker.addresses = ports.iter().flat_map(|&port| BrokerUrl::new("127.0.0.1", port).addresses).collect();
    let link = Link::open(LinkConfig {
        broker,
        client_id: "LightBot/r7".into(),
        filters: vec!["T/LightBot/r7".into(), "T/LightBot/r8".into()],
        queue: 16,
    });
    (link, ports.iter().map(|port| format!("mqtt://127.0.0.1:{port}")).collect())
}

#[tokio::test]
async fn a_connection_of_no_use_is_left_for_the_next_address() {
    let (mut link, addresses) = open([0, 0], 2);
    assert_eq!(link.next().await, Some(LinkEvent::Connected));
    assert_eq!(link.sender().address_index(), 0);
    link.renew();
    let Some(LinkEvent::Disconnected { reason }) = link.next().await else { panic!("it stays") };
    assert!(reason.starts_with(&addresses[0]) && reason.contains("passes on nothing"), "{reason}");
    assert_eq!(link.next().await, Some(LinkEvent::Connected));
    assert_eq!(link.sender().address_index(), 1);
    link.close().await;
}

/// Accepts a client and answers its subscription.
fn let_in(listener: &TcpListener) -> TcpStream {
    let (mut stream, _) = listener.accept().unwrap();
    let mut bytes = [0; 512];
    let _ = stream.read(&mut bytes);
    let _ = stream.write_all(&[0x20, 2, 0, 0]);
    answer_subscription(&mut stream);
    stream
}

/// Reads the next packet, and grants it if it is a subscription of one filter. Returns whether it was a subscription.
fn answer_subscription(stream: &mut TcpStream) -> bool {
    let mut bytes = [0; 512];
    let subscribes = matches!(stream.read(&mut bytes), Ok(1..)) && bytes[0] == 0x82;
    subscribes && stream.write_all(&[0x90, 3, bytes[2], bytes[3], 0]).is_ok()
}

#[tokio::test]
async fn a_link_that_comes_back_subscribes_again_in_a_while() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    let (close, closed) = std::sync::mpsc::channel();
    let (tell, told) = tokio::sync::oneshot::channel();
    std::thread::spawn(move || {
        let first = let_in(&listener);
        let _ = closed.recv();
        drop(first);
        let _ = tell.send(answer_subscription(&mut let_in(&listener)));
    });
    let mut link = Link::open(LinkConfig {
        broker: BrokerUrl::new("127.0.0.1", port),
        client_id: "LightBot/r7".into(),
        filters: vec!["T/LightBot/r7".into()],
        queue: 16,
    });
    assert_eq!(link.next().await, Some(LinkEvent::Connected));
    close.send(()).unwrap();
    assert!(matches!(link.next().await, Some(LinkEvent::Disconnected { .. })));
    assert_eq!(link.next().await, Some(LinkEvent::Connected));
    assert!(told.await.unwrap(), "something else came");
    link.close().await;
}

#[tokio::test]
async fn a_refused_subscription_is_named_and_is_no_connection() {
    let (mut link, addresses) = open([0, 0x80], 1);
    let Some(LinkEvent::Disconnected { reason }) = link.next().await else { panic!("it is connected") };
    assert!(
        reason.contains("refuses the subscription to T/LightBot/r8") && reason.contains(&addresses[0]),
        "{reason}"
    );
    assert!(!link.sender().is_connected());
    link.close().await;
}

//! A broker that lets us in and refuses a subscription.

use std::io::{Read, Write};
use std::net::TcpListener;

use lightbots_link::{BrokerUrl, Link, LinkConfig, LinkEvent};

/// Just enough of a broker: it accepts every login and refuses the second filter.
fn serve(listener: &TcpListener) {
    while let Ok((mut stream, _)) = listener.accept() {
        let mut bytes = [0; 512];
        // CONNECT, then SUBSCRIBE, each in one piece because nothing else is under way.
        if matches!(stream.read(&mut bytes), Ok(1..)) && stream.write_all(&[0x20, 2, 0, 0]).is_ok() {
            let _ = stream.read(&mut bytes);
            let _ = stream.write_all(&[0x90, 4, bytes[2], bytes[3], 0, 0x80]);
            let _ = stream.read(&mut bytes);
        }
    }
}

#[tokio::test]
async fn a_refused_subscription_is_named_and_is_no_connection() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    std::thread::spawn(move || serve(&listener));
    let mut link = Link::open(LinkConfig {
        broker: BrokerUrl::new("127.0.0.1", port),
        client_id: "LightBot/r7".into(),
        filters: vec!["T/LightBot/r7".into(), "T/LightBot/r8".into()],
        queue: 16,
    });
    let Some(LinkEvent::Disconnected { reason }) = link.next().await else { panic!("it is connected") };
    let place = format!("mqtt://127.0.0.1:{port}");
    assert!(
        reason.contains("refuses the subscription to T/LightBot/r8") && reason.contains(&place),
        "{reason}"
    );
    assert!(!link.sender().is_connected());
    link.close().await;
}

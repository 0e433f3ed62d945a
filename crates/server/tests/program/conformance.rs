//! Parts of MQTT that the embedded broker adds to rmqtt, as in Eclipse's interoperability tests. Section numbers are
//! those of MQTT 5.

use std::time::Duration;

use crate::child::Child;
use crate::plain_mqtt::Mqtt;
use crate::raw_mqtt::{RawMqtt, packet, text};
use crate::wait_for;

/// Starts a broker without users. Returns it with its address.
fn broker() -> (Child, String) {
    let mut process = Child::lightbots(&["broker", "--mqtt-listen", "127.0.0.1:0"]);
    let address = process.said("Broker mqtt://");
    (process, address)
}

/// Waits for the next message. Returns its topic and payload.
fn next(mqtt: &mut Mqtt) -> (String, String) {
    wait_for("a message", || mqtt.next())
}

/// Fields of CONNECT that a client of version 5 sends.
struct Login<'a> {
    is_clean: bool,
    keep_alive_s: u16,
    properties: &'a [u8],
}

/// A clean start without keep-alive and properties.
const PLAIN: Login<'static> = Login { is_clean: true, keep_alive_s: 0, properties: &[] };
/// Session Expiry Interval of 60 s (3.1.2.11.2).
const EXPIRY_60_S: &[u8] = &[0x11, 0, 0, 0, 60];

/// Connects a client of version 5. Returns it, whether the broker had its session, and the properties of CONNACK.
fn open(address: &str, client_id: &str, login: &Login) -> (RawMqtt, bool, Vec<u8>) {
    let mut client = RawMqtt::silent(address);
    let length = u8::try_from(login.properties.len()).unwrap();
    let header = [
        &text("MQTT")[..],
        &[5, u8::from(login.is_clean) << 1],
        &login.keep_alive_s.to_be_bytes(),
        &[length],
    ];
    client.send(&packet(0x10, &[&header.concat(), login.properties, &text(client_id)].concat()));
    let (kind, answer) = client.read_packet();
    assert_eq!((kind, answer[1]), (0x20, 0), "{client_id} is refused");
    (client, answer[0] == 1, answer[3..].to_vec())
}

/// Subscribes in version 5 with subscription identifier 7.
fn subscribe(client: &mut RawMqtt, filter: &str) {
    client.send(&packet(0x82, &[&[0, 1, 2, 0x0b, 7][..], &text(filter), &[0]].concat()));
    assert_eq!(client.read_packet(), (0x90, vec![0, 1, 0, 0]));
}

/// A message of version 5 with Topic Alias 1 (3.3.2.3.4).
fn publish_alias(topic: &str, payload: &[u8]) -> Vec<u8> {
    packet(0x30, &[&text(topic)[..], &[3, 0x23, 0, 1], payload].concat())
}

#[test]
fn retained_messages_reach_later_subscribers_until_they_are_removed() {
    let (_process, address) = broker();
    let tool = Mqtt::open(&address, "tool", &[]);
    tool.publish_retained("stage/light", "on");
    tool.publish_retained("stage/fog", "off");
    tool.publish_retained("stage/light", "dim");
    tool.publish_retained("stage/fog", "");
    tool.publish("stage/light", "off");
    // Messages of one connection are handled in order. When this message returns, those before it are handled.
    let mut echo = Mqtt::open(&address, "echo", &["done"]);
    tool.publish("done", "1");
    next(&mut echo);
    let mut later = Mqtt::open(&address, "later", &["stage/+"]);
    assert_eq!(next(&mut later), ("stage/light".into(), "dim".into()));
    tool.publish("stage/end", "");
    assert_eq!(next(&mut later).0, "stage/end");
}

#[test]
fn a_command_is_not_kept_for_robots_that_connect_later() {
    let (_process, address) = broker();
    let controller = Mqtt::open(&address, "BotControl/a", &[]);
    let mut here = Mqtt::open(&address, "LightBot/r1", &["T/LightBot/Broadcast"]);
    controller.publish_retained("T/LightBot/Broadcast", "|BLINK 3|");
    assert_eq!(next(&mut here).1, "|BLINK 3|");
    let mut later = Mqtt::open(&address, "LightBot/r2", &["T/LightBot/Broadcast"]);
    controller.publish("T/LightBot/Broadcast", "|UUID|");
    assert_eq!(next(&mut later).1, "|UUID|");
}

#[test]
fn a_shared_subscription_gives_each_message_to_one_client_in_turn() {
    let (_process, address) = broker();
    let filters = ["$share/group/work", "end"];
    let mut clients = [Mqtt::open(&address, "a", &filters), Mqtt::open(&address, "b", &filters)];
    let tool = Mqtt::open(&address, "tool", &[]);
    for number in 0..10 {
        tool.publish("work", number.to_string());
    }
    tool.publish("end", "");
    let mut done = Vec::new();
    for client in &mut clients {
        let work: Vec<String> =
            std::iter::from_fn(|| Some(next(client)).filter(|(topic, _)| topic == "work").map(|work| work.1))
                .collect();
        assert_eq!(work.len(), 5);
        done.extend(work);
    }
    done.sort();
    assert_eq!(done, (0..10).map(|number| number.to_string()).collect::<Vec<_>>());
    // A robot must receive every message for it, so it may not share a subscription in a group.
    assert!(!RawMqtt::open(&address, "LightBot/r7").subscribe("$share/group/T/LightBot/Broadcast"));
}

#[test]
fn a_session_without_an_expiry_ends_with_its_connection() {
    let (_process, address) = broker();
    let resume = |properties| open(&address, "a", &Login { is_clean: false, properties, ..PLAIN });
    // The first connection is still open while the second one takes over its session.
    let (_first, ..) = open(&address, "a", &PLAIN);
    let (_second, is_present, _) = resume(&[]);
    assert!(!is_present);
    let (mut third, is_present, _) = resume(EXPIRY_60_S);
    assert!(!is_present);
    subscribe(&mut third, "news");
    let (mut fourth, is_present, _) = resume(EXPIRY_60_S);
    assert!(is_present);
    // DISCONNECT ends the session, although the client leaves its connection open.
    fourth.send(&packet(0xe0, &[0, 5, 0x11, 0, 0, 0, 0]));
    fourth.send(&packet(0xc0, &[]));
    assert_eq!(fourth.read_packet().0, 0xd0);
    assert!(!resume(EXPIRY_60_S).1);
    // A clean session of version 3.1.1 ends with its connection too (section 3.1.2.4 of that version).
    let _clean = RawMqtt::open(&address, "b");
    let mut next = RawMqtt::silent(&address);
    next.send(&packet(0x10, &[&text("MQTT")[..], &[4, 0, 0, 0], &text("b")].concat()));
    assert_eq!(next.read(4), [0x20, 2, 0, 0]);
}

#[test]
fn a_client_that_lost_its_connection_is_let_in_again_at_once() {
    let (_process, address) = broker();
    // The pause varies, so that some logins come while the session is ending.
    for round in 0_u64..300 {
        let (client, ..) = open(&address, "a", &PLAIN);
        drop(client);
        std::thread::sleep(Duration::from_micros(10 * round));
    }
}

#[test]
fn topic_aliases_stand_for_topics_in_both_directions() {
    let (_process, address) = broker();
    // Topic Alias Maximum (3.1.2.11.5).
    let (mut client, _, answer) = open(&address, "a", &Login { properties: &[0x22, 0, 4], ..PLAIN });
    assert!(answer.windows(3).any(|property| property == [0x22, 0, 8]), "{answer:x?}");
    subscribe(&mut client, "news");
    // The message was published in version 3 without properties. So it has only alias and subscription identifier.
    let tool = Mqtt::open(&address, "tool", &[]);
    let mut received = Vec::new();
    for payload in ["1", "2"] {
        tool.publish("news", payload);
        received.push(client.read_packet().1);
    }
    let properties = [[0x23, 0, 1, 0x0b, 7], [0x0b, 7, 0x23, 0, 1]];
    for (message, (topic, payload)) in received.iter().zip([("news", b'1'), ("", b'2')]) {
        let topic = text(topic);
        assert!(message.starts_with(&topic) && message.ends_with(&[payload]), "{message:x?}");
        let rest = &message[topic.len()..message.len() - 1];
        assert!(rest[0] == 5 && properties.iter().any(|known| rest[1..] == *known), "{message:x?}");
    }
    let mut listener = Mqtt::open(&address, "listener", &["weather"]);
    client.send(&publish_alias("weather", b"rain"));
    client.send(&publish_alias("", b"sun"));
    for payload in ["rain", "sun"] {
        assert_eq!(next(&mut listener), ("weather".into(), payload.into()));
    }
}

#[test]
fn a_long_keep_alive_is_shortened_for_version_5_and_granted_to_version_3() {
    let (_process, address) = broker();
    // Server Keep Alive (3.2.2.3.14).
    for (asked, granted) in [(120, 60), (30, 30)] {
        let (_client, _, answer) = open(&address, "a", &Login { keep_alive_s: asked, ..PLAIN });
        assert!(answer.windows(3).any(|property| property == [0x13, 0, granted]), "{answer:x?}");
    }
    let mut client = RawMqtt::silent(&address);
    client.send(&packet(0x10, &[&text("MQTT")[..], &[4, 2, 0, 120], &text("b")].concat()));
    assert_eq!(client.read(4), [0x20, 2, 0, 0]);
}

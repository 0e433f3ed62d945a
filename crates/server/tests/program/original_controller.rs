//! Our robots under a controller that speaks only the original's protocol.

use std::collections::BTreeMap;

use crate::child::Child;
use crate::plain_mqtt::Mqtt;
use crate::{alone, run, wait_for};

/// Reads places of robots from reports `<uuid> <x> <y>` on a topic. Later fields are ignored.
fn read(mqtt: &mut Mqtt, topic: &str, places: &mut BTreeMap<String, (f64, f64)>) {
    while let Some((on, payload)) = mqtt.next() {
        if on != topic {
            continue;
        }
        let fields: Vec<&str> = payload.split(' ').collect();
        let number = |index: usize| fields.get(index).and_then(|field| field.parse::<f64>().ok());
        if let (Some(x), Some(y)) = (number(1), number(2))
            && x.is_finite()
            && y.is_finite()
        {
            places.insert(fields[0].to_owned(), (x, y));
        }
    }
}

#[test]
fn an_original_controller_drives_our_robots() {
    let _turn = alone();
    let (_server, _, broker) = run::start(&["--robots", "0"]);
    let mut robots = Child::lightbots(&["robots", "--count", "3", "--broker", &broker]);
    let topics = ["T/LightBot/UUID", "T/LightBot/Arrival"];
    let mut mqtt = Mqtt::open(&broker, "BotControl/0d8f3c1e-5a86-4d0e-9a39-d39c6c1a7c11", &topics);

    let mut found = BTreeMap::new();
    wait_for("three robots that know where they are", || {
        // As an operator does, the controller requests names again until all robots have answered.
        mqtt.publish("T/LightBot/Broadcast", "|UUID|");
        std::thread::sleep(std::time::Duration::from_millis(200));
        read(&mut mqtt, "T/LightBot/UUID", &mut found);
        (found.len() == 3).then_some(())
    });
    junk(&mqtt, &broker, found.keys().next().unwrap());

    // Numbers have decimal commas, as on some machines. Each target is straight ahead of its robot.
    let targets: BTreeMap<String, (f64, f64)> =
        found.iter().map(|(id, (x, y))| (id.clone(), (*x, y - 0.3))).collect();
    for (id, (x, y)) in &targets {
        let payload = format!("|TARGET {x:.6} {y:.6}||COLOR 16753920|").replace('.', ",");
        mqtt.publish(&format!("T/LightBot/{id}"), payload);
    }
    let mut arrived = BTreeMap::new();
    wait_for("three arrivals", || {
        read(&mut mqtt, "T/LightBot/Arrival", &mut arrived);
        (arrived.len() == 3).then_some(())
    });
    for (id, (x, y)) in &targets {
        let at = arrived[id];
        assert!((at.0 - x).abs() <= 0.021 && (at.1 - y).abs() <= 0.021, "{id} is at {at:?}, not at {x} {y}");
    }
    robots.terminate();
    assert_eq!(robots.end(), 0);
}

/// Publishes invalid messages of many kinds.
fn junk(mqtt: &Mqtt, broker: &str, robot: &str) {
    let own = format!("T/LightBot/{robot}");
    let topics = [
        "T/LightBot/UUID",
        "T/LightBot/Arrival",
        "T/LightBot/Status",
        "T/LightBot/Time",
        "T/LightBot/Broadcast",
        &own,
    ];
    for (number, topic) in topics.into_iter().enumerate() {
        mqtt.publish(topic, "");
        mqtt.publish(topic, vec![0xff, 0xfe, 0x00, b'|', 0xc3]);
        mqtt.publish(topic, vec![b'A'; 60_000]);
        // This payload is longer than a packet may be. It costs its own client the connection, and no other client.
        // The broker may close the connection before the client has sent the packet.
        Mqtt::open(broker, &format!("junk-{number}"), &[]).try_publish(topic, vec![b'A'; 1_000_000]);
        mqtt.publish(
            topic,
            "|TARGET||COLOR -1||PATH||START x y||TARGET NaN inf||COLOR 99999999999999999999|",
        );
    }
}

//! An MQTT client that shares no code with ours.

use std::sync::{Arc, Mutex};

use rumqttc::{Client, Event, MqttOptions, Packet, PublishOptions, QoS};

use crate::wait_for;

/// Topics and payloads in the order in which they arrived.
type Messages = Vec<(String, Vec<u8>)>;

pub struct Mqtt {
    client: Client,
    heard: Arc<Mutex<Messages>>,
    read: usize,
}

impl Mqtt {
    /// Connects to `address` (`host:port`) as the original's programs do, and subscribes.
    pub fn open(address: &str, client_id: &str, topics: &[&str]) -> Self {
        Self::open_as(address, client_id, ("default", "default"), topics)
    }

    /// Connects and subscribes as another user. Refused subscriptions count as answered.
    pub fn open_as(address: &str, client_id: &str, login: (&str, &str), topics: &[&str]) -> Self {
        let (host, port) = address.rsplit_once(':').unwrap();
        let mut options = MqttOptions::new(client_id, (host, port.parse::<u16>().unwrap()));
        options
            .set_keep_alive(60)
            .set_credentials(login.0, login.1.to_owned())
            .set_max_packet_size(8 << 20, 8 << 20);
        let (client, mut connection) = Client::builder(options).capacity(1000).build();
        let heard = Arc::new(Mutex::new(Messages::new()));
        let (keep, subscribed) = (heard.clone(), Arc::new(Mutex::new(0)));
        let count = subscribed.clone();
        std::thread::spawn(move || {
            for event in connection.iter() {
                match event {
                    Ok(Event::Incoming(Packet::Publish(message))) => {
                        let topic = String::from_utf8_lossy(&message.topic).into_owned();
                        keep.lock().unwrap().push((topic, message.payload.to_vec()));
                    }
                    Ok(Event::Incoming(Packet::SubAck(_))) => *count.lock().unwrap() += 1,
                    Ok(_) => {}
                    Err(_) => return,
                }
            }
        });
        for topic in topics {
            client.subscribe(*topic, QoS::AtMostOnce).unwrap();
        }
        wait_for("subscriptions", || (*subscribed.lock().unwrap() == topics.len()).then_some(()));
        Self { client, heard, read: 0 }
    }

    pub fn publish(&self, topic: &str, payload: impl Into<Vec<u8>>) {
        assert!(self.try_publish(topic, payload), "the connection of {topic}'s sender is gone");
    }

    /// Publishes a retained message, which the broker keeps for later subscribers.
    pub fn publish_retained(&self, topic: &str, payload: impl Into<Vec<u8>>) {
        self.client.publish(topic, payload.into(), PublishOptions::at_most_once().retained()).unwrap();
    }

    /// Publishes a message. Returns whether the connection still existed.
    pub fn try_publish(&self, topic: &str, payload: impl Into<Vec<u8>>) -> bool {
        self.client.publish(topic, payload.into(), PublishOptions::at_most_once()).is_ok()
    }

    /// The next message that has arrived, if any: topic and payload.
    pub fn next(&mut self) -> Option<(String, String)> {
        let heard = self.heard.lock().unwrap();
        let (topic, payload) = heard.get(self.read)?;
        let message = (topic.clone(), String::from_utf8_lossy(payload).into_owned());
        drop(heard);
        self.read += 1;
        Some(message)
    }
}

impl Drop for Mqtt {
    fn drop(&mut self) {
        let _ = self.client.disconnect();
    }
}

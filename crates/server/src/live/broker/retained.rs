//! Retained messages (MQTT 5, section 3.3.1.3): the last message of a topic that was published with the retain flag,
//! for clients that subscribe later. They are lost when the broker ends.
//!
//! Messages of the protocol are not kept. A robot that connects later would obey a command that was meant for a moment
//! long ago.

use std::num::NonZeroU32;
use std::str::FromStr;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use async_trait::async_trait;
use bytes::Bytes;
use rmqtt::net::Result;
use rmqtt::retain::{RetainStorage, RetainTree};
use rmqtt::types::{Retain, TimedValue, Topic, TopicFilter, TopicName};

use super::limits;
use super::notices::Notices;
use super::queues::size;
use super::rights::is_protocol;

/// The retained messages of a broker.
pub struct Retained {
    kept: Mutex<Kept>,
    notices: Arc<Notices>,
}

/// Messages by topic.
#[derive(Default)]
struct Kept {
    tree: RetainTree<TimedValue<Retain>>,
    count: usize,
    bytes: usize,
}

impl Retained {
    /// A store without messages.
    pub fn new(notices: Arc<Notices>) -> Self {
        Self { kept: Mutex::default(), notices }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    /// Stores a message. An earlier message with the same topic is removed in any case. A message with an empty payload is
    /// not stored. Returns false if there is no room.
    fn set(&mut self, topic: &Topic, mut retain: Retain) -> bool {
        if let Some(old) = self.tree.remove(topic) {
            self.count -= 1;
            self.bytes -= size(&old.value().publish);
        }
        if retain.publish.payload.is_empty() {
            return true;
        }
        let bytes = size(&retain.publish);
        if !self.has_room(bytes) {
            self.forget_expired();
            if !self.has_room(bytes) {
                return false;
            }
        }
        // A copy, because the payload is a slice of a buffer with everything that was read together with it.
        retain.publish.inner.payload = Bytes::copy_from_slice(&retain.publish.inner.payload);
        let properties = retain.publish.inner.properties.as_ref();
        let expiry = properties.and_then(|properties| properties.message_expiry_interval);
        let expiry = expiry.map(|seconds| Duration::from_secs(seconds.get().into()));
        self.tree.insert(topic, TimedValue::new(retain, expiry));
        self.count += 1;
        self.bytes += bytes;
        true
    }

    fn has_room(&self, bytes: usize) -> bool {
        self.count < limits::RETAINED && self.bytes + bytes <= limits::RETAINED_BYTES
    }

    fn forget_expired(&mut self) {
        let (mut count, mut bytes) = (0, 0);
        self.tree.retain(usize::MAX, |message| {
            if message.is_expired() {
                return false;
            }
            count += 1;
            bytes += size(&message.value().publish);
            true
        });
        (self.count, self.bytes) = (count, bytes);
    }

    /// Returns the retained messages that match a filter. The expiry interval of a message that expires is set to the time
    /// that is left.
    fn matching(&self, filter: &Topic) -> Vec<(TopicName, Retain)> {
        let found = self.tree.matches(filter).into_iter().filter(|(_, message)| !message.is_expired());
        found
            .map(|(topic, message)| (TopicName::from(topic.to_string()), with_rest_of_time(message)))
            .collect()
    }
}

fn with_rest_of_time(message: TimedValue<Retain>) -> Retain {
    let rest = message.remaining().map(|rest| u32::try_from(rest.as_secs()).unwrap_or(u32::MAX));
    let mut retain = message.into_value();
    if let (Some(seconds), Some(properties)) = (rest, &mut retain.publish.inner.properties) {
        properties.message_expiry_interval = Some(NonZeroU32::new(seconds).unwrap_or(NonZeroU32::MIN));
    }
    retain
}

#[async_trait]
impl RetainStorage for Retained {
    fn enable(&self) -> bool {
        true
    }

    async fn set(&self, topic: &TopicName, retain: Retain, _: Option<Duration>) -> Result<()> {
        if is_protocol(topic) {
            return Ok(());
        }
        let client = retain.from.client_id.clone();
        if !self.lock().set(&Topic::from_str(topic)?, retain) {
            let client: String = client.chars().take(80).collect();
            let line = format!(
                "The broker does not retain a message of client {}: it has as many as it keeps ({} or {} KiB).",
                client.escape_debug(),
                limits::RETAINED,
                limits::RETAINED_BYTES >> 10
            );
            self.notices.say(&client, &line);
        }
        Ok(())
    }

    async fn get(&self, filter: &TopicFilter) -> Result<Vec<(TopicName, Retain)>> {
        let filter = Topic::from_str(filter)?;
        Ok(self.lock().matching(&filter))
    }

    async fn count(&self) -> isize {
        isize::try_from(self.lock().count).unwrap_or(isize::MAX)
    }

    async fn max(&self) -> isize {
        isize::try_from(limits::RETAINED).unwrap_or(isize::MAX)
    }
}

#[cfg(test)]
mod tests {
    use rmqtt::codec::types::{Publish, QoS};
    use rmqtt::types::{ClientId, From, Id};

    use super::*;

    fn message(topic: &str, bytes: usize) -> Retain {
        let publish = Publish {
            dup: false,
            retain: true,
            qos: QoS::AtMostOnce,
            topic: topic.into(),
            packet_id: None,
            payload: vec![b'x'; bytes].into(),
            properties: None,
        };
        let from = From::from_custom(Id::from(0, ClientId::from_static("a")));
        Retain { msg_id: None, from, publish: publish.into() }
    }

    fn set(kept: &mut Kept, topic: &str, bytes: usize) -> bool {
        kept.set(&Topic::from_str(topic).unwrap(), message(topic, bytes))
    }

    fn topics(kept: &Kept, filter: &str) -> Vec<String> {
        let found = kept.matching(&Topic::from_str(filter).unwrap());
        let mut topics: Vec<String> = found.into_iter().map(|(topic, _)| topic.to_string()).collect();
        topics.sort();
        topics
    }

    #[test]
    fn the_last_message_of_each_topic_is_kept_until_an_empty_one_removes_it() {
        let mut kept = Kept::default();
        assert!(set(&mut kept, "a/b", 1) && set(&mut kept, "a/b", 2) && set(&mut kept, "a/c", 3));
        assert_eq!(topics(&kept, "a/+"), ["a/b", "a/c"]);
        assert_eq!(kept.matching(&Topic::from_str("a/b").unwrap())[0].1.publish.payload.len(), 2);
        assert!(set(&mut kept, "a/b", 0));
        assert_eq!((topics(&kept, "#"), kept.count, kept.bytes), (vec!["a/c".to_owned()], 1, 6));
    }

    #[test]
    fn number_and_bytes_are_bounded_and_room_comes_back() {
        let mut kept = Kept::default();
        assert!((0..limits::RETAINED).all(|number| set(&mut kept, &format!("t/{number}"), 1)));
        assert!(!set(&mut kept, "one/more", 1) && set(&mut kept, "t/0", 1));
        assert!(set(&mut kept, "t/0", 0) && set(&mut kept, "one/more", 1));
        assert!(!set(&mut kept, "one/more", limits::RETAINED_BYTES));
        assert!((0..limits::RETAINED).all(|number| set(&mut kept, &format!("t/{number}"), 0)));
        assert_eq!((kept.count, kept.bytes), (0, 0));
    }

    #[test]
    fn an_expired_message_is_not_given_and_makes_room() {
        let mut kept = Kept::default();
        let topic = Topic::from_str("a").unwrap();
        kept.tree.insert(&topic, TimedValue::new(message("a", 9), Some(Duration::ZERO)));
        (kept.count, kept.bytes) = (limits::RETAINED, 10);
        assert_eq!(topics(&kept, "#"), Vec::<String>::new());
        assert!(set(&mut kept, "b", 1));
        assert_eq!((topics(&kept, "#"), kept.count, kept.bytes), (vec!["b".to_owned()], 1, 2));
    }

    #[test]
    fn messages_of_the_protocol_are_not_kept() {
        let retained = Retained::new(Arc::new(Notices::new().0));
        let runtime = tokio::runtime::Builder::new_current_thread().build().unwrap();
        runtime.block_on(async {
            for topic in ["T/LightBot/Broadcast", "T/LightBot/r7", "other"] {
                retained.set(&topic.into(), message(topic, 5), None).await.unwrap();
            }
            let kept = retained.get(&"#".into()).await.unwrap();
            assert_eq!(kept.iter().map(|(topic, _)| topic.as_ref()).collect::<Vec<&str>>(), ["other"]);
        });
    }
}

//! Remembers each robot's last payload on each topic. The robot's next payload usually differs from it in a few bytes,
//! and a log stores only these.

use super::record::RobotTopic;
use lightbots_base::RobotId;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, DefaultHasher};

/// Longest payload that is remembered, bytes; a longer payload is stored whole in the log.
const PAYLOAD_MAX: usize = 1_024;
/// Largest number of payloads that are remembered. It is more than the number of robots that a controller remembers by
/// default, times the number of their topics.
const SENDERS_MAX: usize = 100_000;

/// The last payload of each robot on each topic. Writer and reader of a log make the same changes to it, so numbers
/// mean the same for both.
#[derive(Debug, Default)]
pub(crate) struct Senders {
    number_of: HashMap<(RobotTopic, RobotId), usize, BuildHasherDefault<DefaultHasher>>,
    payloads: Vec<Vec<u8>>,
}

/// What a payload has in common with an earlier payload of the same robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Likeness {
    /// Number of the earlier payload, counted from 1; 0 if the payload is not remembered, and so was compared with
    /// none.
    pub like: u32,
    /// Number of bytes that both payloads have in common at the front.
    pub front: u16,
    /// Number of further bytes that both payloads have in common at the back.
    pub back: u16,
}

impl Senders {
    /// Compares a payload with the last payload of its robot on this topic, or with an empty one if it is the first.
    /// Remembers the new payload in place of the last one. A payload that is not to be remembered is compared with
    /// none.
    pub fn compare(&mut self, topic: RobotTopic, payload: &[u8]) -> Likeness {
        let unlike = Likeness { like: 0, front: 0, back: 0 };
        let Some(number) = self.number(topic, payload) else { return unlike };
        let before = &mut self.payloads[number];
        let front = before.iter().zip(payload).take_while(|(before, now)| before == now).count();
        let rest = before[front..].iter().rev().zip(payload[front..].iter().rev());
        let back = rest.take_while(|(before, now)| before == now).count();
        before.clear();
        before.extend_from_slice(payload);
        Likeness { like: number as u32 + 1, front: front as u16, back: back as u16 }
    }

    /// Restores a payload from its likeness to an earlier payload and its middle, and remembers it. `None` if the
    /// values are not valid, so that no writer can have stored them.
    pub fn restore(&mut self, topic: RobotTopic, likeness: Likeness, middle: &[u8]) -> Option<Vec<u8>> {
        let Likeness { like, front, back } = likeness;
        let mut payload = Vec::new();
        if like > 0 {
            // The first payload of a robot is compared with an empty one.
            let nothing = Vec::new();
            let before = self.payloads.get(like as usize - 1).unwrap_or(&nothing);
            payload.extend_from_slice(before.get(..front.into())?);
            payload.extend_from_slice(middle);
            payload.extend_from_slice(before.get(before.len().checked_sub(back.into())?..)?);
        } else {
            payload.extend_from_slice(middle);
        }
        if let Some(number) = self.number(topic, &payload) {
            self.payloads[number].clone_from(&payload);
        }
        Some(payload)
    }

    /// Returns the index in `payloads` for the robot and topic of a message; a new pair gets an empty payload. `None`
    /// if the payload is not to be remembered: it is too long, names no robot, or there are too many.
    fn number(&mut self, topic: RobotTopic, payload: &[u8]) -> Option<usize> {
        if payload.len() > PAYLOAD_MAX {
            return None;
        }
        let name = payload.split(|&byte| byte == b' ').next()?;
        let key = (topic, RobotId::new(core::str::from_utf8(name).ok()?)?);
        let count = self.payloads.len();
        match self.number_of.get(&key) {
            Some(&number) => Some(number),
            None if count >= SENDERS_MAX => None,
            None => {
                self.number_of.insert(key, count);
                self.payloads.push(Vec::new());
                Some(count)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn payloads_are_restored_from_what_differs() {
        let (mut writer, mut reader) = (Senders::default(), Senders::default());
        let long = format!("a {}", "0".repeat(2_000));
        let payloads = [
            "a 0.5 1.3 st=idle",
            "b 1 1",
            "a 0.5 1.4 st=idle",
            "a 0.5 1.4 st=idle",
            "",
            "a",
            &long,
            "ü",
            "a 0",
        ];
        let mut middles = Vec::new();
        for payload in payloads.map(str::as_bytes) {
            let likeness = writer.compare(RobotTopic::Status, payload);
            let middle = &payload[likeness.front.into()..payload.len() - usize::from(likeness.back)];
            middles.push(middle.len());
            let restored = reader.restore(RobotTopic::Status, likeness, middle);
            assert_eq!(restored.as_deref(), Some(payload));
        }
        assert_eq!(middles[2..4], [1, 0]);
        let none = Likeness { like: 1, front: 900, back: 0 };
        assert_eq!(reader.restore(RobotTopic::Status, none, b""), None);
        let none = Likeness { like: 9_000, front: 0, back: 7 };
        assert_eq!(reader.restore(RobotTopic::Time, none, b""), None);
    }
}

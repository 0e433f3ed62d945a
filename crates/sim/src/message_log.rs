//! Log of the messages that robots send in one step. Robots may take their steps in any order, but the receiver gets
//! the messages in ascending order of robots.

use core::ops::Range;

use lightbots_wire::Topic;

/// Messages of one step.
#[derive(Default)]
pub(crate) struct MessageLog {
    /// Robot, topic, and the range of the message's text in `texts`.
    messages: Vec<(usize, Topic, Range<usize>)>,
    texts: Vec<u8>,
}

impl MessageLog {
    /// Appends a message of a robot.
    pub fn push(&mut self, robot: usize, topic: Topic, text: &[u8]) {
        let begin = self.texts.len();
        self.texts.extend_from_slice(text);
        self.messages.push((robot, topic, begin..self.texts.len()));
    }

    /// Passes all messages to `receive` in ascending order of robots, and empties the log.
    pub fn drain(&mut self, receive: &mut impl FnMut(usize, Topic, &[u8])) {
        // A stable sort keeps the order of each robot's messages.
        self.messages.sort_by_key(|message| message.0);
        for (robot, topic, text) in self.messages.drain(..) {
            receive(robot, topic, &self.texts[text]);
        }
        self.texts.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_come_in_order_of_robots_and_of_each_robot() {
        let mut log = MessageLog::default();
        for _ in 0..2 {
            for (robot, text) in [(7, "a"), (7, "bc"), (3, ""), (0, "d"), (0, "e")] {
                log.push(robot, Topic::Status, text.as_bytes());
            }
            let mut received = Vec::new();
            log.drain(&mut |robot, _, text| received.push((robot, text.to_vec())));
            let expected = [(0, "d"), (0, "e"), (3, ""), (7, "a"), (7, "bc")];
            assert_eq!(received, expected.map(|(robot, text)| (robot, text.as_bytes().to_vec())));
        }
    }
}

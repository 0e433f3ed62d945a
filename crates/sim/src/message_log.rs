//! What robots said that did not take turns in their order, to be heard in it.

use core::ops::Range;

use lightbots_wire::Topic;

/// Messages of one step.
#[derive(Default)]
pub(crate) struct MessageLog {
    /// Robot, topic, and where its text lies in `texts`.
    messages: Vec<(usize, Topic, Range<usize>)>,
    texts: Vec<u8>,
}

impl MessageLog {
    /// A robot says something.
    pub fn push(&mut self, robot: usize, topic: Topic, text: &[u8]) {
        let begin = self.texts.len();
        self.texts.extend_from_slice(text);
        self.messages.push((robot, topic, begin..self.texts.len()));
    }

    /// Lets all of it be heard, robot by robot, and forgets it.
    pub fn drain(&mut self, hear: &mut impl FnMut(usize, Topic, &[u8])) {
        // Stable: what one robot says keeps its order.
        self.messages.sort_by_key(|message| message.0);
        for (robot, topic, text) in self.messages.drain(..) {
            hear(robot, topic, &self.texts[text]);
        }
        self.texts.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn robots_are_heard_in_their_order_and_each_in_its_own() {
        let mut said = MessageLog::default();
        for _ in 0..2 {
            for (robot, text) in [(7, "a"), (7, "bc"), (3, ""), (0, "d"), (0, "e")] {
                said.push(robot, Topic::Status, text.as_bytes());
            }
            let mut heard = Vec::new();
            said.drain(&mut |robot, _, text| heard.push((robot, text.to_vec())));
            let expected = [(0, "d"), (0, "e"), (3, ""), (7, "a"), (7, "bc")];
            assert_eq!(heard, expected.map(|(robot, text)| (robot, text.as_bytes().to_vec())));
        }
    }
}

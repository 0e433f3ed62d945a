//! Messages on their way to participants. At most a given number of them (`window`) are open at once: sent and not
//! acknowledged. Reports acknowledge them, and a message is sent again until it is acknowledged.
//!
//! MQTT's quality of service 1 would do this between each client and the broker. It does not show whether the robot
//! took the message, and a broker that restarts forgets the message. The acknowledgement here therefore comes from the
//! robot itself.

use crate::mutant::Mutant;
use lightbots_base::{Instant, Span};
use std::collections::VecDeque;

/// One message for each participant, and which participants acknowledged it.
#[derive(Clone, Debug)]
pub(crate) struct Upload {
    /// Number of the routes, or of the stretch of light, that the messages contain; 0 for changes of light.
    pub number: u32,
    /// When the upload began.
    pub began: Instant,
    /// Whether an event has reported that no robot acknowledges its message.
    pub is_announced: bool,
    /// `[participant]`: the message to its robot.
    deliveries: Vec<Delivery>,
    /// The next participant for which no message was sent yet (an unserved one). Messages are sent in the order of
    /// participants.
    unserved: usize,
    /// Messages that were sent and may not be acknowledged yet: when each is to be sent again, and its participant. In
    /// the order of these moments; a message that its robot lost comes first.
    sent: VecDeque<(Instant, usize)>,
    /// Number of messages that were sent and not yet acknowledged.
    open: usize,
    /// Acknowledgements of messages that were sent only once.
    once: Answers,
    /// Acknowledgements of messages that were sent more than once.
    again: Answers,
}

/// The message to one participant.
#[derive(Clone, Copy, Debug, Default)]
struct Delivery {
    tries: u32,
    first_sent: Instant,
    acknowledged: bool,
}

/// Number of robots that acknowledged, and the longest time from the first sending to the acknowledgement.
#[derive(Clone, Copy, Debug, Default)]
struct Answers {
    count: usize,
    slowest: Span,
}

impl Upload {
    /// An upload whose messages are all still to be sent.
    pub fn new(number: u32, now: Instant, participants: usize) -> Self {
        Self {
            number,
            began: now,
            is_announced: false,
            deliveries: vec![Delivery::default(); participants],
            unserved: 0,
            sent: VecDeque::new(),
            open: 0,
            once: Answers::default(),
            again: Answers::default(),
        }
    }

    /// When the first of the sent messages may have to be sent again. `None` if no sent message is left.
    pub fn due(&self) -> Option<Instant> {
        self.sent.front().map(|(due, _)| *due)
    }

    /// Whether all messages were sent where needed, and all sent messages were acknowledged.
    pub fn is_done(&self) -> bool {
        self.open == 0 && self.unserved >= self.deliveries.len()
    }

    /// Whether some participants have not had their turn yet.
    pub fn has_unserved(&self) -> bool {
        self.unserved < self.deliveries.len()
    }

    /// Whether more than one message is open and none was ever acknowledged.
    pub fn is_unanswered(&self) -> bool {
        self.open > 1 && self.once.count + self.again.count == 0
    }

    /// How often the message to a participant was sent.
    pub fn tries(&self, participant: usize) -> u32 {
        self.deliveries[participant].tries
    }

    /// Takes the next overdue message from the list of sent ones and returns its participant. The search ends at the
    /// first message that is not due. Messages that need no repeat are removed on the way. `None` if none is overdue.
    pub fn next_overdue(&mut self, now: Instant, needs_none: impl Fn(usize) -> bool) -> Option<usize> {
        while let Some(&(due, participant)) = self.sent.front() {
            let settled = needs_none(participant) || self.deliveries[participant].acknowledged;
            if !settled && due > now {
                return None;
            }
            self.sent.pop_front();
            if !settled {
                return Some(participant);
            }
        }
        None
    }

    /// Returns the next participant that needs a message and was sent none yet, and counts its message as open. `None`
    /// if `window` messages are open or no participant is left.
    pub fn next_unserved(&mut self, window: usize, needs_none: impl Fn(usize) -> bool) -> Option<usize> {
        while self.has_unserved() && self.open < window {
            let participant = self.unserved;
            self.unserved += 1;
            if !needs_none(participant) {
                self.open += 1;
                return Some(participant);
            }
        }
        None
    }

    /// Notes that the message to a participant was sent. `due` is when it has to be sent again.
    pub fn record_sent(&mut self, now: Instant, participant: usize, due: Instant) {
        let delivery = &mut self.deliveries[participant];
        if delivery.tries == 0 {
            delivery.first_sent = now;
        }
        delivery.tries += 1;
        // A message that was tried often may wait for longer than those that are sent after it.
        let place = self.sent.partition_point(|&(before, _)| before <= due);
        self.sent.insert(place, (due, participant));
    }

    /// Measures the answer time of a participant from `now` on, because its wait until now says nothing about the link.
    pub fn restart_clock(&mut self, now: Instant, participant: usize) {
        self.deliveries[participant].first_sent = now;
    }

    /// Notes that a participant acknowledged its message. Returns `false` if nothing was sent to it, or if it had
    /// acknowledged before.
    pub fn acknowledge(&mut self, now: Instant, participant: usize) -> bool {
        let Some(delivery) = self.deliveries.get_mut(participant) else { return false };
        let is_overlooked = Mutant::DropAcknowledgement.is_planted() && participant == 6;
        if delivery.acknowledged || delivery.tries == 0 || is_overlooked {
            return false;
        }
        delivery.acknowledged = true;
        let answers = if delivery.tries == 1 { &mut self.once } else { &mut self.again };
        answers.count += 1;
        answers.slowest = answers.slowest.max(now - delivery.first_sent);
        self.open = self.open.saturating_sub(1);
        true
    }

    /// Makes the message to a participant due at once, because the robot lost what it had acknowledged. Does nothing if
    /// the participant has not acknowledged.
    pub fn reopen(&mut self, now: Instant, participant: usize) {
        let Some(delivery) = self.deliveries.get_mut(participant) else { return };
        if std::mem::take(&mut delivery.acknowledged) {
            self.open += 1;
            self.sent.push_front((now, participant));
        }
    }

    /// The longest time to an acknowledgement. By Karn's rule only messages that were sent once count. If more were
    /// sent again than once, the link is slow rather than lossy, and the repeated messages count instead. Otherwise a
    /// slow link would never be measured.
    pub fn slowest(&self) -> Span {
        if self.again.count > self.once.count { self.again.slowest } else { self.once.slowest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Time after which a message is sent again.
    const AFTER: Span = Span(100);

    /// Serves all that may be served at `now`.
    fn serve(upload: &mut Upload, now: Instant, window: usize) -> Vec<usize> {
        let mut served = Vec::new();
        while let Some(participant) = upload.next_unserved(window, |_| false) {
            upload.record_sent(now, participant, now + AFTER);
            served.push(participant);
        }
        served
    }

    #[test]
    fn no_more_are_open_than_the_window_holds() {
        let mut upload = Upload::new(7, Instant(0), 3);
        assert_eq!(serve(&mut upload, Instant(0), 2), [0, 1]);
        assert!(upload.acknowledge(Instant(10), 0) && !upload.acknowledge(Instant(11), 0));
        assert_eq!(serve(&mut upload, Instant(20), 2), [2]);
        assert!(upload.acknowledge(Instant(30), 1) && upload.acknowledge(Instant(40), 2));
        assert!(upload.is_done() && upload.slowest() == Span(30));
    }

    #[test]
    fn what_is_not_acknowledged_is_sent_again() {
        let mut upload = Upload::new(7, Instant(0), 2);
        serve(&mut upload, Instant(0), 9);
        assert!(upload.is_unanswered());
        assert_eq!(upload.next_overdue(Instant(99), |_| false), None);
        assert_eq!(upload.next_overdue(Instant(100), |_| false), Some(0));
        upload.record_sent(Instant(100), 0, Instant(200));
        assert_eq!((upload.tries(0), upload.next_overdue(Instant(100), |one| one == 1)), (2, None));
        assert_eq!(upload.due(), Some(Instant(200)), "the second needs none");
    }

    #[test]
    fn a_message_with_a_long_wait_does_not_delay_the_others() {
        let mut upload = Upload::new(7, Instant(0), 2);
        upload.record_sent(Instant(0), 0, Instant(400));
        upload.record_sent(Instant(10), 1, Instant(110));
        assert_eq!(upload.next_overdue(Instant(110), |_| false), Some(1));
        assert_eq!(upload.due(), Some(Instant(400)));
    }

    #[test]
    fn a_robot_that_restarted_is_sent_to_at_once() {
        let mut upload = Upload::new(7, Instant(0), 1);
        serve(&mut upload, Instant(0), 9);
        upload.acknowledge(Instant(10), 0);
        upload.reopen(Instant(50), 0);
        assert!(!upload.is_done());
        upload.next_overdue(Instant(50), |_| false);
        upload.record_sent(Instant(50), 0, Instant(150));
        assert!(upload.acknowledge(Instant(60), 0) && upload.is_done());
    }
}

//! Answers the time questions of robots with the show clock, which is the controller's `now`.

use crate::outbox::SendQueue;
use lightbots_base::Instant;
use lightbots_wire::{Command, TimeAnswer, TimeQuestion, Topic};

/// Answers a robot's time question at once. The robot need not be known, because an answer does no harm and costs one
/// message.
pub(crate) fn answer(now: Instant, question: TimeQuestion, outbox: &mut SendQueue) {
    let answer = TimeAnswer { asked: question.asked, received: now, sent: now };
    outbox.send(Topic::Robot(question.id), &[Command::Time(answer)]);
}

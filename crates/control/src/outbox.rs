//! Messages waiting to be sent, and broadcasts that are sent several times because links lose some messages.

use lightbots_base::{Instant, Span};
use lightbots_lighting::LampSettings;
use lightbots_wire::{Command, Fade, Topic, encode};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Largest number of waiting messages; further messages are dropped and counted.
const WAITING_MAX: usize = 200_000;
/// Largest number of broadcasts that are being repeated; a further broadcast is sent only once.
const REPEATS_MAX: usize = 8;

/// One message to publish.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Send {
    /// Topic to publish on.
    pub topic: Topic,
    /// Content, UTF-8 text.
    pub payload: Vec<u8>,
}

/// A broadcast that is to be sent again.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Repeat {
    payload: Vec<u8>,
    next: Instant,
    every: Span,
    left: u32,
}

/// The queue of messages to the broker.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct SendQueue {
    /// Correction for the lamps of the robots.
    lamp: LampSettings,
    #[serde(skip)]
    waiting: VecDeque<Send>,
    repeats: Vec<Repeat>,
    /// Latest moment that a HOLD broadcast has named, show clock.
    last_hold: Instant,
    #[serde(skip)]
    text: String,
    linked: bool,
    /// Number of messages that were taken to be published.
    pub sent: u64,
    /// Number of messages that were dropped, because the queue was full or the broker was not connected.
    pub unsent: u64,
}

impl SendQueue {
    /// Returns an empty queue; the broker is not connected yet. `lamp`: correction for the lamps of the robots.
    pub fn new(lamp: LampSettings) -> Self {
        Self { lamp, ..Self::default() }
    }

    /// Notes whether the broker is connected. When the broker is lost, drops all waiting messages and repetitions,
    /// because they would come too late.
    pub fn link(&mut self, up: bool) {
        self.linked = up;
        if !up {
            self.unsent += self.waiting.len() as u64;
            self.waiting.clear();
            self.repeats.clear();
        }
    }

    /// Whether the broker is connected.
    pub fn linked(&self) -> bool {
        self.linked
    }

    /// Whether no message waits to be published.
    pub fn is_drained(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Queues commands as one message on one topic. Without a broker or with a full queue, only counts the message as
    /// unsent. Corrects the colours of COLOR and FADE for the lamps. The colours in LIGHT commands are corrected
    /// earlier, before stretches of light are fitted.
    pub fn send(&mut self, topic: Topic, commands: &[Command]) {
        if self.linked && self.write(commands).is_err() {
            self.unsent += 1;
            return;
        }
        self.push(topic, self.text.as_bytes().to_vec());
    }

    /// Replaces `self.text` by the text of the commands, with colours corrected for the lamps.
    fn write(&mut self, commands: &[Command]) -> core::fmt::Result {
        self.text.clear();
        let Self { lamp, text, .. } = self;
        commands.iter().try_for_each(|command| match command {
            Command::Color(meant) => encode(&Command::Color(lamp.sent(*meant)), text),
            Command::Fade(fade) => encode(&Command::Fade(Fade { to: lamp.sent(fade.to), ..*fade }), text),
            other => encode(other, text),
        })
    }

    fn push(&mut self, topic: Topic, payload: Vec<u8>) {
        if !self.linked || self.waiting.len() >= WAITING_MAX {
            self.unsent += 1;
            return;
        }
        self.waiting.push_back(Send { topic, payload });
    }

    /// Queues a broadcast `times` times in all: now, and then at intervals of `every`. If [`REPEATS_MAX`] broadcasts
    /// are being repeated, or without a broker, it is not repeated.
    pub fn broadcast(&mut self, now: Instant, command: Command, times: u32, every: Span) {
        if let Command::Hold { at } = command {
            self.last_hold = self.last_hold.max(at);
        }
        let commands = std::slice::from_ref(&command);
        self.send(Topic::Broadcast, commands);
        if times > 1 && self.linked && self.repeats.len() < REPEATS_MAX && self.write(commands).is_ok() {
            let payload = self.text.as_bytes().to_vec();
            self.repeats.push(Repeat { payload, next: now + every, every, left: times - 1 });
        }
    }

    /// Earliest moment of a START that no HOLD sent before stops: robots keep a HOLD for later, also across STOP (R39).
    pub fn start_after_holds(&self) -> Instant {
        self.last_hold + Span(1)
    }

    /// Ends all repetitions of broadcasts.
    pub fn stop_repeating(&mut self) {
        self.repeats.clear();
    }

    /// Queues each broadcast whose repetition is due at `now`.
    pub fn tick(&mut self, now: Instant) {
        if self.repeats.is_empty() {
            return;
        }
        let mut repeats = std::mem::take(&mut self.repeats);
        for repeat in &mut repeats {
            if now >= repeat.next {
                self.push(Topic::Broadcast, repeat.payload.clone());
                repeat.next = now + repeat.every;
                repeat.left -= 1;
            }
        }
        repeats.retain(|repeat| repeat.left > 0);
        self.repeats = repeats;
    }

    /// Returns when the next repetition is due, show clock; `None` if there is none.
    pub fn due(&self) -> Option<Instant> {
        self.repeats.iter().map(|repeat| repeat.next).min()
    }

    /// Takes the next message to publish; `None` if none waits.
    pub fn next(&mut self) -> Option<Send> {
        let send = self.waiting.pop_front()?;
        self.sent += 1;
        Some(send)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Rgb;

    fn payloads(outbox: &mut SendQueue) -> Vec<String> {
        std::iter::from_fn(|| outbox.next()).map(|send| String::from_utf8(send.payload).unwrap()).collect()
    }

    #[test]
    fn a_broadcast_is_repeated_as_often_as_asked() {
        let mut outbox = SendQueue::default();
        outbox.link(true);
        outbox.broadcast(Instant::ZERO, Command::Stop, 3, Span(10));
        for us in [5, 10, 15, 20, 30] {
            outbox.tick(Instant(us));
        }
        assert_eq!(payloads(&mut outbox), ["|STOP|", "|STOP|", "|STOP|"]);
        assert_eq!(outbox.due(), None);
    }

    #[test]
    fn without_a_broker_nothing_waits() {
        let mut outbox = SendQueue::default();
        outbox.send(Topic::Broadcast, &[Command::Uuid]);
        outbox.link(true);
        outbox.broadcast(Instant::ZERO, Command::Stop, 3, Span(10));
        outbox.link(false);
        outbox.tick(Instant(50));
        assert!(payloads(&mut outbox).is_empty());
        assert_eq!(outbox.unsent, 2);
    }

    #[test]
    fn colours_leave_corrected_for_the_lamps() {
        let lamp = LampSettings { gain: [0.5, 1.0, 1.0], ..LampSettings::default() };
        let mut outbox = SendQueue::new(lamp);
        outbox.link(true);
        let fade = Fade { to: Rgb::new(255, 0, 0), at: Instant(7), over: Span(9) };
        outbox.send(
            Topic::Broadcast,
            &[Command::Color(Rgb::new(255, 9, 0)), Command::Fade(fade), Command::Uuid],
        );
        let mut text = String::new();
        let [color, to] = [Rgb::new(188, 9, 0), Rgb::new(188, 0, 0)];
        for command in [Command::Color(color), Command::Fade(Fade { to, ..fade }), Command::Uuid] {
            encode(&command, &mut text).unwrap();
        }
        assert_eq!(payloads(&mut outbox), [text]);
    }

    #[test]
    fn every_copy_of_a_broadcast_is_corrected_for_the_lamps() {
        let lamp = LampSettings { gain: [0.5, 1.0, 1.0], ..LampSettings::default() };
        let mut outbox = SendQueue::new(lamp);
        outbox.link(true);
        outbox.broadcast(Instant::ZERO, Command::Color(Rgb::new(255, 9, 0)), 3, Span(10));
        [10, 20].into_iter().for_each(|us| outbox.tick(Instant(us)));
        let copies = payloads(&mut outbox);
        let mut text = String::new();
        encode(&Command::Color(Rgb::new(188, 9, 0)), &mut text).unwrap();
        assert_eq!(copies, [text.clone(), text.clone(), text]);
    }
}

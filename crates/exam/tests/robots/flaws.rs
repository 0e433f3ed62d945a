//! Flaws of robots: changes to messages between the robot core and the network.

use lightbots_base::Instant;

use crate::bench::Message;

/// A change to received and sent messages.
pub trait Flaw {
    /// Handles a received message at `now` of the exam's clock. Returns what the core receives instead. `says` takes
    /// messages that are sent at once.
    fn hear(&mut self, now: Instant, message: Message, says: &mut Vec<Message>) -> Vec<Message> {
        let _ = (now, says);
        vec![message]
    }

    /// Handles a message from the core. Returns what is sent instead.
    fn say(&mut self, message: Message) -> Vec<Message> {
        vec![message]
    }
}

/// A robot without a fault.
pub struct Right;

impl Flaw for Right {}

/// A robot that knows only the original protocol.
pub struct Original;

impl Flaw for Original {
    fn hear(&mut self, _: Instant, message: Message, _: &mut Vec<Message>) -> Vec<Message> {
        vec![edit(message, |word, command| {
            let known = ["TARGET", "COLOR", "UUID"].contains(&word) && !command.contains("NaN");
            if known { command.to_owned() } else { String::new() }
        })]
    }

    fn say(&mut self, message: Message) -> Vec<Message> {
        if !on(&message, "UUID") && !on(&message, "Arrival") {
            return Vec::new();
        }
        let text = text(&message);
        vec![(message.0, text.split(' ').take(3).collect::<Vec<_>>().join(" ").into_bytes())]
    }
}

/// Changes received messages.
pub struct Hears<F>(pub F);

impl<F: FnMut(Instant, Message, &mut Vec<Message>) -> Vec<Message>> Flaw for Hears<F> {
    fn hear(&mut self, now: Instant, message: Message, says: &mut Vec<Message>) -> Vec<Message> {
        (self.0)(now, message, says)
    }
}

/// Changes sent messages.
pub struct Says<F>(pub F);

impl<F: FnMut(Message) -> Vec<Message>> Flaw for Says<F> {
    fn say(&mut self, message: Message) -> Vec<Message> {
        (self.0)(message)
    }
}

/// Changes received and sent messages.
pub struct Both<F, G>(pub F, pub G);

impl<F: FnMut(Message) -> Vec<Message>, G: FnMut(Message) -> Vec<Message>> Flaw for Both<F, G> {
    fn hear(&mut self, _: Instant, message: Message, _: &mut Vec<Message>) -> Vec<Message> {
        (self.0)(message)
    }

    fn say(&mut self, message: Message) -> Vec<Message> {
        (self.1)(message)
    }
}

/// A payload as text.
pub fn text(message: &Message) -> String {
    String::from_utf8_lossy(&message.1).into_owned()
}

/// Whether a message is on `T/LightBot/<name>`.
pub fn on(message: &Message, name: &str) -> bool {
    message.0 == format!("T/LightBot/{name}")
}

/// Rewrites each command of a payload. `change` gets the command's word and its text, and an empty result deletes the
/// command.
pub fn edit(message: Message, mut change: impl FnMut(&str, &str) -> String) -> Message {
    let Ok(text) = String::from_utf8(message.1.clone()) else { return message };
    if text.len() > 16 * 1024 {
        return message;
    }
    let edited: String = text
        .split('|')
        .map(|command| match command.split_ascii_whitespace().next() {
            Some(word) => format!("|{}|", change(word, command)),
            None => String::new(),
        })
        .collect();
    (message.0, edited.into_bytes())
}

/// A robot that never receives commands with this word.
pub fn deaf_to(word: &'static str) -> impl Flaw {
    Hears(move |_, message: Message, _: &mut Vec<Message>| {
        vec![edit(message, |found, command| if found == word { String::new() } else { command.to_owned() })]
    })
}

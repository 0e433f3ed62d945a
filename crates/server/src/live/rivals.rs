//! Detects other controllers on the same broker, because two controllers command robots by two clocks. Each controller
//! publishes its name and subscribes to the names and to the commands for all robots. A name or command that it did not
//! send is from another controller. If its own name stops coming back, the broker has stopped passing on its messages.

use std::collections::VecDeque;

use lightbots_base::{Instant, Span};

/// The topic on which our controllers publish their names. No robot subscribes to this topic, and no robot's name can result
/// in it.
pub const NAMES: &str = "T/LightBot/Controller/Here";
/// The topic of commands to all robots. Every controller uses it, also those of the original system.
pub const COMMANDS: &str = "T/LightBot/Broadcast";
/// Time between two publications of a controller's name.
const EVERY: Span = Span::from_millis(2_000);
/// Number of consecutive names without an echo that are tolerated. After one more, the broker counts as mute. Applies only
/// once the first echo has come.
const MUTE: u32 = 4;
/// Upper bound of the tolerated number of names. That number doubles each time the broker counts as mute, and is [`MUTE`]
/// again after an echo.
const MUTE_MOST: u32 = 32;
/// For each group of this many robots, one more name may stay without an echo. The robots' messages may delay or displace
/// the name.
const MUTE_PER: usize = 250;
/// Time after which an unreturned command of this controller is forgotten, when the controller sends the next one. An echo
/// that comes still later counts as the command of another controller.
const ECHO: Span = Span::from_millis(60_000);
/// Most commands whose echo is awaited. Beyond it, the oldest are forgotten.
const ECHOES: usize = 4_096;
/// Shortest time between two warnings of other controllers.
const AGAIN: Span = Span::from_millis(60_000);

/// What this controller has noticed of other controllers and of its own echoes.
#[derive(Debug)]
pub struct Rivals {
    name: String,
    /// Time of the show clock at which this controller publishes its name next.
    speak_at: Instant,
    /// Number of names published without an echo. It restarts with an echo, with a new connection, and when the broker
    /// counts as mute.
    unanswered: u32,
    /// Largest `unanswered` for which the broker does not count as mute. `None` until the first echo, because a broker may
    /// forbid the topic.
    mute_after: Option<u32>,
    /// Commands to all robots that have not come back, with the time of sending, oldest first. Echoes come in this order, so
    /// that each is usually found at the front.
    unheard: VecDeque<(Instant, Vec<u8>)>,
    told: Option<Instant>,
}

impl Rivals {
    /// State of a controller of this name, which must differ from the names of all other controllers.
    pub fn new(name: String) -> Self {
        Self {
            name,
            speak_at: Instant::ZERO,
            unanswered: 0,
            mute_after: None,
            unheard: VecDeque::new(),
            told: None,
        }
    }

    /// Time of the show clock from which [`Self::name_due`] returns the name again.
    pub fn speak_at(&self) -> Instant {
        self.speak_at
    }

    /// Returns the name to publish on [`NAMES`] if it is due, and counts it as published.
    pub fn name_due(&mut self, now: Instant) -> Option<&str> {
        if now < self.speak_at {
            return None;
        }
        self.speak_at = now + EVERY;
        self.unanswered += 1;
        Some(&self.name)
    }

    /// Whether the broker has stopped passing on this controller's messages. If so, `unanswered` restarts at 0. Its
    /// bound doubles, up to `MUTE_MOST`, to give a new connection a chance. `robots` is the number of robots on the
    /// broker.
    pub fn is_mute(&mut self, robots: usize) -> bool {
        let crowd = u32::try_from(robots / MUTE_PER).unwrap_or(u32::MAX);
        let is_patient = |after: &u32| self.unanswered <= after.saturating_add(crowd);
        let Some(after) = self.mute_after.filter(|after| !is_patient(after)) else { return false };
        self.mute_after = Some((after * 2).min(MUTE_MOST));
        self.unanswered = 0;
        true
    }

    /// Restarts the count for a new connection, because names published on an earlier one need not come back.
    pub fn connected(&mut self) {
        self.unanswered = 0;
    }

    /// Records a command that this controller sends to all robots, to recognise its echo.
    pub fn said(&mut self, now: Instant, payload: &[u8]) {
        let old = |(at, _): &(Instant, Vec<u8>)| now - *at > ECHO;
        while self.unheard.front().is_some_and(old) || self.unheard.len() >= ECHOES {
            self.unheard.pop_front();
        }
        self.unheard.push_back((now, payload.to_vec()));
    }

    /// Handles a message on [`NAMES`] or [`COMMANDS`]. Returns a warning if another controller sent it. Within `AGAIN` after
    /// a warning, returns `None`.
    pub fn hear(&mut self, now: Instant, topic: &str, payload: &[u8]) -> Option<String> {
        let own = if topic == NAMES { payload == self.name.as_bytes() } else { self.echoes(payload) };
        if own && topic == NAMES {
            self.unanswered = 0;
            self.mute_after = Some(MUTE);
        }
        if own || self.told.is_some_and(|told| now - told < AGAIN) {
            return None;
        }
        self.told = Some(now);
        let who =
            if topic == NAMES { String::from_utf8_lossy(payload) } else { "one that says no name".into() };
        let who: String = who.chars().filter(|letter| !letter.is_control()).take(60).collect();
        Some(format!(
            "Another controller is on this broker ({who}): robots get two clocks and the commands of both. Stop one of them."
        ))
    }

    /// Whether `payload` is the echo of a command of this controller. That command is then no longer awaited.
    fn echoes(&mut self, payload: &[u8]) -> bool {
        let at = self.unheard.iter().position(|(_, said)| said == payload);
        at.is_some_and(|at| self.unheard.remove(at).is_some())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(seconds: u64) -> Instant {
        Instant(seconds * 1_000_000)
    }

    #[test]
    fn its_own_words_come_back_once_each() {
        let mut rivals = Rivals::new("me".into());
        rivals.said(at(1), b"|UUID|");
        rivals.said(at(1), b"|START 3 9|");
        rivals.said(at(1), b"|START 3 9|");
        for own in [&b"|UUID|"[..], b"|START 3 9|", b"|START 3 9|"] {
            assert_eq!(rivals.hear(at(2), COMMANDS, own), None);
        }
        assert!(rivals.hear(at(2), COMMANDS, b"|UUID|").unwrap().contains("no name"));
    }

    #[test]
    fn another_name_is_spoken_of_now_and_then() {
        let mut rivals = Rivals::new("me".into());
        assert_eq!(rivals.name_due(at(1)), Some("me"));
        assert_eq!(rivals.name_due(at(2)), None);
        assert_eq!(rivals.speak_at(), at(3));
        assert_eq!(rivals.hear(at(1), NAMES, b"me"), None);
        assert!(rivals.hear(at(2), NAMES, b"y\nou").unwrap().contains("(you)"));
        assert_eq!(rivals.hear(at(50), NAMES, b"you"), None);
        assert!(rivals.hear(at(70), NAMES, b"you").is_some());
    }

    #[test]
    fn a_broker_that_brings_no_name_back_any_more_is_mute() {
        let mut rivals = Rivals::new("me".into());
        let mut time = 0;
        let mut speaks = |rivals: &mut Rivals, robots: usize| {
            let mut names = 0;
            while !rivals.is_mute(robots) && names < 100 {
                time += 2;
                names += u32::from(rivals.name_due(at(time)).is_some());
            }
            names
        };
        assert_eq!(speaks(&mut rivals, 30), 100, "one that never brought it back may have been told not to");
        rivals.connected();
        rivals.hear(at(300), NAMES, b"me");
        assert_eq!([speaks(&mut rivals, 30), speaks(&mut rivals, 30)], [MUTE + 1, 2 * MUTE + 1]);
        rivals.hear(at(900), NAMES, b"you");
        assert_eq!(speaks(&mut rivals, 30), 4 * MUTE + 1, "a name of another is no answer");
        rivals.hear(at(900), NAMES, b"me");
        assert_eq!(speaks(&mut rivals, 1_000), MUTE + 1 + 4, "a crowd may be louder");
    }

    #[test]
    fn what_never_comes_back_is_forgotten() {
        let mut rivals = Rivals::new("me".into());
        rivals.said(at(1), b"|UUID|");
        rivals.said(at(100), b"|STOP|");
        assert!(rivals.hear(at(100), COMMANDS, b"|UUID|").is_some());
        for _ in 0..2 * ECHOES {
            rivals.said(at(101), b"|STOP|");
        }
        assert_eq!(rivals.unheard.len(), ECHOES);
    }
}

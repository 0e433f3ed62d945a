//! Other controllers on the same broker. Two of them lead robots by two clocks and two minds, so each says that it is
//! there and listens: to what others of ours say of themselves, and to commands for all that it did not send itself.
//! By its own name coming back it also knows that the broker passes on what it says.

use std::collections::VecDeque;

use lightbots_base::{Instant, Span};

/// Where controllers of ours say their names. No robot listens there, and none can be called that.
pub const NAMES: &str = "T/LightBot/Controller/Here";
/// Where every controller, an original one as well, speaks to all robots.
pub const COMMANDS: &str = "T/LightBot/Broadcast";
/// How often a controller says that it is there.
const EVERY: Span = Span::from_millis(2_000);
/// A broker that returned this controller's name before, and then `MUTE` times running did not, is mute, …
const MUTE: u32 = 4;
/// … with more times after each new connection that did not help, up to `MUTE_MOST` times, …
const MUTE_MOST: u32 = 32;
/// … and one more time for each `MUTE_PER` robots, whose messages may delay the name or crowd it out.
const MUTE_PER: usize = 250;
/// How long the broker may take to bring back what this controller said.
const ECHO: Span = Span::from_millis(60_000);
/// Commands whose echo is waited for, at most; the oldest are forgotten.
const ECHOES: usize = 4_096;
/// A rival that is still there is spoken of again after this.
const AGAIN: Span = Span::from_millis(60_000);

/// What this controller knows of others.
#[derive(Debug)]
pub struct Rivals {
    name: String,
    /// When it says its name next.
    speak_at: Instant,
    /// How often it said its name since it came back, or since the connection began.
    unanswered: u32,
    /// How often it may; `None` until it came back once: a broker need not grant it.
    mute_after: Option<u32>,
    /// What it told all robots and has not come back, the oldest first. Echoes come in order, so that looking for one
    /// ends at once.
    unheard: VecDeque<(Instant, Vec<u8>)>,
    told: Option<Instant>,
}

impl Rivals {
    /// Of a controller of this name, which differs from all others'.
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

    /// When [`Self::name_due`] has something to say.
    pub fn speak_at(&self) -> Instant {
        self.speak_at
    }

    /// The name to say on [`NAMES`], where it is time for that.
    pub fn name_due(&mut self, now: Instant) -> Option<&str> {
        if now < self.speak_at {
            return None;
        }
        self.speak_at = now + EVERY;
        self.unanswered += 1;
        Some(&self.name)
    }

    /// Whether the broker passes on nothing any more of what is said to it. It is to be given another chance before
    /// this is asked again: the count starts anew. `robots` are on it.
    pub fn is_mute(&mut self, robots: usize) -> bool {
        let crowd = u32::try_from(robots / MUTE_PER).unwrap_or(u32::MAX);
        let is_patient = |after: &u32| self.unanswered <= after.saturating_add(crowd);
        let Some(after) = self.mute_after.filter(|after| !is_patient(after)) else { return false };
        self.mute_after = Some((after * 2).min(MUTE_MOST));
        self.unanswered = 0;
        true
    }

    /// A connection begins: names said on another one need not come back.
    pub fn connected(&mut self) {
        self.unanswered = 0;
    }

    /// This controller tells all robots something.
    pub fn said(&mut self, now: Instant, payload: &[u8]) {
        let old = |(at, _): &(Instant, Vec<u8>)| now - *at > ECHO;
        while self.unheard.front().is_some_and(old) || self.unheard.len() >= ECHOES {
            self.unheard.pop_front();
        }
        self.unheard.push_back((now, payload.to_vec()));
    }

    /// A message of a controller came in; a warning where it is not from this one, now and then.
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

    /// Whether this is what it said itself.
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

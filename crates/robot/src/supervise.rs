//! Supervision: a silent link and faults of sensors or motors stop the robot, whatever it was to do.

use lightbots_base::{Instant, Span};

/// How long a robot stands after a fault. Below, it drives on and off where a sensor fails again and again.
const FAULT: Span = Span::from_millis(1000);
/// Silence of the controller during a run after which the robot asks for the time. It must be shorter than the robot's
/// patience with the link (2 s). Above, a question that is lost cannot be repeated in time.
const QUIET: Span = Span::from_millis(1000);
/// Silence after which the link was out, whatever the robot does: its questions for the time, at most 3 s apart (R28), were
/// not answered. Below, robots that stand for long take all routes for old. Above, they turn towards one that is.
const OUTAGE: Span = Span::from_millis(3300);
/// Time between two such questions.
const ASK_AGAIN: Span = Span::from_millis(150);

/// A message that is older than this when it comes counts as this old. Below, robots on slow links stop one after the other.
/// Above, a robot whose clock is wrong, or whose link is very slow, stops where the link works.
const OLDEST: Span = Span::from_millis(300);

const _: () = assert!(ASK_AGAIN.0 < QUIET.0);

/// What the robot is doing, as far as the link matters to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drives {
    /// It stands and will not drive without a message.
    Not,
    /// To a target. Its controller may be an original one, which sends nothing meanwhile.
    Target,
    /// A route that will begin by itself.
    Soon,
    /// A route under way.
    Route,
}

/// Supervises link and sensors.
#[derive(Debug)]
pub(crate) struct Supervisor {
    silence: Span,
    heard: Instant,
    /// When the last START of the route under way left, or an answer after it, own clock. From then on no other message
    /// counts for that route: they reach each robot at another time.
    left: Option<Instant>,
    down_since: Option<Instant>,
    cut: bool,
    /// It was cut until the link came back, and has not reported that.
    untold: bool,
    faulty_until: Option<Instant>,
    asked: Instant,
}

impl Supervisor {
    pub(crate) fn new(silence: Span) -> Self {
        let start = Instant::ZERO;
        Self {
            silence,
            heard: start,
            left: None,
            down_since: None,
            cut: false,
            untold: false,
            faulty_until: None,
            asked: start,
        }
    }

    /// A message came in.
    pub(crate) fn receive(&mut self, now: Instant) {
        self.heard = now;
        self.down_since = None;
        self.cut = false;
    }

    /// The message that came in is `age` old. Robots whose link breaks at one moment fall silent together by that, however
    /// long their last message was on its way.
    pub(crate) fn date(&mut self, now: Instant, age: Span) {
        let left = Instant(now.0.saturating_sub(age.clamp(Span::ZERO, OLDEST).0.unsigned_abs()));
        self.left = self.left.max(Some(left));
    }

    /// Whether messages say when they left.
    pub(crate) fn is_dated(&self) -> bool {
        self.left.is_some()
    }

    /// Another route is under way: all messages count again.
    pub(crate) fn begin_route(&mut self) {
        self.left = None;
    }

    /// The link went up or down. A link that is up is no message: silence goes on.
    pub(crate) fn link(&mut self, now: Instant, up: bool) {
        if up {
            self.untold |= self.cut;
            (self.down_since, self.cut) = (None, false);
        } else if self.down_since.is_none() {
            self.down_since = Some(now);
        }
    }

    /// Whether the link is up.
    pub(crate) fn is_up(&self) -> bool {
        self.down_since.is_none()
    }

    /// Whether the link has been down for longer than the robot's patience.
    pub(crate) fn is_down(&self, now: Instant) -> bool {
        self.down_since.is_some_and(|since| now - since > self.silence)
    }

    /// Whether no message came for longer than the robot's patience.
    pub(crate) fn is_silent(&self, now: Instant) -> bool {
        now - self.heard > self.silence
    }

    /// Whether a message that comes now ends an outage.
    pub(crate) fn was_out(&self, now: Instant) -> bool {
        now - self.heard > OUTAGE
    }

    /// Cuts the robot off where the link is silent for too long for what the robot does. Whether it did so just now.
    pub(crate) fn check_link(&mut self, now: Instant, drives: Drives) -> bool {
        let down = self.is_down(now);
        let silent = now - self.left.unwrap_or(self.heard) > self.silence;
        let cuts = match drives {
            Drives::Not | Drives::Soon => false,
            Drives::Target => down,
            Drives::Route => down || silent,
        };
        let news = cuts && !self.cut;
        self.cut |= cuts;
        news
    }

    /// Whether to ask the controller because it is silent. The call notes the question.
    pub(crate) fn take_question(&mut self, now: Instant, drives: Drives) -> bool {
        let asks = matches!(drives, Drives::Soon | Drives::Route)
            && now - self.heard > QUIET
            && now - self.asked >= ASK_AGAIN;
        if asks {
            self.asked = now;
        }
        asks
    }

    /// A fault begins.
    pub(crate) fn fault(&mut self, now: Instant) {
        self.faulty_until = Some(now + FAULT);
    }

    /// Whether the robot stands because of a fault.
    pub(crate) fn faulty(&mut self, now: Instant) -> bool {
        self.faulty_until.take_if(|until| now >= *until);
        self.faulty_until.is_some()
    }

    /// Whether a fault is in force, as of the step before.
    pub(crate) fn is_faulty(&self) -> bool {
        self.faulty_until.is_some()
    }

    /// Whether the link has come back to one that was cut, once.
    pub(crate) fn take_untold(&mut self) -> bool {
        core::mem::take(&mut self.untold)
    }

    /// Whether it stands because the link was lost during a run.
    pub(crate) fn is_cut(&self) -> bool {
        self.cut
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: u64 = 1_000_000;

    #[test]
    fn silence_cuts_off_a_route_and_a_message_ends_it() {
        let mut supervisor = Supervisor::new(Span(2_000_000));
        supervisor.receive(Instant(SECOND));
        assert!(!supervisor.check_link(Instant(3 * SECOND), Drives::Route));
        assert!(!supervisor.check_link(Instant(9 * SECOND), Drives::Target));
        assert!(supervisor.check_link(Instant(3 * SECOND + 1), Drives::Route));
        assert!(!supervisor.check_link(Instant(3 * SECOND + 2), Drives::Route));
        assert!(supervisor.is_cut());
        supervisor.link(Instant(4 * SECOND), true);
        assert!(!supervisor.is_cut() && supervisor.check_link(Instant(4 * SECOND), Drives::Route));
        supervisor.receive(Instant(4 * SECOND));
        assert!(!supervisor.is_cut());
    }

    #[test]
    fn silence_counts_from_when_a_message_left_where_it_says_so() {
        let at = |ms: u64| Instant(ms * 1000);
        let silent_from = |ages_ms: &[i64]| {
            let mut supervisor = Supervisor::new(Span::from_millis(1900));
            for (place, age_ms) in ages_ms.iter().enumerate() {
                let now = at(5000 + 60 * place as u64);
                supervisor.receive(now);
                supervisor.date(now, Span::from_millis(*age_ms));
                // One that does not say when it left.
                supervisor.receive(now + Span::from_millis(30));
            }
            (5000..9000).find(|ms| supervisor.check_link(at(*ms), Drives::Route))
        };
        assert_eq!(silent_from(&[20]), Some(6881));
        assert_eq!(silent_from(&[20, 200]), Some(6881), "an older one changes nothing");
        assert_eq!(silent_from(&[20, 40]), Some(6921));
        assert_eq!(silent_from(&[-100]), Some(6901), "the clock is behind");
        assert_eq!(silent_from(&[90_000]), Some(6601), "the clock is wrong");
    }

    #[test]
    fn the_next_route_hears_all_messages_again() {
        let mut supervisor = Supervisor::new(Span::from_millis(1900));
        supervisor.date(Instant(SECOND), Span::ZERO);
        supervisor.receive(Instant(2 * SECOND));
        assert!(supervisor.check_link(Instant(3 * SECOND), Drives::Route));
        supervisor.receive(Instant(3 * SECOND));
        supervisor.begin_route();
        assert!(!supervisor.check_link(Instant(4 * SECOND), Drives::Route));
    }

    #[test]
    fn a_link_that_is_down_cuts_off_a_target_too() {
        let mut supervisor = Supervisor::new(Span(2_000_000));
        supervisor.link(Instant(SECOND), false);
        supervisor.link(Instant(2 * SECOND), false);
        assert!(!supervisor.check_link(Instant(3 * SECOND), Drives::Target));
        assert!(supervisor.check_link(Instant(3 * SECOND + 1), Drives::Target));
        supervisor.link(Instant(4 * SECOND), true);
        assert!(!supervisor.is_cut() && supervisor.is_up());
    }

    #[test]
    fn silence_is_broken_before_it_cuts() {
        let mut supervisor = Supervisor::new(Span(2_000_000));
        supervisor.receive(Instant(SECOND));
        let asked = (0..125u64)
            .filter(|n| supervisor.take_question(Instant(SECOND + n * 16_000), Drives::Soon))
            .count();
        assert!((6..=7).contains(&asked), "{asked}");
    }

    #[test]
    fn a_fault_passes() {
        let mut supervisor = Supervisor::new(Span(2_000_000));
        supervisor.fault(Instant(SECOND));
        assert!(supervisor.faulty(Instant(2 * SECOND - 1)));
        assert!(!supervisor.faulty(Instant(2 * SECOND)));
    }
}

//! Supervision of link and hardware: when an outage of the link ends a drive, and how long the robot stands after a
//! fault of sensors or motors.

use lightbots_base::{Instant, Span};

/// How long a robot stands after its latest fault. With a smaller value, a robot with a sensor that fails repeatedly
/// starts and stops repeatedly. With a larger value, a robot stands for long after a fault that is over.
const FAULT: Span = Span::from_millis(1000);
/// Time without a message on a route, or before a known start, after which the robot asks for the time to get an
/// answer. It must be shorter than `Config::silence` (1.9 s by default). With a larger value, a question that is lost
/// cannot be repeated in time.
const QUIET: Span = Span::from_millis(1000);
/// Time without a message after which the link counts as out, whatever the robot does. A robot asks for the time at
/// least every 3 s (R28 of docs/protocol.md), so at least one answer did not come. With a smaller value, robots that
/// stand for long take each new route for an old one. With a larger value, robots turn towards an old route after an
/// outage.
const OUTAGE: Span = Span::from_millis(3300);
/// Least time between two time questions because of a silence; periodic time questions do not count. With a smaller
/// value, a fleet floods its broker in a silence. With a larger value, too few questions go out before the silence cuts
/// the robot off.
const ASK_AGAIN: Span = Span::from_millis(150);

const _: () = assert!(ASK_AGAIN.0 < QUIET.0);

/// What the robot is driving, as far as it matters to the supervision of the link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Drives {
    /// Nothing: the robot stands or rolls out, and will not drive on without a message.
    Not,
    /// To a target. Its controller may be an original one, which sends no messages during the drive.
    Target,
    /// Nothing yet, but the START of its kept route has come: the route will begin without a further message.
    Soon,
    /// A route under way.
    Route,
}

/// Supervises link and sensors.
#[derive(Debug)]
pub(crate) struct Supervisor {
    silence: Span,
    heard: Instant,
    down_since: Option<Instant>,
    cut: bool,
    /// Whether the robot was cut off when the link came back, and has not reported this yet.
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
            down_since: None,
            cut: false,
            untold: false,
            faulty_until: None,
            asked: start,
        }
    }

    /// Notes that a message arrived at `now`, own clock. This ends a silence and a cut-off, and the link counts as up.
    pub(crate) fn receive(&mut self, now: Instant) {
        self.heard = now;
        self.down_since = None;
        self.cut = false;
    }

    /// Notes that the link went up or down at `now`, own clock. A link that goes up ends a cut-off but not a silence:
    /// only a message ends a silence.
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

    /// Whether the link has been down for longer than `Config::silence`.
    pub(crate) fn is_down(&self, now: Instant) -> bool {
        self.down_since.is_some_and(|since| now - since > self.silence)
    }

    /// Whether no message came for longer than `Config::silence`.
    pub(crate) fn is_silent(&self, now: Instant) -> bool {
        now - self.heard > self.silence
    }

    /// Whether no message came for longer than [`OUTAGE`].
    pub(crate) fn was_out(&self, now: Instant) -> bool {
        now - self.heard > OUTAGE
    }

    /// Cuts the robot off if the link has been down for longer than `Config::silence` on a drive to a target or on a
    /// route. On a route, it also cuts the robot off if no message came for as long. Returns whether the robot was cut
    /// off by this call.
    pub(crate) fn check_link(&mut self, now: Instant, drives: Drives) -> bool {
        let down = self.is_down(now);
        let silent = self.is_silent(now);
        let cuts = match drives {
            Drives::Not | Drives::Soon => false,
            Drives::Target => down,
            Drives::Route => down || silent,
        };
        let news = cuts && !self.cut;
        self.cut |= cuts;
        news
    }

    /// Returns whether the robot is to ask for the time now. It is if no message came for longer than [`QUIET`] on a
    /// route or before a known start. At least [`ASK_AGAIN`] lies between two such questions. If the result is `true`,
    /// the call counts as having asked.
    pub(crate) fn take_question(&mut self, now: Instant, drives: Drives) -> bool {
        let asks = matches!(drives, Drives::Soon | Drives::Route)
            && now - self.heard > QUIET
            && now - self.asked >= ASK_AGAIN;
        if asks {
            self.asked = now;
        }
        asks
    }

    /// Notes a fault at `now`, own clock: the robot stands for [`FAULT`].
    pub(crate) fn fault(&mut self, now: Instant) {
        self.faulty_until = Some(now + FAULT);
    }

    /// Whether the robot stands at `now` because of a fault.
    pub(crate) fn faulty(&mut self, now: Instant) -> bool {
        self.faulty_until.take_if(|until| now >= *until);
        self.faulty_until.is_some()
    }

    /// Whether the robot stood because of a fault at the last call of [`faulty`](Self::faulty), or a fault was noted
    /// since.
    pub(crate) fn is_faulty(&self) -> bool {
        self.faulty_until.is_some()
    }

    /// Returns whether the robot was cut off when the link came back, and has not reported this yet. The call clears
    /// the flag.
    pub(crate) fn take_untold(&mut self) -> bool {
        core::mem::take(&mut self.untold)
    }

    /// Whether the robot is cut off: it stopped during a drive because the link was down, or on a route because of a
    /// silence. It is no longer cut off once a message comes or the link goes up.
    pub(crate) fn is_cut(&self) -> bool {
        self.cut
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One second, microseconds.
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

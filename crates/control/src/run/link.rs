//! What is known of the link to the robots: how slow it is, how many messages it loses, when it came back.
//!
//! START, HOLD and RESUME are messages that name a moment at which robots begin, slow down to rest, or go on. Each is
//! sent ahead of its moment.
//!
//! The round-trip estimate is the largest round trip, lowered with each frame. RFC 6298 estimates a mean and a variance
//! instead, but a START has to wait for the slowest robot and not for the usual one.

use crate::config::Config;
use lightbots_base::{Instant, Span};

/// Time between two copies of START before its moment: six copies within the shortest lead of 240 ms.
pub(crate) const REPEAT: Span = Span::from_millis(40);
/// Time after which robots that did not confirm a START are asked again; one round trip if that is longer.
///
/// Both question and answer can be lost. With one message in ten lost, and time for two questions only, every second
/// START of 200 robots stayed unconfirmed and was postponed.
pub(crate) const ASK_AGAIN: Span = Span::from_millis(50);
/// Shortest time from sending HOLD or RESUME to the moment that it names. All copies are sent within the first 120 ms,
/// and the last copy has 30 ms to arrive.
const HOLD_LEAD: Span = Span::from_millis(150);
/// Longest time from sending HOLD to the moment that it names. With a larger value, robots drive on for too long
/// towards what blocks another robot. With a smaller one, on a slow link some robots receive HOLD late and slow down
/// later than others.
const HOLD_LEAD_MAX: Span = Span::from_millis(450);
/// Shortest time before the moment of a START at which the controller checks which robots have confirmed it. It is
/// enough to send a later moment to all.
const CHECK_AHEAD: Span = Span::from_millis(80);
/// Time that each robot adds to the lead of a START, because their reports share one link: 20 ms for 1,000 robots.
const LEAD_PER_ROBOT: Span = Span(20);
/// Largest value to which missing confirmations raise the round-trip estimate, because START does not wait for slower
/// links.
const ROUND_TRIP_MAX: Span = Span::from_millis(1_500);
/// Largest round trip that enters the estimate; a longer round trip counts as `MEASURED_MAX`. Without the bound, a
/// broker or a computer that slept for half a minute would delay each START by a minute. With a smaller value, shows in
/// simulated worlds that pause for 2.5 s lose robots.
const MEASURED_MAX: Span = Span::from_millis(3_000);
/// Largest time added to the lead of a START because messages are lost: nine times `ASK_AGAIN`, for nine questions.
const LOSS_MARGIN_MAX: Span = Span::from_millis(450);
/// After a reconnect, a broker cluster may need this long to restore subscriptions. Until then a robot that reports but
/// does not acknowledge is kept.
const RESTORES: Span = Span::from_millis(15_000);

/// What is known of the link to the robots.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LinkEstimate {
    /// Estimate of the longest time from a message to its acknowledgement. The estimate falls by a tenth at each frame.
    pub round_trip: Span,
    /// Estimate like `round_trip`, from measured times alone. Missing confirmations of a START raise only `round_trip`:
    /// they may come from dead or silent robots, which do not make a link slow.
    measured: Span,
    /// Time added to the lead of a START, because confirmations of earlier ones were lost.
    pub loss_margin: Span,
    /// When the run last went on after an interruption. `None` if the run was not interrupted.
    pub reconnected: Option<Instant>,
    /// When all robots were last asked for a report because some were silent.
    pub all_asked: Option<Instant>,
}

impl LinkEstimate {
    /// Least time from sending a START to its moment (its lead): time for all robots to receive and confirm it, and to
    /// postpone it.
    pub fn start_lead(&self, config: &Config, participants: usize) -> Span {
        let slow = self.round_trip * 2 + REPEAT;
        config.start_lead.max(slow) + self.loss_margin + LEAD_PER_ROBOT * participants as i64
    }

    /// How long before its moment HOLD is sent: the measured round trip, but at least `HOLD_LEAD` and at most
    /// `HOLD_LEAD_MAX`. HOLD is urgent, but robots that receive it after its moment slow down late.
    pub fn hold_lead(&self) -> Span {
        self.measured.clamp(HOLD_LEAD, HOLD_LEAD_MAX)
    }

    /// Whether robots may receive HOLD after its moment, because the measured round trip is longer than
    /// `HOLD_LEAD_MAX`.
    pub fn hold_may_be_late(&self) -> bool {
        self.measured > self.hold_lead()
    }

    /// Least time from sending RESUME to its moment, so that all robots receive it in time.
    pub fn resume_lead(&self) -> Span {
        self.round_trip.max(HOLD_LEAD)
    }

    /// How long before the moment of a START the controller checks whether all robots have confirmed it.
    pub fn check_ahead(&self) -> Span {
        CHECK_AHEAD.max(self.round_trip * 3 / 4)
    }

    /// For how long after `since` a robot that reports but does not acknowledge is kept: until `RESTORES` after the
    /// last interruption. Zero if that time is over or the run was never interrupted.
    pub fn patience(&self, since: Instant) -> Span {
        self.reconnected.map_or(Span::ZERO, |at| (at + RESTORES - since).max(Span::ZERO))
    }

    /// Takes in the time that a message took to be acknowledged.
    pub fn measure(&mut self, round_trip: Span) {
        let round_trip = round_trip.min(MEASURED_MAX);
        self.round_trip = self.round_trip.max(round_trip);
        self.measured = self.measured.max(round_trip);
    }

    /// Raises the round-trip estimate by half, to at most `ROUND_TRIP_MAX`, because many robots did not confirm a START
    /// in time.
    pub fn widen(&mut self) {
        self.round_trip = self.round_trip.max((self.round_trip * 3 / 2).min(ROUND_TRIP_MAX));
    }

    /// Adds to the loss margin, because a few robots did not confirm a START in time while the others did: messages are
    /// lost.
    pub fn add_loss_margin(&mut self) {
        self.loss_margin = (self.loss_margin + ASK_AGAIN * 3).min(LOSS_MARGIN_MAX);
    }

    /// Lowers all estimates by a tenth, because robots have reached a frame and old evidence counts less.
    pub fn fade(&mut self) {
        self.round_trip = self.round_trip * 9 / 10;
        self.measured = self.measured * 9 / 10;
        self.loss_margin = self.loss_margin * 9 / 10;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evidence_of_a_slow_or_lossy_link_is_bounded_and_fades() {
        let mut link = LinkEstimate::default();
        link.measure(Span::from_millis(200));
        (0..20).for_each(|_| {
            link.widen();
            link.add_loss_margin();
        });
        assert_eq!((link.round_trip, link.loss_margin), (ROUND_TRIP_MAX, LOSS_MARGIN_MAX));
        (0..60).for_each(|_| link.fade());
        assert!(link.round_trip < Span::from_millis(5) && link.loss_margin < Span::from_millis(5));
    }

    #[test]
    fn a_hold_is_stated_ahead_by_what_was_measured() {
        let mut link = LinkEstimate::default();
        assert_eq!(link.hold_lead(), HOLD_LEAD);
        link.measure(Span::from_millis(250));
        (0..20).for_each(|_| link.widen());
        assert_eq!((link.resume_lead(), link.hold_lead()), (ROUND_TRIP_MAX, Span::from_millis(250)));
        assert!(!link.hold_may_be_late());
        link.measure(Span::from_millis(30_000));
        assert_eq!((link.resume_lead(), link.hold_lead()), (MEASURED_MAX, HOLD_LEAD_MAX));
        assert!(link.hold_may_be_late());
    }

    #[test]
    fn a_broker_that_came_back_has_time_to_restore_subscriptions() {
        let mut link = LinkEstimate::default();
        assert_eq!(link.patience(Instant(0)), Span::ZERO);
        link.reconnected = Some(Instant(2_000_000));
        assert_eq!(link.patience(Instant(1_000_000)), Span::from_millis(16_000));
        assert_eq!(link.patience(Instant(30_000_000)), Span::ZERO);
    }
}

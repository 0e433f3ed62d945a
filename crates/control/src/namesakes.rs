//! Detects that two robots share a name. Sign one: reports alternate between two places, and no robot can have driven
//! between these in the time. Sign two: time questions follow two clocks.

use crate::own_clocks::OwnClocks;
use lightbots_base::{Instant, Span, Vec2};
use serde::{Deserialize, Serialize};

/// Largest speed between two reported places that counts as driven, metres per second. It is three times the usual
/// speed limit, because delayed reports arrive together.
const SPEED_MPS: f64 = 0.8;
/// Distance added to what a robot can have driven between two reports, metres: noise of position fixes, or a robot
/// moved by hand. Only a larger distance is a jump.
const SLACK_M: f64 = 0.3;
/// Number of jumps back and forth that show two robots. One jump can be a robot that was put elsewhere, and two jumps a
/// robot that was put back.
const JUMPS: u8 = 3;
/// Time within which the jumps are counted.
const WITHIN: Span = Span::from_millis(10_000);
/// Time without a sign of two robots after which the name counts as unique again, if also [`CLEAR_MESSAGES`] messages
/// came.
const CLEAR_AFTER: Span = Span::from_millis(30_000);
/// Number of messages since the last sign of two robots that must have come before the name counts as unique again.
/// Each robot asks for the time at least every 3 s (R28 of docs/protocol.md).
const CLEAR_MESSAGES: u32 = 12;
/// Two reported places closer than this are of one standing robot, metres: noise of position fixes.
const SAME_PLACE_M: f64 = 0.03;
/// A place counts as occupied if it was reported less than this time before the newest place of the name. A robot that
/// stands reports every 2 s (R41), and one of two reports may be lost.
const REPORTED_WITHIN: Span = Span::from_millis(4_500);

/// When a place was reported (show clock), and the place (stage metres).
type Sighting = (Instant, Vec2);

/// What the messages under one name show about whether two robots share the name.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Namesakes {
    last: Option<Sighting>,
    /// The place before the last jump: where the other robot of this name would be.
    other: Option<Sighting>,
    jumps: u8,
    first_jump: Instant,
    last_jump: Instant,
    clocks: OwnClocks,
    /// The two distinct places that were reported last under the name, each with the moment of its last report.
    standing: [Option<Sighting>; 2],
    /// Number of messages since the last sign of two robots.
    messages: u32,
    are_there: bool,
}

impl Namesakes {
    /// Whether two robots share the name.
    pub fn are_there(&self) -> bool {
        self.are_there
    }

    /// Returns up to two places from which robots of this name reported lately, stage metres.
    pub fn places(&self) -> Vec<Vec2> {
        let newest = self.standing.iter().flatten().map(|(at, _)| *at).max();
        let is_recent = |at: Instant| newest.is_some_and(|newest| newest - at < REPORTED_WITHIN);
        self.standing.iter().flatten().filter(|(at, _)| is_recent(*at)).map(|(_, place)| *place).collect()
    }

    /// Handles a time question; `asked`: moment of the question on the robot's own clock. Returns whether the question
    /// shows, for the first time, that two robots share the name.
    pub fn observe_clock(&mut self, now: Instant, asked: Instant) -> bool {
        self.messages = self.messages.saturating_add(1);
        self.clocks.observe(now, asked) && self.show(now)
    }

    /// Notes a sign of two robots. Returns `false` if it was known before that two robots share the name.
    fn show(&mut self, now: Instant) -> bool {
        (self.last_jump, self.messages) = (now, 0);
        !std::mem::replace(&mut self.are_there, true)
    }

    fn stand(&mut self, now: Instant, at: Vec2) {
        let is_here =
            |seen: &Option<Sighting>| seen.is_some_and(|(_, place)| place.distance(at) < SAME_PLACE_M);
        let [first, second] = &self.standing;
        let is_first_older = first.map(|seen| seen.0) < second.map(|seen| seen.0);
        let index = if is_here(first) { 0 } else { usize::from(is_here(second) || !is_first_older) };
        self.standing[index] = Some((now, at));
    }

    /// Handles a reported place, stage metres. Returns whether the place shows, for the first time, that two robots
    /// share the name.
    pub fn observe(&mut self, now: Instant, at: Vec2) -> bool {
        self.messages = self.messages.saturating_add(1);
        self.stand(now, at);
        let Some(last) = self.last.replace((now, at)) else { return false };
        if is_reachable(last, now, at) {
            return false;
        }
        let is_return = self.other.replace(last).is_some_and(|other| is_reachable(other, now, at));
        if !is_return || now - self.first_jump > WITHIN {
            (self.jumps, self.first_jump) = (0, now);
        }
        self.jumps = self.jumps.saturating_add(1);
        self.jumps >= JUMPS && self.show(now)
    }

    /// Returns whether the name has just become unique again. If so, all signs of two robots are forgotten.
    pub fn are_gone(&mut self, now: Instant) -> bool {
        let is_long = now - self.last_jump > CLEAR_AFTER && self.messages >= CLEAR_MESSAGES;
        let is_over = self.are_there && is_long;
        if is_over {
            *self = Self { last: self.last, ..Self::default() };
        }
        is_over
    }
}

fn is_reachable((since, from): Sighting, now: Instant, at: Vec2) -> bool {
    from.distance(at) <= SLACK_M + SPEED_MPS * (now - since).as_secs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(places: &[(f64, f64)]) -> Option<usize> {
        let mut namesakes = Namesakes::default();
        places
            .iter()
            .position(|(at_s, x)| namesakes.observe(Instant((at_s * 1e6) as u64), Vec2::new(*x, 0.0)))
    }

    #[test]
    fn two_robots_that_report_in_turn_share_a_name() {
        assert_eq!(found(&[(0.0, -1.0), (0.2, 1.0), (0.5, -0.9), (0.7, 1.1)]), Some(3));
    }

    #[test]
    fn a_robot_that_is_put_elsewhere_and_back_is_one() {
        assert_eq!(found(&[(0.0, -1.0), (0.2, 1.0), (0.5, 1.0), (0.7, -1.0), (0.9, -1.0)]), None);
        // Nor do two robots share the name if the reported place is wrong in a new way each time.
        assert_eq!(found(&[(0.0, 0.0), (0.2, 9.0), (0.4, 4.0), (0.6, 20.0), (0.8, 0.0), (1.0, 30.0)]), None);
    }

    #[test]
    fn a_robot_whose_reports_come_late_and_together_is_one() {
        // Four seconds at 0.27 m/s, a report each 0.5 s, all within 10 ms; one of them was lost.
        let late: Vec<_> =
            (0..8).filter(|step| *step != 4).map(|step| (9.0, 0.135 * f64::from(step))).collect();
        assert_eq!(found(&late), None);
    }

    #[test]
    fn the_name_is_free_again_when_one_of_them_has_gone() {
        let mut namesakes = Namesakes::default();
        for (at_ms, x) in [(0, -1.0), (200, 1.0), (400, -1.0), (600, 1.0)] {
            namesakes.observe(Instant(at_ms * 1_000), Vec2::new(x, 0.0));
        }
        assert!(namesakes.are_there() && namesakes.places().len() == 2);
        assert!(!namesakes.are_gone(Instant(31_000_000)), "none of them was heard since");
        for at_s in 2..20 {
            namesakes.observe(Instant(at_s * 2_000_000), Vec2::new(1.0, 0.0));
            assert_eq!(namesakes.are_gone(Instant(at_s * 2_000_000)), at_s == 16);
        }
        assert_eq!(namesakes.places().len(), 1);
        assert!(!namesakes.are_there() && !namesakes.are_gone(Instant(40_000_000)));
    }
}

//! Whether two delayed robots would touch each other if one of them stopped dead.

use crate::margins::COMFORT_M;
use crate::proof::stop_safe::{Law, STEP, StopAssumptions};
use lightbots_base::shape::point_to_segment;
use lightbots_base::{Limits, Span, Vec2};

/// Unit of delays, half a moment: each delay is a whole multiple of it.
pub(super) const LEVEL: Span = Span(STEP.0 / 2);
/// Cost of delays that bring two robots too close: more than any number of moments.
const CONTACT: u32 = 1 << 20;

pub(super) struct PairLaw<'a> {
    limits: &'a Limits,
    stop: Law,
    rest: Span,
}

impl<'a> PairLaw<'a> {
    pub fn new(limits: &'a Limits) -> Self {
        let assumed = StopAssumptions::default();
        Self { limits, stop: Law::new(limits, assumed), rest: Span::from_secs(assumed.alarm_s) }
    }

    /// Distance of two robots, metres, beyond which neither can affect the other during `within` and the time until the
    /// fleet rests after it.
    pub fn reach_m(&self, within: Span) -> f64 {
        self.limits.contact_m() + COMFORT_M + 2.0 * self.limits.speed_mps * (within + self.rest).as_secs()
    }

    /// Returns the number of moments from `between.0` to `between.1` at which one robot would touch the other after the
    /// other stopped dead. A moment counts twice if each would touch the other. `tracks`: places of both robots without
    /// delays at each moment. `levels`: their delays, in units of [`LEVEL`].
    ///
    /// Returns [`CONTACT`] if the delays bring the robots closer than the comfortable clearance and closer than without
    /// delays.
    pub fn cost(&self, tracks: (&[Vec2], &[Vec2]), levels: (u8, u8), between: (usize, usize)) -> u32 {
        let (one, other) = (Delayed::new(tracks.0, levels.0), Delayed::new(tracks.1, levels.1));
        let undelayed = (Delayed::new(tracks.0, 0), Delayed::new(tracks.1, 0));
        let most_m = self.limits.contact_m() + COMFORT_M;
        let closest_m = |one: &Delayed<'_>, other: &Delayed<'_>| {
            let apart = |moment: usize| one.at(moment) - other.at(moment);
            let steps = between.0..between.1;
            steps
                .map(|moment| point_to_segment(Vec2::ZERO, apart(moment), apart(moment + 1)))
                .fold(most_m, f64::min)
        };
        let is_moved = levels.0 != levels.1;
        if is_moved && closest_m(&one, &other) < closest_m(&undelayed.0, &undelayed.1) - 1e-9 {
            return CONTACT;
        }
        let moments = between.0..=between.1;
        moments.map(|moment| self.touches(&one, &other, moment) + self.touches(&other, &one, moment)).sum()
    }

    /// Returns 1 if `by` would touch `dead` after `dead` stopped dead at this moment, else 0.
    fn touches(&self, dead: &Delayed<'_>, by: &Delayed<'_>, moment: usize) -> u32 {
        let place = dead.at(moment);
        let far_m = self.limits.contact_m() + COMFORT_M + self.limits.speed_mps * self.rest.as_secs();
        if place.distance(by.at(moment)) > far_m || dead.rests() || by.rests() {
            return 0;
        }
        let braking = self.stop.judge(place, &|step| by.at(moment + step));
        u32::from(braking.is_some_and(|braking| braking.is_contact()))
    }
}

/// The places of a delayed robot at each moment: `track` has its places without the delay.
struct Delayed<'a> {
    track: &'a [Vec2],
    /// Delay of the robot, in units of [`LEVEL`].
    level: usize,
}

impl<'a> Delayed<'a> {
    fn new(track: &'a [Vec2], level: u8) -> Self {
        const { assert!(2 * LEVEL.0 == STEP.0) };
        Self { track, level: level.into() }
    }

    fn rests(&self) -> bool {
        self.track.first() == self.track.last()
    }

    fn at(&self, moment: usize) -> Vec2 {
        let Some(half) = (2 * moment).checked_sub(self.level) else { return self.track[0] };
        let last = self.track.len() - 1;
        let place = |moment: usize| self.track[moment.min(last)];
        let from = place(half / 2);
        if half.is_multiple_of(2) { from } else { from.lerp(place(half / 2 + 1), 0.5) }
    }
}

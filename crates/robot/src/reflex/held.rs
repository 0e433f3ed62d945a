//! Held back: it braked for what seemed to stand in its way, and looks whether that stands indeed.
//!
//! Readings are noisy, and so is what they say about how fast a gap closes: now and then a neighbour that drives on seems
//! to stand. Once the robot brakes the two come apart soon: one that stands is as much nearer as the robot drove since,
//! one that drives on is not. Who would brake on for nothing would be driven into by those behind.

use super::{Reflex, WIDENS_M, around};

/// Steps before the brake of which the mean says how near it was, and how long ago that was, in steps.
const BEFORE: core::ops::RangeInclusive<usize> = 1..=3;
const MIDDLE: usize = 2;
/// Differences less than this tell nothing, metres.
const TELLS_M: f32 = 0.002;

/// What holds it back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    pub sensor: usize,
    /// How fast it may drive, m/s.
    pub mps: f64,
    /// How near it was when the robot braked, and before, if it was in sight then, metres; see `Reflex::near_m`.
    near_m: [f32; 2],
    before_m: Option<[f32; 2]>,
    /// Cosine and sine of how far aside of the way it was.
    ahead: f32,
    aside: f32,
    /// How far the robot drove since then, and would have driven, in all and in each step, metres.
    driven_m: f32,
    wanted_m: f32,
    step_m: f32,
}

impl Held {
    /// How near it would be by now that was so near before, metres: if it stands, and if it drives as the robot would have.
    fn expected_m(&self, before_m: f32, contact_m: f32) -> [f32; 2] {
        let far_m = before_m + contact_m;
        let (ahead_m, aside_m) = (far_m * self.ahead - self.driven_m, far_m * self.aside);
        let drives_m = before_m + self.ahead * (self.wanted_m - self.driven_m);
        [libm::sqrtf(ahead_m * ahead_m + aside_m * aside_m) - contact_m, drives_m]
    }

    /// Whether it is so near now that it rather drives; `None`: that cannot be told.
    fn drives(&self, now_m: [f32; 2], contact_m: f32) -> Option<bool> {
        let expected = self.before_m?.map(|before_m| self.expected_m(before_m, contact_m));
        let tells = |[stands_m, drives_m]: [f32; 2]| drives_m - stands_m > 2.0 * TELLS_M;
        let drives = |(now_m, [stands_m, drives_m]): (f32, [f32; 2])| now_m > 0.5 * (stands_m + drives_m);
        expected.into_iter().all(tells).then(|| now_m.into_iter().zip(expected).all(drives))
    }
}

impl Reflex {
    /// It brakes now, or harder, for what a sensor sees, which allows it so much, m/s.
    pub(super) fn brake_for(&mut self, sensor: usize, mps: f64) {
        match &mut self.held {
            // What was seen before it braked tells most.
            Some(held) if around(sensor).contains(&held.sensor) => held.mps = mps,
            Some(_) => self.held = Some(self.hold(sensor, mps)),
            None => (self.held, self.count) = (Some(self.hold(sensor, mps)), 0),
        }
    }

    fn hold(&self, sensor: usize, mps: f64) -> Held {
        let seen = BEFORE.map(|ago| self.near_m(sensor, ago)).filter(|near| near[0].is_finite());
        let (sum_m, count) = seen
            .fold(([0.0; 2], 0u8), |(sum, count), near| ([sum[0] + near[0], sum[1] + near[1]], count + 1));
        let lately = &self.moves[..MIDDLE];
        let way_m: f32 = lately.iter().map(|way| way.0).sum();
        let step_m = lately.iter().fold(0.0, |most: f32, way| most.max(way.0.abs()));
        let (aside, ahead) = libm::sincosf(self.towards(sensor) as f32);
        Held {
            sensor,
            mps,
            near_m: self.near_m(sensor, 0),
            before_m: (count > 1).then_some(sum_m.map(|sum_m| sum_m / f32::from(count))),
            ahead: ahead.copysign(ahead * way_m),
            aside,
            driven_m: way_m.abs(),
            wanted_m: step_m * MIDDLE as f32,
            step_m,
        }
    }

    /// Whether what it braked for is farther away than when it braked, or drives on. To be asked at every step after that.
    pub(super) fn was_nothing(&self, held: &mut Held, contact_m: f32) -> bool {
        held.driven_m += self.moves[0].0.abs();
        held.wanted_m += held.step_m;
        let now_m = self.near_m(held.sensor, 0);
        let widened = now_m.iter().zip(held.near_m).all(|(&now_m, then_m)| now_m > then_m + WIDENS_M);
        held.drives(now_m, contact_m).unwrap_or(widened)
    }
}

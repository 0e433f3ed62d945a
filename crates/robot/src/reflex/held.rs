//! Held back: it braked for what seemed to stand in its way, and looks whether that stands indeed.
//!
//! Readings are noisy, and so is what they say about how fast a gap closes: now and then a neighbour that drives on seems
//! to stand. Once the robot brakes the two come apart soon: one that stands is as much nearer as the robot drove since,
//! one that drives on is not. Who would brake on for nothing would be driven into by those behind.

use super::{Reflex, WIDENS_M, around};

/// Steps before the brake of which the mean says how near it was, and how long ago that was, in steps.
const BEFORE: core::ops::RangeInclusive<usize> = 1..=3;
const MIDDLE: usize = 2;
/// Share of the way driven by which what a sensor ahead or 45° beside sees comes nearer if it stands; one abeam hardly
/// does.
const SHARE: [f32; 2] = [1.0, 0.75];
/// Differences less than this tell nothing, metres.
const TELLS_M: f32 = 0.002;

/// What holds it back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held {
    pub sensor: usize,
    /// How fast it may drive, m/s.
    pub mps: f64,
    /// How near it was when the robot braked, see `Reflex::near_m`.
    near_m: [f32; 2],
    /// How near it was before, if it was in sight then, and how far the robot drove and would have driven since.
    before_m: Option<f32>,
    driven_m: f32,
    wanted_m: f32,
    /// How far it would have driven in each step.
    step_m: f32,
    share: f32,
}

impl Reflex {
    /// It brakes now for what a sensor sees, `turn` sensors aside of its way, which allows it so much, m/s.
    pub(super) fn hold(&self, sensor: usize, turn: usize, mps: f64) -> Held {
        let seen = BEFORE.map(|ago| self.says_m(sensor, ago)).filter(|gap| gap.is_finite());
        let (sum_m, count) = seen.fold((0.0, 0u8), |(sum, count), gap| (sum + gap, count + 1));
        let step_m = self.moves[..MIDDLE].iter().fold(0.0, |most: f32, way| most.max(way.0.abs()));
        Held {
            sensor,
            mps,
            near_m: self.near_m(sensor),
            before_m: (count > 1 && turn < SHARE.len()).then_some(sum_m / f32::from(count)),
            driven_m: self.moves[..MIDDLE].iter().map(|way| way.0.abs()).sum(),
            wanted_m: step_m * MIDDLE as f32,
            step_m,
            share: SHARE[turn.min(SHARE.len() - 1)],
        }
    }

    /// Whether what it braked for is farther away than when it braked, or drives on. To be asked at every step after that.
    pub(super) fn was_nothing(&self, held: &mut Held) -> bool {
        held.driven_m += self.moves[0].0.abs();
        held.wanted_m += held.step_m;
        let half_m = 0.5 * held.share * held.wanted_m;
        if let Some(before_m) = held.before_m
            && half_m > TELLS_M
        {
            return self.says_m(held.sensor, 0) > before_m - held.share * held.driven_m + half_m;
        }
        let now_m = self.near_m(held.sensor);
        now_m.iter().zip(held.near_m).all(|(&now_m, then_m)| now_m > then_m + WIDENS_M)
    }

    /// The least that a sensor and those beside it said so many steps ago.
    pub(super) fn says_m(&self, sensor: usize, ago: usize) -> f32 {
        around(sensor).iter().map(|&sensor| self.past_m[ago][sensor]).fold(f32::INFINITY, f32::min)
    }
}

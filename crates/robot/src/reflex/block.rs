//! What blocks a robot: where it is, when it has gone, and how the robot makes room to drive around it.

use super::{Reflex, SENSORS, around};

/// Sine of the angle between the middle of two sensors and what both see, for each metre by which one sees it nearer:
/// for discs of 27 mm with their rims about 3 mm apart.
const LEAN_PER_M: f32 = 28.0;
/// What blocked it has gone when it is so much farther away, metres, for so many steps.
const GONE_M: f32 = 0.004;
const STEPS_TO_FREE: u8 = 8;
/// It backs away until there is so much room, metres, by no more than this and so fast, m/s; not if anybody is so near
/// behind.
const CLEAR_M: f32 = 0.004;
const RETREAT_M: f32 = 0.008;
const RETREAT_MPS: f64 = 0.03;
const FOLLOWED_M: f32 = 0.014;

/// What stands in its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Block {
    /// Rim to obstacle, metres.
    pub gap_m: f64,
    /// Which sensor sees it: 0 ahead, counter-clockwise.
    pub sensor: usize,
    /// In which direction it is, radians in body space.
    pub towards: f64,
}

impl Reflex {
    /// Something stands in its way, in sight of a sensor, as it drives so fast along its front, m/s.
    pub(super) fn come_to_stand(&mut self, sensor: usize, speed_mps: f64) {
        self.block = Some(self.block_at(sensor));
        self.blocked_m = self.gap_m(sensor);
        self.retreat_m = RETREAT_M.copysign(speed_mps as f32);
    }

    fn block_at(&self, sensor: usize) -> Block {
        Block { gap_m: f64::from(self.gap_m(sensor)), sensor, towards: self.towards(sensor) }
    }

    /// How fast it backs away from what it nearly touches, m/s along its front, so that there is a way past that: the way
    /// it came, unless somebody follows.
    pub(crate) fn back_away(&mut self) -> f64 {
        let Some(block) = self.block else { return 0.0 };
        let left_m = self.retreat_m.abs() - (self.speeds_mps[0] * self.dt).abs();
        let behind = if self.retreat_m > 0.0 { SENSORS / 2 } else { 0 };
        let followed = around(behind).iter().any(|&sensor| self.past_m[0][sensor] < FOLLOWED_M);
        if left_m <= 0.0 || followed || self.nearest_m(block.sensor, 0) > CLEAR_M {
            self.retreat_m = 0.0;
            return 0.0;
        }
        self.retreat_m = left_m.copysign(self.retreat_m);
        self.blocked_m = self.nearest_m(block.sensor, 0);
        RETREAT_MPS.copysign(-f64::from(self.retreat_m))
    }

    /// In which direction of body space it is what a sensor sees, radians, by what the one beside it sees.
    pub(super) fn towards(&self, sensor: usize) -> f64 {
        let now = &self.past_m[0];
        let [_, left, right] = around(sensor);
        let (beside, side) = if now[left] < now[right] { (left, 1.0) } else { (right, -1.0) };
        let middle = core::f64::consts::FRAC_PI_8;
        let aside = if now[beside].is_finite() {
            let lean = LEAN_PER_M * (now[beside] - now[sensor]);
            middle - libm::asin(f64::from(lean.clamp(0.0, 0.38)))
        } else {
            0.0
        };
        sensor as f64 * 2.0 * middle + side * aside.max(0.0)
    }

    /// Whether what blocked it has gone; where it is, by the latest readings of two sensors.
    pub(super) fn watch_block(&mut self) {
        let Some(block) = self.block else { return };
        let gone = self.nearest_m(block.sensor, 0) > self.blocked_m + GONE_M;
        self.count = if gone { self.count + 1 } else { 0 };
        if self.count >= STEPS_TO_FREE {
            self.forget();
            return;
        }
        let now = &self.past_m[0];
        let [sensor, left, right] = around(block.sensor);
        let nearer = |best: usize, other: usize| if now[other] < now[best] { other } else { best };
        let nearest = nearer(nearer(sensor, left), right);
        if !gone && around(nearest)[1..].iter().any(|&beside| now[beside].is_finite()) {
            self.block = Some(self.block_at(nearest));
        }
    }
}

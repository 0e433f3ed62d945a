//! How a robot nears what a sensor sees, and how fast it may drive for that.

use super::SENSORS;

/// Wheels answer a step late, seconds; a braking robot rolls on as if it had braked so much later. Ahead there is a step to
/// spare, which noise can cost; who brakes as early for what lies aside of its way brakes for many who only cross it.
const DEAD_S: f32 = 0.016;
const BRAKING_S: [f32; 3] = [0.025, 0.015, 0.015];
/// This is left when it stands, metres.
const SPARE_M: f32 = 0.003;
/// Slower than this nothing closes in: noise, m/s.
const CALM_MPS: f32 = 0.012;
/// Nearer than this ahead nothing may be, whether it closes in or not, metres.
const TOUCHING_M: f32 = 0.0015;
/// So much is left at least where by plan there is plenty, metres.
const LEAST_M: f32 = 0.001;
/// Driving so slowly although it was told to drive so fast, m/s, a robot is stuck.
const STUCK_MPS: f32 = 0.005;
const TOLD_MPS: f32 = 0.05;
/// How it looks where neighbours are near by plan, and where they are not.
pub(super) const NARROW: Look = Look { around: &[(0, 0)], aside: false, stands: [0.6; 3], slack_mps: 0.03 };
pub(super) const WIDE: Look = Look {
    around: &[(0, 0), (1, 1), (SENSORS - 1, 1), (2, 2), (SENSORS - 2, 2)],
    aside: true,
    stands: [0.5, 0.35, 0.15],
    slack_mps: 0.06,
};
/// Share of its speed with which it closes in on what stands in sight of a sensor ahead, 45° and 90° beside it: least
/// and most. Closing in faster than that is the other's doing, and standing would not help.
const SHARE_MIN: [f32; 3] = [0.9, 0.4, 0.3];
const SHARE_MAX: [f32; 3] = [1.0, 0.95, 0.4];
/// What it would miss by more than this if that stood is no hindrance, metres.
const MISS_M: f32 = 0.002;
/// What lies ahead so near, metres, may be nearer than a sensor says that sees it alone.
const ALONE_M: f32 = 0.008;

/// Where it looks, and what it minds.
pub(super) struct Look {
    /// Sensors that count for driving forwards, and how many sensors aside of its way each is.
    pub around: &'static [(usize, usize)],
    /// It looks beside its way as well.
    aside: bool,
    /// What closes in for sure with more than this share of its speed stands, as far as a sensor ahead, 45° and 90°
    /// beside can tell; else it is a neighbour on its own way.
    stands: [f32; 3],
    /// What closes in may do so faster than by the robot's own speed by this, m/s.
    slack_mps: f32,
}

/// How fast a gap closes in, m/s: as it seems over three steps, and at least.
#[derive(Clone, Copy)]
pub(super) struct Closing {
    pub mps: f32,
    pub sure_mps: f32,
}

/// How it nears what one sensor sees, `turn` sensors aside of its way.
pub(super) struct Approach {
    pub gap_m: f32,
    pub closing: Closing,
    /// How fast it drives now and in the step to come, m/s.
    pub along_mps: f32,
    pub next_mps: f32,
    /// The fastest of the steps over which the gap was watched, m/s.
    pub lately_mps: f32,
    pub turn: usize,
}

impl Approach {
    /// How fast it may drive for that, m/s; `None`: as it likes. `until_hit_m`: how far it may drive before it hits that if
    /// it stands, where that is known; asked only where it matters.
    pub fn allowed_mps(
        &self,
        look: &Look,
        contact_m: f32,
        until_hit_m: impl FnOnce() -> Option<f32>,
    ) -> Option<f32> {
        let by_gap = self.by_gap_mps(look, contact_m).or_else(|| self.by_nearness_mps(look));
        let braking_m = self.next_mps * DEAD_S + self.lately_mps * BRAKING_S[self.turn] + SPARE_M;
        let nears = self.closing.sure_mps > CALM_MPS && self.gap_m < braking_m;
        let tells = self.gap_m > TOUCHING_M && (self.turn > 0 || look.aside && self.gap_m < ALONE_M);
        let known = if tells && (nears || by_gap.is_some()) { until_hit_m() } else { None };
        let Some(until_hit_m) = known else { return by_gap };
        // Noise makes it look nearer.
        let until_hit_m = until_hit_m.max(self.gap_m);
        let most_mps = ((until_hit_m - self.next_mps * DEAD_S - SPARE_M) / BRAKING_S[self.turn]).max(0.0);
        let by_place = (most_mps < self.next_mps.max(self.along_mps)).then_some(most_mps);
        // Beside the way the gap alone tells little.
        if self.turn > 0 {
            return by_place;
        }
        by_gap.zip(by_place).map(|(gap, place)| gap.min(place)).or(by_gap).or(by_place)
    }

    /// The same where by plan nobody comes so near: whatever that does, it may stand by the next step.
    fn by_nearness_mps(&self, look: &Look) -> Option<f32> {
        let stops_s = DEAD_S + BRAKING_S[self.turn];
        let most_mps = (self.gap_m - LEAST_M).max(0.0) / stops_s;
        (look.aside && self.turn == 0 && self.gap_m < ALONE_M).then_some(most_mps)
    }

    /// The same, by how the gap closes in.
    fn by_gap_mps(&self, look: &Look, contact_m: f32) -> Option<f32> {
        let Self { gap_m, closing, along_mps, next_mps, lately_mps, turn } = *self;
        // One that was told to drive and does not is stuck, and not about to touch anything.
        let moves = lately_mps > STUCK_MPS || next_mps < TOLD_MPS;
        if gap_m < TOUCHING_M && turn < 2 && moves {
            return Some(0.0);
        }
        if closing.sure_mps < look.stands[turn] * lately_mps || closing.sure_mps < CALM_MPS {
            return None;
        }
        if closing.mps > SHARE_MAX[turn] * lately_mps + look.slack_mps {
            return None;
        }
        // By how much would it be missed?
        let share = (closing.mps / lately_mps.max(1e-3)).clamp(0.0, 1.0);
        let miss_m = (contact_m + gap_m) * libm::sqrtf(1.0 - share * share) - contact_m;
        if miss_m > MISS_M {
            return None;
        }
        let share = share.clamp(SHARE_MIN[turn], SHARE_MAX[turn]);
        let closing_mps = closing.mps.max(share * along_mps);
        let soon_mps = (closing_mps + (next_mps - along_mps) * share).max(0.0);
        let soon_m = gap_m - soon_mps * DEAD_S;
        let most_closing_mps = ((soon_m - SPARE_M) / BRAKING_S[self.turn]).max(0.0);
        let others_mps = closing_mps - along_mps * share;
        let most_mps = ((most_closing_mps - others_mps) / share).max(0.0);
        (most_mps < next_mps.max(along_mps) || most_closing_mps == 0.0).then_some(most_mps)
    }
}

//! The reflex: a robot looks ahead with its proximity sensors and does not drive into what stands in its way, faster
//! than any message could tell it.
//!
//! Neighbours may be near by plan, a few millimetres, so nearness alone means nothing. What counts is whether a gap
//! closes in faster than the robot could stop, as it does where the other stands: in a synchronised drive a neighbour
//! ahead drives as well, and its gap does not close; one that died closes in at the robot's own speed.

mod apart;
mod approach;
mod block;
mod held;
mod standing;

use lightbots_base::Limits;

use approach::{Approach, Closing, NARROW, WIDE};
pub(crate) use block::Block;
use held::Held;

/// Sensors around the rim, 45° apart, counter-clockwise from the front.
pub(crate) const SENSORS: usize = 8;
/// Gaps wider than this are of no interest, metres.
const SIGHT_M: f32 = 0.03;
/// How many steps are remembered to see how fast a gap closes.
const PAST: usize = 3;
/// Noise of a difference of two readings, 1 sigma: metres, and share of the gap.
const NOISE_M: f32 = 0.0004;
const NOISE_SHARE: f32 = 0.07;
/// How many sigma are taken off what one, two and three steps say.
const SIGMAS: [f32; PAST] = [2.4, 1.5, 1.3];
/// Between two sensors a disc is so much nearer than either says, at most; less where one says more than the other.
const BETWEEN_M: f32 = 0.0036;
const APART_M: f32 = 0.012;
/// Who is left so much room by plan, millimetres, has no neighbours and looks beside its way as well.
pub(crate) const AMPLE_MM: u16 = 8;
/// Once it may drive less than half of what it wants, it does so for so many steps, unless the gap widens by so much,
/// metres; after them it is blocked. As it slows down the gap no longer closes, and that must not set it free.
const STEPS_TO_BLOCK: u8 = 5;
const WIDENS_M: f32 = 0.002;
/// What is farther away than this by then does not block it, metres: it stops nearer to what stands.
const BLOCKS_M: f32 = 0.009;
/// What it would pass by so little, metres, it would hit.
const REACH_M: f32 = 0.001;
/// So badly the place of something that stands explains all readings that are remembered at most, and those of so many
/// steps.
const MISFIT_MAX: f32 = 2.5;
const LATEST: usize = 4;
const LATEST_MISFIT_MAX: f32 = 2.0;
/// Slower wishes than this block nobody, m/s.
const WISH_MPS: f64 = 0.02;

/// What the robot's drive is about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wish {
    /// How fast it wants to drive along its front, m/s; backwards is negative.
    pub speed_mps: f64,
    /// What the wheels were told a step ago, which acts now.
    pub told_mps: f64,
    /// The others stay far from it by plan.
    pub ample: bool,
}

/// What the proximity sensors saw, and what follows from it.
#[derive(Debug)]
#[repr(C)] // See `Robot`.
pub(crate) struct Reflex {
    /// `[steps ago][sensor]`: gaps, metres; infinite where nothing was in sight.
    past_m: [[f32; SENSORS]; standing::STEPS],
    /// `[steps ago]`: how far it drove, metres, and turned, radians, up to then.
    moves: [(f32, f32); standing::STEPS - 1],
    /// `[steps ago]`: how fast it drove, m/s; backwards is negative.
    speeds_mps: [f32; PAST],
    dt: f32,
    held: Option<Held>,
    block: Option<Block>,
    /// How far away it was that blocks it when it came to stand, and how much farther it may back away from that, metres;
    /// negative: forwards.
    blocked_m: f32,
    retreat_m: f32,
    sees: bool,
    /// Steps in a row in which it was held back, or free again.
    count: u8,
}

const NOTHING: [f32; SENSORS] = [f32::INFINITY; SENSORS];

impl Reflex {
    pub(crate) fn new() -> Self {
        Self {
            past_m: [NOTHING; standing::STEPS],
            moves: [(0.0, 0.0); standing::STEPS - 1],
            sees: false,
            speeds_mps: [0.0; PAST],
            dt: 0.0,
            held: None,
            count: 0,
            block: None,
            blocked_m: 0.0,
            retreat_m: 0.0,
        }
    }

    /// Takes the readings of a step of `dt` seconds in which it drove so far forwards, metres, and turned so far
    /// counter-clockwise, radians. What is not a number is nothing seen.
    pub(crate) fn look(&mut self, gaps_m: Option<&[f32; SENSORS]>, (way_m, turn_rad): (f64, f64), dt: f64) {
        let gaps_m = gaps_m.filter(|gaps| dt > 0.0 && Self::notices(gaps));
        if gaps_m.is_none() && !self.sees {
            return;
        }
        self.sees = gaps_m.is_some();
        let seen = |gap: f32| if gap < SIGHT_M { gap.max(0.0) } else { f32::INFINITY };
        match gaps_m {
            Some(gaps) => {
                self.past_m.copy_within(..standing::STEPS - 1, 1);
                self.moves.copy_within(..standing::STEPS - 2, 1);
                self.moves[0] = (way_m as f32, turn_rad as f32);
                self.past_m[0] = gaps.map(seen);
                self.speeds_mps.copy_within(..PAST - 1, 1);
                (self.speeds_mps[0], self.dt) = ((way_m / dt) as f32, dt as f32);
            }
            None => self.past_m = [NOTHING; standing::STEPS],
        }
    }

    /// Whether there is anything in such readings.
    #[inline]
    pub(crate) fn notices(gaps_m: &[f32; SENSORS]) -> bool {
        gaps_m.iter().any(|&gap| gap < SIGHT_M)
    }

    /// Whether it sees something or does something about what it saw: else there is nothing to ask it until it looks again.
    pub(crate) fn is_wary(&self) -> bool {
        self.sees || self.held.is_some() || self.block.is_some()
    }

    /// How fast it may drive, m/s, at least 0. `None`: as it likes.
    pub(crate) fn limit(&mut self, wish: Wish, limits: &Limits) -> Option<f64> {
        if !self.sees && self.block.is_none() {
            self.let_go();
            return None;
        }
        if self.block.is_some() {
            self.watch_block();
            return self.block.map(|_| 0.0);
        }
        let slowest = self.slowest(wish, limits);
        let free_mps = slowest.map(|(mps, _)| mps);
        if let Some(mut held) = self.held {
            let was_nothing = self.was_nothing(&mut held, limits.contact_m() as f32);
            self.held = (!was_nothing).then_some(held);
            if was_nothing {
                return free_mps;
            }
        }
        if let Some((mps, sensor)) = slowest
            && mps < wish.speed_mps.abs() * 0.5
            && wish.speed_mps.abs() > WISH_MPS
            && self.held.is_none_or(|held| mps < held.mps)
        {
            self.brake_for(sensor, mps);
        }
        let Some(Held { sensor, mps: held_mps, .. }) = self.held else { return free_mps };
        self.count += 1;
        if self.count >= STEPS_TO_BLOCK {
            (self.held, self.count) = (None, 0);
            if self.nearest_m(sensor, 0) > BLOCKS_M {
                return free_mps;
            }
            self.come_to_stand(sensor, wish.speed_mps);
        }
        Some(free_mps.map_or(held_mps, |mps| mps.min(held_mps)))
    }

    /// The speed that the sensor allows which allows least, and which that is.
    fn slowest(&mut self, wish: Wish, limits: &Limits) -> Option<(f64, usize)> {
        let forwards =
            if wish.speed_mps.abs() > 1e-3 { wish.speed_mps > 0.0 } else { self.speeds_mps[0] > 0.0 };
        let sense = if forwards { 1.0 } else { -1.0 };
        let along_mps = (sense * self.speeds_mps[0]).max(0.0);
        let lately_mps = self.speeds_mps.iter().fold(0.0, |most: f32, mps| most.max(sense * mps));
        let next_mps = (sense * wish.told_mps as f32).max(0.0);
        let contact_m = limits.contact_m() as f32;
        // Beside its way neighbours may pass by plan, as near as they like: then only the sensor ahead counts.
        let look = if wish.ample { &WIDE } else { &NARROW };
        let mut slowest: Option<(f32, usize)> = None;
        for &(index, turn) in look.around {
            let sensor = if forwards { index } else { (index + SENSORS / 2) % SENSORS };
            if turn == 2 && self.is_abaft(sensor, forwards) {
                continue;
            }
            let Some(closing) = self.closing(sensor) else { continue };
            let gap_m = self.gap_m(sensor);
            let approach = Approach { gap_m, closing, along_mps, lately_mps, next_mps, turn };
            let until_hit_m = || self.until_hit_m(sensor, sense, contact_m);
            if let Some(mps) = approach.allowed_mps(look, contact_m, until_hit_m)
                && slowest.is_none_or(|(least, _)| mps < least)
            {
                slowest = Some((mps, sensor));
            }
        }
        slowest.map(|(mps, sensor)| (f64::from(mps), sensor))
    }

    /// How far it may drive until it hits what a sensor sees, if that stands, metres; infinite: it would not, or it does
    /// not stand. `None`: too little is known.
    fn until_hit_m(&self, sensor: usize, sense: f32, contact_m: f32) -> Option<f32> {
        let reach_m = contact_m + REACH_M;
        let until = |steps: usize, misfit_max: f32| {
            let there = self.standing(sensor, steps, 0.5 * contact_m)?;
            let (ahead_m, aside_m) = (there.at.x * sense, there.at.y.abs());
            let hits = there.misfit <= misfit_max && ahead_m >= 0.0 && aside_m <= reach_m;
            let chord_m = libm::sqrtf((reach_m * reach_m - aside_m * aside_m).max(0.0));
            Some(if hits { (ahead_m - chord_m).max(0.0) } else { f32::INFINITY })
        };
        // One that has only just come to stand explains no more than the latest steps.
        Some(until(standing::STEPS, MISFIT_MAX)?.min(until(LATEST, LATEST_MISFIT_MAX)?))
    }

    /// Whether what a sensor abeam sees lies behind it rather than ahead: then no driving on closes in on it, and
    /// braking would only let it run into the robot.
    fn is_abaft(&self, sensor: usize, forwards: bool) -> bool {
        let now = &self.past_m[0];
        let [_, next, last] = around(sensor).map(|sensor| now[sensor]);
        let (ahead, behind) = if (sensor == 2) == forwards { (last, next) } else { (next, last) };
        behind < ahead
    }

    /// The gap at a sensor, metres, a little less where the one beside it sees nearly as near.
    fn gap_m(&self, sensor: usize) -> f32 {
        self.gap_then_m(sensor, 0)
    }

    /// The same so many steps ago.
    fn gap_then_m(&self, sensor: usize, ago: usize) -> f32 {
        let then = &self.past_m[ago];
        let [_, left, right] = around(sensor);
        let beside = then[left].min(then[right]);
        let even = (1.0 - (beside - then[sensor]).abs() / APART_M).max(0.0);
        (then[sensor] - BETWEEN_M * even * even).max(0.0)
    }

    /// The gap at a sensor or those beside it so many steps ago, metres: what is in sight passes from one to the next.
    fn nearest_m(&self, sensor: usize, ago: usize) -> f32 {
        around(sensor).iter().map(|&sensor| self.gap_then_m(sensor, ago)).fold(f32::INFINITY, f32::min)
    }

    /// How near it was so many steps ago what a sensor or those beside it see, metres: the gap, and the least that one of
    /// them said. As it passes from one to the next either of the two may widen, but not both.
    fn near_m(&self, sensor: usize, ago: usize) -> [f32; 2] {
        let says_m =
            around(sensor).iter().map(|&sensor| self.past_m[ago][sensor]).fold(f32::INFINITY, f32::min);
        [self.nearest_m(sensor, ago), says_m]
    }

    /// How fast the gap at a sensor shrinks; `None` where nothing was in sight twice.
    fn closing(&self, sensor: usize) -> Option<Closing> {
        let gap_m = self.past_m[0][sensor];
        let noise_m = NOISE_M + NOISE_SHARE * gap_m;
        let mut closing = None;
        for steps in 1..=PAST {
            let before_m = self.past_m[steps][sensor];
            if !before_m.is_finite() || !gap_m.is_finite() {
                break;
            }
            let over_s = steps as f32 * self.dt;
            let mps = (before_m - gap_m) / over_s;
            let sure_mps = mps - SIGMAS[steps - 1] * noise_m / over_s;
            let surest_mps = closing.map_or(sure_mps, |known: Closing| known.sure_mps.max(sure_mps));
            closing = Some(Closing { mps: mps.max(surest_mps), sure_mps: surest_mps });
        }
        closing
    }

    /// What it is to do has changed: it may try again.
    pub(crate) fn forget(&mut self) {
        self.let_go();
        if self.block.is_some() || self.count > 0 {
            (self.block, self.count) = (None, 0);
        }
    }

    /// Writes only where that changes anything: what is written has to go back to memory.
    fn let_go(&mut self) {
        if self.held.is_some() {
            self.held = None;
        }
    }

    /// What stands in its way.
    pub(crate) fn block(&self) -> Option<Block> {
        self.block
    }
}

/// A sensor and those beside it.
fn around(sensor: usize) -> [usize; 3] {
    [sensor, (sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS]
}

#[cfg(test)]
#[path = "reflex_tests.rs"]
mod tests;

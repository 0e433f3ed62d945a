//! The reflex: a robot looks ahead with its proximity sensors and does not drive into what stands in its way, faster
//! than any message could tell it.
//!
//! Neighbours may be near by plan, a few millimetres, so nearness alone means nothing. What counts is whether a gap
//! closes in faster than the robot could stop, as it does where the other stands: in a synchronised drive a neighbour
//! ahead drives as well, and its gap does not close; one that died closes in at the robot's own speed.

mod apart;

use core::hint::black_box;

use lightbots_base::Limits;

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
/// Wheels answer a step late, seconds; a braking robot rolls on as if it had braked so much later.
const DEAD_S: f32 = 0.016;
const BRAKING_S: f32 = 0.025;
/// This is left when it stands, metres.
const SPARE_M: f32 = 0.003;
/// Slower than this nothing closes in: noise, m/s.
const CALM_MPS: f32 = 0.012;
/// Nearer than this ahead nothing may be, whether it closes in or not, metres.
const TOUCHING_M: f32 = 0.0015;
/// Sine of the angle between the middle of two sensors and what both see, for each metre by which one sees it nearer:
/// for discs of 27 mm with their rims about 3 mm apart.
const LEAN_PER_M: f32 = 28.0;
/// Driving so slowly although it was told to drive so fast, m/s, a robot is stuck.
const STUCK_MPS: f32 = 0.005;
const TOLD_MPS: f32 = 0.05;
/// Who is left so much room by plan, millimetres, has no neighbours and looks beside its way as well.
pub(crate) const AMPLE_MM: u16 = 8;
/// How it looks where neighbours are near by plan, and where they are not.
const NARROW: Look = Look { around: &[(0, 0)], stands: [0.6; 3], slack_mps: 0.03 };
const WIDE: Look = Look {
    around: &[(0, 0), (1, 1), (SENSORS - 1, 1), (2, 2), (SENSORS - 2, 2)],
    stands: [0.5, 0.35, 0.15],
    slack_mps: 0.06,
};
/// Share of its speed with which it closes in on what stands in sight of a sensor ahead, 45° and 90° beside it: least
/// and most. Closing in faster than that is the other's doing, and standing would not help.
const SHARE_MIN: [f32; 3] = [0.9, 0.4, 0.3];
const SHARE_MAX: [f32; 3] = [1.0, 0.95, 0.4];
/// What it would miss by more than this if that stood is no hindrance, metres.
const MISS_M: f32 = 0.002;
/// Once it may drive less than half of what it wants, it does so for so many steps, unless the gap widens by so much,
/// metres; after them it is blocked. As it slows down the gap no longer closes, and that must not set it free.
const STEPS_TO_BLOCK: u8 = 5;
const WIDENS_M: f32 = 0.002;
/// Slower wishes than this block nobody, m/s.
const WISH_MPS: f64 = 0.02;
/// What blocked it has gone when it is so much farther away, metres, for so many steps.
const GONE_M: f32 = 0.004;
const STEPS_TO_FREE: u8 = 8;

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

/// Where it looks, and what it minds.
struct Look {
    /// Sensors that count for driving forwards, and how many sensors aside of its way each is.
    around: &'static [(usize, usize)],
    /// What closes in for sure with more than this share of its speed stands, as far as a sensor ahead, 45° and 90°
    /// beside can tell; else it is a neighbour on its own way.
    stands: [f32; 3],
    /// What closes in may do so faster than by the robot's own speed by this, m/s.
    slack_mps: f32,
}

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
    past_m: [[f32; SENSORS]; PAST + 1],
    /// `[steps ago]`: how fast it drove, m/s; backwards is negative.
    speeds_mps: [f32; PAST],
    dt: f32,
    /// What holds it back: the sensor, its gap then, and how fast it may drive, m/s.
    held: Option<(usize, f32, f64)>,
    block: Option<Block>,
    sees: bool,
    /// Steps in a row in which it was held back, or free again.
    count: u8,
}

const NOTHING: [f32; SENSORS] = [f32::INFINITY; SENSORS];

impl Reflex {
    pub(crate) fn new() -> Self {
        Self {
            past_m: [NOTHING; PAST + 1],
            sees: false,
            speeds_mps: [0.0; PAST],
            dt: 0.0,
            held: None,
            count: 0,
            block: None,
        }
    }

    /// Takes the readings of a step of `dt` seconds in which it drove `way_m` forwards. What is not a number is nothing
    /// seen.
    #[inline]
    pub(crate) fn look(&mut self, gaps_m: Option<&[f32; SENSORS]>, way_m: f64, dt: f64) {
        let gaps_m = gaps_m.filter(|gaps| dt > 0.0 && gaps.iter().any(|&gap| gap < SIGHT_M));
        if gaps_m.is_none() && !self.sees {
            return;
        }
        self.sees = gaps_m.is_some();
        let seen = |gap: f32| if gap < SIGHT_M { gap.max(0.0) } else { f32::INFINITY };
        match gaps_m {
            Some(gaps) => {
                self.past_m.copy_within(..PAST, 1);
                self.past_m[0] = gaps.map(seen);
                self.speeds_mps.copy_within(..PAST - 1, 1);
                (self.speeds_mps[0], self.dt) = ((way_m / dt) as f32, dt as f32);
            }
            None => self.past_m = [NOTHING; PAST + 1],
        }
    }

    /// How fast it may drive, m/s, at least 0. `None`: as it likes.
    #[inline]
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
        if let Some((mps, sensor)) = slowest
            && mps < wish.speed_mps.abs() * 0.5
            && wish.speed_mps.abs() > WISH_MPS
            && self.held.is_none_or(|(_, _, held_mps)| mps < held_mps)
        {
            self.count = if self.held.is_some() { self.count } else { 0 };
            self.held = Some((sensor, self.gap_m(sensor), mps));
        }
        let free_mps = slowest.map(|(mps, _)| mps);
        let Some((sensor, gap_m, held_mps)) = self.held else { return free_mps };
        if self.gap_m(sensor) > gap_m + WIDENS_M {
            self.held = None;
            return free_mps;
        }
        self.count += 1;
        if self.count >= STEPS_TO_BLOCK {
            self.block = Some(self.block_at(sensor));
            (self.held, self.count) = (None, 0);
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
            if let Some(mps) = approach.allowed_mps(look, contact_m)
                && slowest.is_none_or(|(least, _)| mps < least)
            {
                slowest = Some((mps, sensor));
            }
        }
        slowest.map(|(mps, sensor)| (f64::from(mps), sensor))
    }

    /// Whether what a sensor abeam sees lies behind it rather than ahead: then no driving on closes in on it, and
    /// braking would only let it run into the robot.
    fn is_abaft(&self, sensor: usize, forwards: bool) -> bool {
        let now = &self.past_m[0];
        let (next, last) = (now[(sensor + 1) % SENSORS], now[(sensor + SENSORS - 1) % SENSORS]);
        let (ahead, behind) = if (sensor == 2) == forwards { (last, next) } else { (next, last) };
        behind < ahead
    }

    fn block_at(&self, sensor: usize) -> Block {
        Block { gap_m: f64::from(self.gap_m(sensor)), sensor, towards: self.towards(sensor) }
    }

    /// In which direction of body space it is what a sensor sees, radians, by what the one beside it sees.
    fn towards(&self, sensor: usize) -> f64 {
        let now = &self.past_m[0];
        let (left, right) = ((sensor + 1) % SENSORS, (sensor + SENSORS - 1) % SENSORS);
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

    /// The gap at a sensor, metres, a little less where the one beside it sees nearly as near.
    fn gap_m(&self, sensor: usize) -> f32 {
        let now = &self.past_m[0];
        let beside = now[(sensor + 1) % SENSORS].min(now[(sensor + SENSORS - 1) % SENSORS]);
        let even = (1.0 - (beside - now[sensor]).abs() / APART_M).max(0.0);
        (now[sensor] - BETWEEN_M * even * even).max(0.0)
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

    /// Whether what blocked it has gone.
    fn watch_block(&mut self) {
        let Some(block) = self.block else { return };
        let beside = [block.sensor, (block.sensor + 1) % SENSORS, (block.sensor + SENSORS - 1) % SENSORS];
        let gap_m = beside.iter().map(|&sensor| self.past_m[0][sensor]).fold(f32::INFINITY, f32::min);
        let gone = gap_m > block.gap_m as f32 + GONE_M;
        self.count = if gone { self.count + 1 } else { 0 };
        if self.count >= STEPS_TO_FREE {
            self.forget();
        }
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

    /// Reads a little of each cache line, in order: see `Robot::fetch`.
    #[inline]
    pub(crate) fn fetch(&self) {
        black_box((self.past_m[0][0], self.past_m[2][0], self.dt, self.block.is_some(), self.count));
    }

    /// What stands in its way.
    pub(crate) fn block(&self) -> Option<Block> {
        self.block
    }
}

/// How fast a gap closes in, m/s: as it seems over three steps, and at least.
#[derive(Clone, Copy)]
struct Closing {
    mps: f32,
    sure_mps: f32,
}

/// How it nears what one sensor sees, `turn` sensors aside of its way.
struct Approach {
    gap_m: f32,
    closing: Closing,
    /// How fast it drives now and in the step to come, m/s.
    along_mps: f32,
    next_mps: f32,
    /// The fastest of the steps over which the gap was watched, m/s.
    lately_mps: f32,
    turn: usize,
}

impl Approach {
    /// How fast it may drive for that, m/s; `None`: as it likes.
    fn allowed_mps(&self, look: &Look, contact_m: f32) -> Option<f32> {
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
        let most_closing_mps = ((soon_m - SPARE_M) / BRAKING_S).max(0.0);
        let others_mps = closing_mps - along_mps * share;
        let most_mps = ((most_closing_mps - others_mps) / share).max(0.0);
        (most_mps < next_mps.max(along_mps) || most_closing_mps == 0.0).then_some(most_mps)
    }
}

#[cfg(test)]
#[path = "reflex_tests.rs"]
mod tests;

//! The reflex: a robot looks ahead with its proximity sensors and does not drive into what stands in its way, faster
//! than any message could tell it.
//!
//! Neighbours may be near by plan, a few millimetres, so nearness alone means nothing. What counts is whether a gap
//! closes in faster than the robot could stop, as it does where the other stands: in a synchronised drive a neighbour
//! ahead drives as well, and its gap does not close; one that died closes in at the robot's own speed.

mod apart;
mod sight;

use lightbots_base::Limits;
pub(crate) use sight::SENSORS;
use sight::{Closing, LONG_PAST, PAST, Sight};

/// Wheels answer a step late, seconds; a braking robot rolls on as if it had braked so much later.
const DEAD_S: f32 = 0.016;
const BRAKING_S: f32 = 0.025;
/// This is left when it stands, metres.
const SPARE_M: f32 = 0.003;
/// Slower than this nothing closes in: noise, m/s.
const CALM_MPS: f32 = 0.012;
/// Nearer than this ahead nothing may be, whether it closes in or not, metres.
const TOUCHING_M: f32 = 0.0015;
/// Driving so slowly although it was told to drive so fast, m/s, a robot is stuck.
const STUCK_MPS: f32 = 0.005;
const TOLD_MPS: f32 = 0.05;
/// Who is left so much room by plan, millimetres, has no neighbours and looks beside its way as well.
const AMPLE_MM: u16 = 8;
/// With so much room, nobody is nearer than that less this by plan, even if both are off their routes, metres: it is watched
/// over more steps, and minded even if it hardly closes in. More room than this cannot be overlooked well.
const OFF_M: f32 = 0.0045;
const ROOM_MOST_M: f32 = 0.015;
/// Then closing in for sure with this share of its speed suffices; …
const INTRUDER_STANDS: f32 = 0.15;
/// … and what one sensor beside its way sees alone may be so much nearer than that says, metres.
const ALONE_M: f32 = 0.0015;
/// One that kept pace stands if it now closes in for sure with more than this share of its speed.
const PACER_STANDS: f32 = 0.3;
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
/// Nearer than this to what blocks it, metres, it rolls back so fast, m/s, for at most so many steps, where nothing is as
/// near behind it as this, metres, and what blocks it is ahead by this at least (cosine).
const BACK_M: f32 = 0.0035;
const BACK_MPS: f64 = 0.03;
const STEPS_BACK: u8 = 12;
const BEHIND_M: f32 = 0.008;
const BACK_COS: f64 = 0.5;

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
    /// How far the others stay from it by plan, where it was told, millimetres.
    pub room_mm: Option<u16>,
}

impl Wish {
    /// The others stay far from it by plan.
    fn ample(&self) -> bool {
        self.room_mm.is_some_and(|room_mm| room_mm >= AMPLE_MM)
    }

    /// Whether nothing is so near to it by plan, even where both are off their routes.
    fn is_too_near(&self, gap_m: f32) -> bool {
        let least_m = |room_mm: u16| (f32::from(room_mm) * 1e-3).min(ROOM_MOST_M) - OFF_M;
        self.room_mm.is_some_and(|room_mm| room_mm >= AMPLE_MM && gap_m < least_m(room_mm))
    }
}

/// What the proximity sensors saw, and what follows from it.
#[derive(Debug)]
pub(crate) struct Reflex {
    sight: Sight,
    /// `[steps ago]`: how fast it drove, m/s; backwards is negative.
    speeds_mps: [f32; PAST],
    /// What holds it back: the sensor, its gap then, and how fast it may drive, m/s.
    held: Option<(usize, f32, f64)>,
    /// Steps in a row in which it was held back, or free again.
    count: u8,
    block: Option<Block>,
    /// Steps in which it rolled back from that.
    backed: u8,
}

impl Reflex {
    pub(crate) fn new() -> Self {
        Self { sight: Sight::new(), speeds_mps: [0.0; PAST], held: None, count: 0, block: None, backed: 0 }
    }

    /// Takes the readings of a step of `dt` seconds in which it drove `way_m` forwards. What is not a number is nothing
    /// seen.
    #[inline]
    pub(crate) fn look(&mut self, gaps_m: Option<&[f32; SENSORS]>, way_m: f64, dt: f64) {
        self.sight.look(gaps_m, dt);
        if self.sight.sees {
            self.speeds_mps.copy_within(..PAST - 1, 1);
            self.speeds_mps[0] = (way_m / dt) as f32;
        }
    }

    /// How fast it may drive, m/s, at least 0. `None`: as it likes.
    #[inline]
    pub(crate) fn limit(&mut self, wish: Wish, limits: &Limits) -> Option<f64> {
        if !self.sight.sees && self.block.is_none() {
            self.held = None;
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
            self.held = Some((sensor, self.sight.gap_m(sensor), mps));
        }
        let free_mps = slowest.map(|(mps, _)| mps);
        let Some((sensor, gap_m, held_mps)) = self.held else { return free_mps };
        if self.sight.gap_m(sensor) > gap_m + WIDENS_M {
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
        let look = if wish.ample() { &WIDE } else { &NARROW };
        let mut slowest: Option<(f32, usize)> = None;
        for &(index, turn) in look.around {
            let sensor = if forwards { index } else { (index + SENSORS / 2) % SENSORS };
            if turn == 2 && self.sight.is_abaft(sensor, forwards) {
                continue;
            }
            let gap_m = self.sight.gap_m(sensor);
            let intrudes = wish.is_too_near(gap_m);
            let past = if intrudes { LONG_PAST } else { PAST };
            let Some(closing) = self.sight.closing(sensor, past) else { continue };
            let alone_m = if intrudes && turn > 0 && self.sight.is_alone(sensor) { ALONE_M } else { 0.0 };
            let gap_m = (gap_m - alone_m).max(0.0);
            let ahead = (libm::cos(self.sight.towards(sensor)) as f32 * sense).max(0.0);
            let approach =
                Approach { gap_m, closing, along_mps, lately_mps, next_mps, turn, ahead, intrudes };
            if let Some(mps) = approach.allowed_mps(look, contact_m)
                && slowest.is_none_or(|(least, _)| mps < least)
            {
                slowest = Some((mps, sensor));
            }
        }
        slowest.map(|(mps, sensor)| (f64::from(mps), sensor))
    }

    fn block_at(&self, sensor: usize) -> Block {
        Block { gap_m: f64::from(self.sight.gap_m(sensor)), sensor, towards: self.sight.towards(sensor) }
    }

    /// Whether what blocked it has gone.
    fn watch_block(&mut self) {
        let Some(block) = self.block else { return };
        let gone = self.sight.around_m(block.sensor) > block.gap_m as f32 + GONE_M;
        self.count = if gone { self.count + 1 } else { 0 };
        if self.count >= STEPS_TO_FREE {
            self.forget();
        }
    }

    /// How fast it rolls back from what blocks it, m/s along its front, where it stands too near to drive around that;
    /// `None`: it stands far enough, or does not know that there is room behind it.
    pub(crate) fn back_mps(&mut self) -> Option<f64> {
        let gap_m = self.sight.gap_m(self.block?.sensor);
        let block = self.block.as_mut()?;
        let ahead = libm::cos(block.towards);
        if self.backed >= STEPS_BACK || gap_m > BACK_M || ahead.abs() < BACK_COS {
            return None;
        }
        if self.sight.around_m(if ahead > 0.0 { SENSORS / 2 } else { 0 }) < BEHIND_M {
            return None;
        }
        block.gap_m = block.gap_m.max(f64::from(gap_m));
        self.backed += 1;
        Some(-BACK_MPS.copysign(ahead))
    }

    /// What it is to do has changed: it may try again.
    pub(crate) fn forget(&mut self) {
        (self.block, self.held, self.count, self.backed) = (None, None, 0, 0);
    }

    /// What stands in its way.
    pub(crate) fn block(&self) -> Option<Block> {
        self.block
    }
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
    /// Cosine of the angle between its way and what is seen.
    ahead: f32,
    /// Nothing is so near by plan.
    intrudes: bool,
}

impl Approach {
    /// Share of its speed with which what stands closes in for sure.
    fn stands(&self, look: &Look) -> f32 {
        let stands = look.stands[self.turn];
        let stands = if self.closing.kept_pace { stands.min(PACER_STANDS) } else { stands };
        if self.intrudes { stands.min(INTRUDER_STANDS) } else { stands }
    }

    /// How fast the gap closes in; of one that kept pace no faster than by the robot's own speed: it brakes, but does not
    /// turn round at once.
    fn at_most_its_own(&self) -> Closing {
        let most_mps = if self.closing.kept_pace { self.lately_mps } else { f32::INFINITY };
        let Closing { mps, sure_mps, .. } = self.closing;
        Closing { mps: mps.min(most_mps), sure_mps: sure_mps.min(most_mps), ..self.closing }
    }

    /// How fast it may drive for that, m/s; `None`: as it likes.
    fn allowed_mps(&self, look: &Look, contact_m: f32) -> Option<f32> {
        let Self { gap_m, along_mps, next_mps, lately_mps, turn, .. } = *self;
        let closing = self.at_most_its_own();
        // One that was told to drive and does not is stuck, and not about to touch anything.
        let moves = lately_mps > STUCK_MPS || next_mps < TOLD_MPS;
        if gap_m < TOUCHING_M && turn < 2 && moves {
            return Some(0.0);
        }
        if closing.sure_mps < self.stands(look) * lately_mps || closing.sure_mps < CALM_MPS {
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
        let share = share.max(self.ahead).clamp(SHARE_MIN[turn], SHARE_MAX[turn]);
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

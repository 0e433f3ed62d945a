//! The reflex: a robot sees its neighbours with its proximity sensors, estimates where they are and how they move,
//! and drives no faster than it can stop for them, sooner than any message could tell it. See docs/reflex.md.

mod birth;
mod covariance;
mod departure;
mod encounters;
mod likelihood;
mod motion;
mod obstacle;
mod obstacles;
mod outline;
mod point;
mod policy;
mod scan;
mod sensors;
mod separation;
mod track;
mod tracks;
mod view;

use lightbots_base::{Instant, Vec2};

use crate::config::{Config, NeighbourModel, SENSORS, SafetyPolicy};
use encounters::Encounters;
use motion::OwnMotion;
pub(crate) use point::Point;
pub(crate) use policy::Wish;
pub(crate) use scan::Expectation;
use scan::Scan;
use sensors::Sensors;
use track::Track;
use tracks::Tracks;

/// A wish slower than this, m/s, is no drive: nothing blocks it.
const DRIVES_MPS: f32 = 0.02;
/// Limits this close to the wish, m/s, slow nothing.
const SLOWS_MPS: f32 = 0.001;

/// What the safety layer does. Its transitions are drawn in docs/reflex.md.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Safety {
    /// The robot drives as it likes.
    Free,
    /// It drives slower than it would like for what is at `block`; for this many `steps` in a row it hardly drove.
    /// `alarm`: the plan does not know what that is.
    Braking { block: Block, steps: u8, alarm: bool },
    /// It stands because something stands in its way; that was not there in the last `gone` steps.
    Blocked { block: Block, gone: u8 },
    /// Blocked, it backs away by what is left of `retreat_m`, metres along its front.
    BackingOff { block: Block, gone: u8, retreat_m: f32 },
}

/// What stands in the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Block {
    /// Rim to obstacle, metres.
    pub gap_m: f64,
    /// In which direction it is, radians in body space.
    pub towards: f64,
    /// Its centre, body space.
    at: Point,
    /// The gap when the robot came to stand, metres.
    stood_m: f32,
}

/// The safety layer of a robot.
#[derive(Debug)]
pub(crate) struct Reflex {
    safety: Safety,
    own: OwnMotion,
    tracks: Tracks,
    /// `(index, clearance in metres, whether it moves)` of the planned neighbours in sight.
    clearances: heapless::Vec<(u8, f32, bool), 16>,
    sensors: Sensors,
    model: NeighbourModel,
    policy: SafetyPolicy,
    /// What it reports of brakes and neighbours.
    pub(crate) encounters: Encounters,
}

impl Reflex {
    pub(crate) fn new(config: &Config) -> Self {
        Self {
            safety: Safety::Free,
            own: OwnMotion { way_m: 0.0, turn_rad: 0.0, dt: 0.016 },
            tracks: Tracks::default(),
            clearances: heapless::Vec::new(),
            sensors: Sensors::new(&config.proximity, config.limits.radius_m),
            model: config.neighbours,
            policy: config.policy,
            encounters: Encounters::default(),
        }
    }

    /// Takes the readings of a step of `dt` seconds in which the robot drove `way_m` forwards and turned `turn_rad`
    /// counter-clockwise, with the neighbours that the plan expects in sight. `error_m`: error of the own place, 1
    /// sigma. What is not a number is nothing seen.
    pub(crate) fn look(
        &mut self,
        gaps_m: Option<&[f32; SENSORS]>,
        (way_m, turn_rad): (f64, f64),
        dt: f64,
        planned: &[Expectation],
        error_m: f64,
    ) {
        if dt <= 0.0 {
            return;
        }
        self.own = OwnMotion { way_m: way_m as f32, turn_rad: turn_rad as f32, dt: dt as f32 };
        self.clearances.clear();
        self.clearances.extend(
            planned
                .iter()
                .take(16)
                .map(|one| (one.index, one.clearance_m, one.velocity.length() > DRIVES_MPS)),
        );
        let seen = |gap_m: f32| if gap_m < self.sensors.range_m { gap_m.max(0.0) } else { f32::INFINITY };
        let gaps_m = gaps_m.map_or([f32::INFINITY; SENSORS], |gaps_m| gaps_m.map(seen));
        // The neighbour's own place is about as unsure as that of this robot.
        let planned_sigma_m = libm::sqrtf(
            self.model.planned_sigma_m * self.model.planned_sigma_m + 2.0 * (error_m * error_m) as f32,
        );
        let (own, sensors, of) = (&self.own, &self.sensors, &self.model);
        let scan = Scan { gaps_m: &gaps_m, own, planned, sensors, planned_sigma_m, of };
        self.tracks.step(&scan);
    }

    /// Whether it sees something or does something about what it saw: else there is nothing to ask it until it looks
    /// again.
    pub(crate) fn is_wary(&self) -> bool {
        !self.tracks.is_empty() || self.safety != Safety::Free
    }

    /// How fast the robot may drive, m/s, at least 0; `None`: as it likes. `room_mm`: what the plan leaves it at
    /// least.
    pub(crate) fn limit(&mut self, wish: Wish, room_mm: Option<u16>) -> Option<f64> {
        let slowest = self.slowest(&wish, room_mm);
        self.safety = match self.safety {
            Safety::Blocked { block, gone } => self.still_blocked(block, gone, 0.0),
            Safety::BackingOff { block, gone, retreat_m } => self.still_blocked(block, gone, retreat_m),
            before => match slowest {
                Some((mps, cause)) if wish.speed_mps.abs() - mps > SLOWS_MPS => {
                    self.slowed(before, &wish, mps, cause, room_mm.is_none())
                }
                _ => match before {
                    // One step on its way is not free of what blocks it.
                    Safety::Braking { block, steps, alarm } if steps > 1 => {
                        Safety::Braking { block, steps: steps - 1, alarm }
                    }
                    _ => Safety::Free,
                },
            },
        };
        match self.safety {
            Safety::Blocked { .. } | Safety::BackingOff { .. } => Some(0.0),
            _ => slowest.map(|(mps, _)| f64::from(mps)),
        }
    }

    /// It may drive at `mps` only, slower than it wishes. `named`: the route names all neighbours.
    fn slowed(&self, before: Safety, wish: &Wish, mps: f32, cause: Cause, named: bool) -> Safety {
        let (steps, alarm) =
            if let Safety::Braking { steps, alarm, .. } = before { (steps, alarm) } else { (0, false) };
        let hardly = wish.speed_mps.abs() > DRIVES_MPS && mps < 0.5 * wish.speed_mps.abs();
        let steps = if hardly { steps + 1 } else { steps };
        let gap_m = cause.at.length() - self.sensors.contact_m();
        let block = block_at(cause.at, gap_m, gap_m);
        if steps < self.policy.steps_to_block {
            return Safety::Braking { block, steps, alarm: alarm || hardly && named && cause.unplanned };
        }
        self.retreats(block, 0, self.policy.evade_most_m.copysign(wish.speed_mps))
    }

    /// The least speed that any neighbour allows, and for which that is.
    fn slowest(&self, wish: &Wish, room_mm: Option<u16>) -> Option<(f32, Cause)> {
        let allowed = |track: &Track| {
            let clearance_m = self.clearance_m(track, room_mm, true);
            let mps = policy::allowed_mps(track, wish, clearance_m, &self.sensors, &self.policy)?;
            Some((mps, Cause { at: track.at, unplanned: track.planned.is_none() }))
        };
        self.tracks.iter(&self.sensors).filter_map(allowed).min_by(|one, other| one.0.total_cmp(&other.0))
    }

    /// Whether anything is in sight that the plan does not know.
    pub(crate) fn sees_strays(&self) -> bool {
        self.tracks.iter(&self.sensors).any(Track::strays)
    }

    /// What the plan leaves the robot and this neighbour, metres.
    fn clearance_m(&self, track: &Track, room_mm: Option<u16>, moving: bool) -> Option<f32> {
        match track.planned {
            Some(index) => {
                let known = self.clearances.iter().find(|one| one.0 == index && (one.2 || !moving));
                known.map(|one| one.1)
            }
            None => room_mm.map(|room_mm| f32::from(room_mm) * 1e-3),
        }
    }

    /// Whether what blocks it is still there; and where, by the latest readings.
    fn still_blocked(&self, block: Block, gone: u8, retreat_m: f32) -> Safety {
        let moved = block.at.minus(Point::new(self.own.way_m, 0.0));
        let near = |track: &&Track| track.at.minus(moved).length() < 2.0 * self.sensors.radius_m;
        let off_m = |track: &Track| track.at.minus(moved).length();
        let track = self
            .tracks
            .iter(&self.sensors)
            .filter(near)
            .min_by(|one, other| off_m(one).total_cmp(&off_m(other)));
        let (block, gone) = match track {
            Some(track) if track.gap_m(&self.sensors) <= block.stood_m + self.policy.clear_m => {
                (block_at(track.at, track.gap_m(&self.sensors), block.stood_m), 0)
            }
            _ if gone + 1 >= self.policy.steps_to_free => return Safety::Free,
            _ => (Block { at: moved, ..block }, gone + 1),
        };
        if retreat_m == 0.0 { Safety::Blocked { block, gone } } else { self.retreats(block, gone, retreat_m) }
    }

    /// It goes on backing away from what it nearly touches, so that there is a path past that: the way it came,
    /// unless a neighbour follows.
    fn retreats(&self, block: Block, gone: u8, retreat_m: f32) -> Safety {
        let left_m = retreat_m.abs() - self.own.way_m.abs();
        let is_near = |track: &Track| track.gap_m(&self.sensors) < self.policy.followed_m;
        let followed =
            self.tracks.iter(&self.sensors).any(|track| track.at.x * retreat_m < 0.0 && is_near(track));
        if left_m <= 0.0 || followed || block.gap_m > f64::from(self.policy.clear_m) {
            return Safety::Blocked { block, gone };
        }
        let block = Block { stood_m: block.gap_m as f32, ..block };
        Safety::BackingOff { block, gone, retreat_m: left_m.copysign(retreat_m) }
    }

    /// How fast it backs away, m/s along its front; `None`: it is not blocked.
    pub(crate) fn blocked_mps(&self) -> Option<f64> {
        match self.safety {
            Safety::BackingOff { retreat_m, .. } => {
                Some(f64::from(self.policy.retreat_mps.copysign(-retreat_m)))
            }
            Safety::Blocked { .. } => Some(0.0),
            Safety::Free | Safety::Braking { .. } => None,
        }
    }

    /// How far, and where to in body space, it gives way to neighbours; metres, zero where no neighbour is too near.
    /// `room_mm`: how far others stay away by plan.
    pub(crate) fn give_way(&self, room_mm: Option<u16>) -> Vec2 {
        let own_mps = self.own.way_m / self.own.dt;
        self.tracks.iter(&self.sensors).fold(Vec2::ZERO, |sum, track| {
            let clearance_m = self.clearance_m(track, room_mm, false);
            sum + separation::give_way(track, own_mps, clearance_m, &self.sensors, &self.policy)
        })
    }

    /// A route begins: from the next step on the plan tells which neighbours are in sight.
    pub(crate) fn begin_route(&mut self) {
        self.tracks.clear();
        self.safety = Safety::Free;
        self.encounters.begin_route();
    }

    /// Notes for reports, at `now` on a route, whether it brakes and how near the neighbours are that its sensors see.
    pub(crate) fn note(&mut self, now: Instant) {
        if self.safety != Safety::Free {
            self.encounters.brakes_at(now);
        }
        let seen = self.tracks.iter(&self.sensors).filter(|track| track.seen_by != 0 && !track.is_flat);
        if let Some(gap_m) = seen.map(|track| track.gap_m(&self.sensors)).min_by(f32::total_cmp) {
            self.encounters.see(gap_m);
        }
    }

    /// The route or the target has changed: it may try again.
    pub(crate) fn forget(&mut self) {
        self.safety = Safety::Free;
    }

    /// What it says that is in its way: what it stands for, and what it brakes for if the plan does not know that.
    pub(crate) fn block(&self) -> Option<Block> {
        match self.safety {
            Safety::Blocked { block, .. }
            | Safety::BackingOff { block, .. }
            | Safety::Braking { block, alarm: true, .. } => Some(block),
            Safety::Free | Safety::Braking { .. } => None,
        }
    }

    /// In which direction of body space that is for which it is slowed, radians.
    pub(crate) fn braking_towards(&self) -> Option<f64> {
        match self.safety {
            Safety::Free => None,
            Safety::Braking { block, .. }
            | Safety::Blocked { block, .. }
            | Safety::BackingOff { block, .. } => Some(block.towards),
        }
    }
}

/// The neighbour that slows a robot most.
#[derive(Clone, Copy)]
struct Cause {
    /// Body space.
    at: Point,
    /// The plan does not know it.
    unplanned: bool,
}

fn block_at(at: Point, gap_m: f32, stood_m: f32) -> Block {
    Block { gap_m: f64::from(gap_m), towards: f64::from(libm::atan2f(at.y, at.x)), at, stood_m }
}

#[cfg(test)]
#[path = "reflex/death_tests.rs"]
mod death_tests;
#[cfg(test)]
#[path = "reflex/estimator_tests.rs"]
mod estimator_tests;
#[cfg(test)]
#[path = "reflex/planned_scene_tests.rs"]
mod planned_scene_tests;
#[cfg(test)]
#[path = "reflex/policy_tests.rs"]
mod policy_tests;
#[cfg(test)]
#[path = "reflex/side_by_side_tests.rs"]
mod side_by_side_tests;
#[cfg(test)]
#[path = "reflex/stray_tests.rs"]
mod stray_tests;
#[cfg(test)]
#[path = "reflex/wall_drive_tests.rs"]
mod wall_drive_tests;
#[cfg(test)]
#[path = "reflex/wall_scene_tests.rs"]
mod wall_scene_tests;

//! The reflex: the safety layer of a robot. It estimates from the proximity sensors where neighbours are and how they
//! move. It limits the robot's speed so that the robot can stop for them, sooner than any message could tell it to.
//! Neighbours are robots and other objects in sight. A track is the estimate of one neighbour. Planned neighbours are
//! those that the route names; the route also gives their planned motion. See docs/reflex.md.

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

/// A robot or a planned neighbour counts as driving above this speed, m/s. Steps in which the robot wants to drive no
/// faster do not count towards being blocked.
const DRIVES_MPS: f32 = 0.02;
/// The safety layer counts as braking if the allowed speed is less than the wanted speed by more than this, m/s.
const SLOWS_MPS: f32 = 0.001;

/// State of the safety layer. Its transitions are drawn in docs/reflex.md.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Safety {
    /// The robot may drive at the speed that it wants.
    Free,
    /// The robot must drive slower than it wants because of the obstacle `block`, or had to in a recent step. `steps`:
    /// number of steps in which less than half the wanted speed was allowed, minus the steps without a limit. `alarm`:
    /// whether the robot has braked hard for an obstacle that the plan should have named.
    Braking { block: Block, steps: u8, alarm: bool },
    /// The robot stands because of the obstacle `block`. `gone`: number of steps in a row in which the obstacle was
    /// missing.
    Blocked { block: Block, gone: u8 },
    /// The robot is blocked and backs away. `retreat_m`: distance that is left to back away, metres. Its sign is that
    /// of the wanted speed when the robot was blocked, so the robot drives in the opposite direction.
    BackingOff { block: Block, gone: u8, retreat_m: f32 },
}

/// An obstacle that slows or blocks a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Block {
    /// Gap from the robot's rim to the obstacle, metres.
    pub gap_m: f64,
    /// Direction of the obstacle, radians counter-clockwise from the robot's front.
    pub towards: f64,
    /// Centre of the obstacle, body space, metres.
    at: Point,
    /// The gap when the robot stopped for the obstacle, or while it last backed away, metres.
    stood_m: f32,
}

/// The safety layer of a robot.
#[derive(Debug)]
pub(crate) struct Reflex {
    safety: Safety,
    own: OwnMotion,
    tracks: Tracks,
    /// `(index, planned clearance in metres, whether it moves by plan)` of the planned neighbours in sight. The index
    /// counts the neighbours of the route.
    clearances: heapless::Vec<(u8, f32, bool), 16>,
    sensors: Sensors,
    model: NeighbourModel,
    policy: SafetyPolicy,
    /// Statistics of brakes and neighbours for reports.
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

    /// Updates the estimates by the readings of a step of `dt` seconds, in which the robot drove `way_m` metres
    /// forwards and turned `turn_rad` counter-clockwise. `planned`: the neighbours that the plan expects in sight.
    /// `error_m`: error of the robot's own place, metres, 1 sigma. A reading that is NaN counts as nothing seen. A step
    /// of 0 seconds changes nothing.
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
        // A neighbour's error of its own place is about as large as that of this robot.
        let planned_sigma_m = libm::sqrtf(
            self.model.planned_sigma_m * self.model.planned_sigma_m + 2.0 * (error_m * error_m) as f32,
        );
        let (own, sensors, of) = (&self.own, &self.sensors, &self.model);
        let scan = Scan { gaps_m: &gaps_m, own, planned, sensors, planned_sigma_m, of };
        self.tracks.step(&scan);
    }

    /// Whether the safety layer tracks an object or slows the robot. If not, it need not be called before the next
    /// reading within the sensors' range.
    pub(crate) fn is_wary(&self) -> bool {
        !self.tracks.is_empty() || self.safety != Safety::Free
    }

    /// Updates the state of the safety layer. Returns the highest allowed speed, m/s, at least 0; `None` if the speed
    /// is not limited. `room_mm`: planned clearance to neighbours that the route does not name, millimetres; `None` if
    /// the route names all neighbours, or if that clearance is unknown.
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
                    // One step without a limit does not free a robot that braked in several.
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

    /// The next state of a robot that may drive only at `mps` m/s, which is less than it wants. `named`: whether the
    /// route names all neighbours, or gives no clearance to others.
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

    /// The lowest of the speeds that the neighbours allow, m/s, and the neighbour that allows no more. `None` if no
    /// neighbour limits the speed.
    fn slowest(&self, wish: &Wish, room_mm: Option<u16>) -> Option<(f32, Cause)> {
        let allowed = |track: &Track| {
            let clearance_m = self.clearance_m(track, room_mm, true);
            let mps = policy::allowed_mps(track, wish, clearance_m, &self.sensors, &self.policy)?;
            Some((mps, Cause { at: track.at, unplanned: track.planned.is_none() }))
        };
        self.tracks.iter(&self.sensors).filter_map(allowed).min_by(|one, other| one.0.total_cmp(&other.0))
    }

    /// Whether a neighbour that has left its plan is in sight.
    pub(crate) fn sees_strays(&self) -> bool {
        self.tracks.iter(&self.sensors).any(Track::strays)
    }

    /// Planned clearance between the robot and this neighbour, metres; `None` if it is unknown. With `moving`, also
    /// `None` for a planned neighbour that stands by plan.
    fn clearance_m(&self, track: &Track, room_mm: Option<u16>, moving: bool) -> Option<f32> {
        match track.planned {
            Some(index) => {
                let known = self.clearances.iter().find(|one| one.0 == index && (one.2 || !moving));
                known.map(|one| one.1)
            }
            None => room_mm.map(|room_mm| f32::from(room_mm) * 1e-3),
        }
    }

    /// The next state of a blocked robot. The track nearest to the obstacle's expected place updates the obstacle. The
    /// robot is free once the obstacle was missing for `steps_to_free` steps in a row.
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

    /// The next state of a blocked robot that backs away, so that there is room for a path past the obstacle. Backing
    /// away ends once the gap is `clear_m`, the distance `retreat_m` is driven, or a neighbour behind is too near.
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

    /// The speed of a blocked robot along its front, m/s: 0, or the signed speed of backing away. `None` if the robot
    /// is not blocked.
    pub(crate) fn blocked_mps(&self) -> Option<f64> {
        match self.safety {
            Safety::BackingOff { retreat_m, .. } => {
                Some(f64::from(self.policy.retreat_mps.copysign(-retreat_m)))
            }
            Safety::Blocked { .. } => Some(0.0),
            Safety::Free | Safety::Braking { .. } => None,
        }
    }

    /// Offset in body space by which the robot gives way to neighbours that are too near, metres; zero if none is.
    /// `room_mm`: planned clearance to neighbours that the route does not name, millimetres; `None` if it is unknown.
    pub(crate) fn give_way(&self, room_mm: Option<u16>) -> Vec2 {
        let own_mps = self.own.way_m / self.own.dt;
        self.tracks.iter(&self.sensors).fold(Vec2::ZERO, |sum, track| {
            let clearance_m = self.clearance_m(track, room_mm, false);
            sum + separation::give_way(track, own_mps, clearance_m, &self.sensors, &self.policy)
        })
    }

    /// Forgets all neighbours and sets the state to free, because a route begins. Its plan names other neighbours than
    /// the route before. Also resets the least gap for reports.
    pub(crate) fn begin_route(&mut self) {
        self.tracks.clear();
        self.safety = Safety::Free;
        self.encounters.begin_route();
    }

    /// Notes for reports whether the robot brakes in the step at `now`, and the least gap to a neighbour that the
    /// sensors see now. Straight edges do not count as neighbours here.
    pub(crate) fn note(&mut self, now: Instant) {
        if self.safety != Safety::Free {
            self.encounters.brakes_at(now);
        }
        let seen = self.tracks.iter(&self.sensors).filter(|track| track.seen_by != 0 && !track.is_flat);
        if let Some(gap_m) = seen.map(|track| track.gap_m(&self.sensors)).min_by(f32::total_cmp) {
            self.encounters.see(gap_m);
        }
    }

    /// Sets the state to free, so that nothing slows or blocks the robot. Tracks of neighbours are kept.
    pub(crate) fn forget(&mut self) {
        self.safety = Safety::Free;
    }

    /// The obstacle to report: an obstacle that blocks the robot, or one that the plan does not know and for which the
    /// robot brakes hard. `None` if there is none.
    pub(crate) fn block(&self) -> Option<Block> {
        match self.safety {
            Safety::Blocked { block, .. }
            | Safety::BackingOff { block, .. }
            | Safety::Braking { block, alarm: true, .. } => Some(block),
            Safety::Free | Safety::Braking { .. } => None,
        }
    }

    /// Direction of the obstacle that slows or blocks the robot, or slowed it in a recent step. It is in radians
    /// counter-clockwise from the robot's front; `None` if the state is free.
    pub(crate) fn braking_towards(&self) -> Option<f64> {
        match self.safety {
            Safety::Free => None,
            Safety::Braking { block, .. }
            | Safety::Blocked { block, .. }
            | Safety::BackingOff { block, .. } => Some(block.towards),
        }
    }
}

/// The neighbour that allows the lowest speed.
#[derive(Clone, Copy)]
struct Cause {
    /// Its centre, body space, metres.
    at: Point,
    /// Whether it follows no planned neighbour.
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

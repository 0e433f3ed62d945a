//! The route under way, the one kept for later, and when they begin.

mod in_sight;

pub(crate) use in_sight::InSight;

use lightbots_base::{Instant, Limits, Motion, PathRef, Span, Vec2};
use lightbots_wire::Route;

use crate::cursor::RouteCursor;
use crate::drive::{BodyPose, Setpoint};
use crate::follow::{Follow, RESTING_MPS};
use crate::kept_route::{KeptRoute, TOO_LATE};
use crate::look_ahead::{Ahead, LookAhead, SLOW_MPS};
use crate::seek::{Seek, within_arrival};
use crate::steady_time::SteadyTime;
use crate::storage::{RouteStorage, Slot};
use crate::timeline::Timeline;

/// Distance to the end at which a robot has arrived, metres. Below, robots with noisy fixes arrive late. Above, pictures
/// blur.
const NEAR_M: f64 = 0.0125;
/// Time after the end of a route from which the arrival test of the original robots (20 mm) suffices.
const TRYING: Span = Span::from_millis(1500);
/// Distance from its route beyond which a robot drives back to it during a hold, metres. Below, it turns on the spot
/// for noise. Above, the robots near it have less room than the plan left them.
const STRAYED_M: f64 = 0.0055;
/// Distance from its route at which the robot is back, metres. The gap to [`STRAYED_M`] is hysteresis.
const BACK_M: f64 = 0.004;
/// A route whose number is less than this below the newest is an old message that came late. One farther below is of a
/// controller that began anew.
const OLD_NUMBERS: u32 = 64;

const _: () = assert!(BACK_M < STRAYED_M && STRAYED_M < NEAR_M);

/// The route under way.
#[derive(Debug)]
struct Running {
    starts: Instant,
    /// Where the route ends.
    end: Vec2,
    look_ahead: LookAhead,
    /// The drive to the end, once the route is over and the robot has not arrived.
    seek: Option<Seek>,
    /// The drive back to the route during a hold.
    back: Option<Seek>,
    slot: Slot,
    /// Whether path time stands still by the time the wheels have answered.
    rests: bool,
    room_mm: Option<u16>,
    seq: u32,
    duration: Span,
    /// Path time by the time the wheels have answered.
    time: Span,
    /// Path time per show time at `time`, 0 to 1. Negative while path time goes back.
    rate: f64,
    /// Place of the route at `time`, stage metres.
    due: Vec2,
    off_m: f64,
    /// Distance from the place of the route by the moments of holds, metres: not `off_m` while path time goes back.
    due_off_m: f64,
    cursor: RouteCursor,
    steady: SteadyTime,
    follow: Follow,
}

/// The routes of a robot. Their pieces lie in its storage.
#[derive(Debug)]
pub(crate) struct Routes {
    running: Option<Running>,
    timeline: Timeline,
    kept: Option<KeptRoute>,
    /// Number of the route that ended last.
    finished: u32,
    /// Whether the link was out since the latest START or STOP. Until the next one, a route that comes may be an old
    /// message, and the robot does not turn towards it.
    was_out: bool,
}

impl Routes {
    pub(crate) fn new() -> Self {
        Self { running: None, kept: None, timeline: Timeline::new(), finished: 0, was_out: false }
    }

    /// Keeps a route until its START. Copies of the route under way or just finished, and old messages, change nothing.
    pub(crate) fn keep(&mut self, route: &Route, storage: &mut RouteStorage) {
        let newest = self.named();
        let age = newest.wrapping_sub(route.seq);
        if newest != 0 && age < OLD_NUMBERS {
            return;
        }
        let slot = self.running.as_ref().map_or(Slot::First, |running| running.slot.other());
        self.kept = Some(KeptRoute::new(slot, route, !self.was_out));
        storage.put(slot, route);
    }

    /// Sets when the kept route begins. A later START counts only if its moment is later too: one with an earlier
    /// moment is an old message that was overtaken. Returns whether the moment changed.
    pub(crate) fn start(&mut self, seq: u32, at: Instant, show: Option<Instant>) -> bool {
        let Some(kept) = self.kept.as_mut().filter(|kept| kept.seq == seq && !kept.is_late(at, show)) else {
            return false;
        };
        self.was_out = false;
        kept.start(at)
    }

    /// Planned clearance of the route under way, millimetres; `None` without one.
    pub(crate) fn room_mm(&self) -> Option<u16> {
        self.running.as_ref()?.room_mm
    }

    /// Notes a HOLD or a RESUME.
    pub(crate) fn note(&mut self, at: Instant, hold: bool) {
        self.timeline.note(at, hold);
    }

    /// Brings the route under way to rest from `at` on, or from its begin if that is later. Discards the kept route.
    pub(crate) fn rest(&mut self, at: Instant) {
        self.kept = None;
        if let Some(running) = &self.running {
            self.timeline.rest(at.max(running.starts));
        }
    }

    /// Begins the kept route if its moment has come, and returns whether it did. A moment that is past by more than
    /// [`TOO_LATE`] is discarded; it was missed because the clock was unknown.
    #[inline]
    pub(crate) fn begin_due(&mut self, show: Instant, storage: &RouteStorage) -> bool {
        self.kept.is_some() && self.begin_kept(show, storage)
    }

    fn begin_kept(&mut self, show: Instant, storage: &RouteStorage) -> bool {
        if let Some(kept) = self.kept.as_mut() {
            kept.starts = kept.starts.filter(|&at| show - at <= TOO_LATE);
        }
        let due = |kept: &mut KeptRoute| kept.starts.is_some_and(|at| at <= show);
        let Some(KeptRoute { slot, seq, starts: Some(starts), follow, .. }) = self.kept.take_if(due) else {
            return false;
        };
        self.timeline.begin(starts);
        let route = storage.at(slot);
        let path = PathRef::new(route.start, &route.pieces);
        self.running = Some(Running {
            slot,
            seq,
            room_mm: route.room_mm,
            starts,
            duration: path.duration(),
            end: path.end(),
            cursor: RouteCursor::new(route),
            steady: SteadyTime::new(starts),
            follow,
            look_ahead: LookAhead::default(),
            seek: None,
            back: None,
            off_m: 0.0,
            due_off_m: 0.0,
            due: route.start,
            time: Span::ZERO,
            rate: 1.0,
            rests: false,
        });
        true
    }

    /// The next setpoint along the route under way; `None` without one. `takes_effect`: show time when the wheels
    /// answer. `aside`: offset from the route at which to drive, stage metres.
    pub(crate) fn step(
        &mut self,
        takes_effect: Instant,
        body: BodyPose,
        aside: Vec2,
        limits: &Limits,
        storage: &RouteStorage,
    ) -> Option<Setpoint> {
        let running = self.running.as_mut()?;
        let route = storage.at(running.slot);
        let due = self.timeline.at(takes_effect);
        let progress = running.steady.step(takes_effect, due);
        running.cursor.seek(route, progress.time);
        let by_path_time = running.cursor.motion(progress.time);
        let motion = by_show_time(by_path_time, progress.rate);
        (running.due, running.time, running.rate) = (motion.position, progress.time, progress.rate);
        running.rests = progress.rate == 0.0;
        running.off_m = motion.position.distance(body.at);
        running.due_off_m = if progress.time == due.time {
            running.off_m
        } else {
            PathRef::new(route.start, &route.pieces).at(due.time).position.distance(body.at)
        };
        if progress.time >= running.duration
            && (running.seek.is_some() || !running.is_there(progress.time, body.at, motion.position))
        {
            return Some(running.seek.get_or_insert_with(|| Seek::new(motion.position)).step(body, limits));
        }
        let waits = progress.rate == 0.0 && self.timeline.stays_held(takes_effect);
        if waits && (running.back.is_some() || running.off_m > STRAYED_M) {
            // During a hold, a robot that left its route drives back to it. Once the resume is known, it turns to the
            // direction of its route instead.
            let back = running.back.get_or_insert_with(|| Seek::closely(motion.position));
            if running.off_m > BACK_M {
                return Some(back.step(body, limits));
            }
        }
        if running.back.is_some() {
            running.back = None;
        }
        let speed = by_path_time.velocity.length();
        let ahead = if speed < SLOW_MPS {
            running.look_ahead.look(route, running.cursor.piece(), progress.time)
        } else if motion.velocity.length() < RESTING_MPS {
            // A route that is held in motion is at rest: the robot keeps to the tangent there.
            Some(Ahead { towards: by_path_time.velocity / speed, within_s: 0.0 })
        } else {
            None
        };
        let body = if progress.rate == 0.0 { body } else { BodyPose { at: body.at - aside, ..body } };
        Some(running.follow.step(&motion, ahead, body))
    }

    /// Stops turning towards the kept route until its START comes, because other messages after a silence may be old.
    pub(crate) fn await_start(&mut self) {
        if let Some(kept) = &mut self.kept {
            kept.await_start();
        }
    }

    /// Notes that the link was out. That matters only to a robot with a route, because others have nothing that could
    /// be old.
    pub(crate) fn note_outage(&mut self) {
        self.was_out |= self.named() != 0;
        self.await_start();
    }

    /// The setpoint to turn towards the first direction of the kept route; `None` if there is nothing to turn to.
    pub(crate) fn prepare(&mut self, body: BodyPose) -> Option<Setpoint> {
        self.kept.as_mut()?.prepare(body)
    }

    /// Ends the route under way and returns its number if it is over and the robot is at its end; else `None`.
    pub(crate) fn finish(&mut self, show: Instant, at: Vec2) -> Option<u32> {
        let over = |running: &mut Running| {
            let time = self.timeline.at(show).time;
            time >= running.duration && running.is_there(time, at, running.end)
        };
        let done = self.running.take_if(over)?;
        self.finished = done.seq;
        Some(self.finished)
    }

    /// Abandons the route under way.
    pub(crate) fn abandon(&mut self) {
        self.running = None;
    }

    /// Discards all routes.
    pub(crate) fn clear(&mut self) {
        self.running = None;
        self.kept = None;
        self.finished = 0;
        self.was_out = false;
    }

    /// Abandons the route under way and discards all moments, because the show clock was set anew.
    pub(crate) fn forget_moments(&mut self) {
        self.running = None;
        self.timeline = Timeline::new();
        if let Some(kept) = self.kept.as_mut() {
            kept.starts = None;
        }
    }

    /// Whether a route is under way.
    pub(crate) fn under_way(&self) -> bool {
        self.running.is_some()
    }

    /// Whether a route is kept for later.
    pub(crate) fn keeps_one(&self) -> bool {
        self.kept.is_some()
    }

    /// Whether a route is under way or will begin at a known moment.
    pub(crate) fn in_a_run(&self) -> bool {
        self.running.is_some() || self.kept.as_ref().is_some_and(|kept| kept.starts.is_some())
    }

    /// Whether the route under way is held at `show`.
    pub(crate) fn held(&self, show: Option<Instant>) -> bool {
        self.running.is_some() && show.is_some_and(|show| self.timeline.held(show))
    }

    /// Whether the route under way is held and stood still by the latest step.
    pub(crate) fn rests_held(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.rests)
    }

    /// Number of the route that reports name: the one kept, else the one under way, else the one finished last; 0 for
    /// none.
    pub(crate) fn named(&self) -> u32 {
        let running = self.running.as_ref().map(|running| running.seq);
        self.kept.as_ref().map(|kept| kept.seq).or(running).unwrap_or(self.finished)
    }

    /// When the route that reports name begins or began; `None` if that is unknown.
    pub(crate) fn starts(&self) -> Option<Instant> {
        match &self.kept {
            Some(kept) => kept.starts,
            None => self.running.as_ref().map(|running| running.starts),
        }
    }

    /// Place of the route under way once the wheels have answered, stage metres; `None` without one.
    pub(crate) fn due(&self) -> Option<Vec2> {
        self.running.as_ref().map(|running| running.due)
    }

    /// Distance from the present place of the route to its place after `within` more of path time, metres. 0 without a
    /// route under way.
    pub(crate) fn way_ahead_m(&self, within: Span, storage: &RouteStorage) -> f64 {
        let Some(running) = &self.running else { return 0.0 };
        let route = storage.at(running.slot);
        let path = PathRef::new(route.start, &route.pieces);
        path.at(running.time + within).position.distance(running.due)
    }

    /// Distance of the robot from the place of the route under way, metres; `None` without one.
    pub(crate) fn off_m(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.off_m)
    }

    /// Distance of the body from where its route is by the moments of all holds, metres; `None` without a route under
    /// way. While the robot goes back after a late HOLD, that is farther than [`off_m`](Self::off_m).
    pub(crate) fn due_off_m(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.due_off_m)
    }
}

impl Running {
    /// Whether the robot is near enough to the end: within [`NEAR_M`], or after [`TRYING`] by the arrival test of the
    /// original robots.
    fn is_there(&self, time: Span, at: Vec2, end: Vec2) -> bool {
        at.distance(end) <= NEAR_M || time >= self.duration + TRYING && within_arrival(at, end)
    }
}

/// A vector rotated by the angle of a unit vector.
fn turned_by(vector: Vec2, by: Vec2) -> Vec2 {
    Vec2::new(vector.x * by.x - vector.y * by.y, vector.x * by.y + vector.y * by.x)
}

/// Converts motion per path time into motion per show time. The acceleration by the ease of holds is left out: it is
/// too gentle to matter.
fn by_show_time(motion: Motion, rate: f64) -> Motion {
    if rate == 1.0 {
        return motion;
    }
    Motion { velocity: motion.velocity * rate, acceleration: motion.acceleration * (rate * rate), ..motion }
}

#[cfg(test)]
#[path = "routes_tests.rs"]
mod tests;

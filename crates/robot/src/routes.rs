//! The route under way, the route that is kept for later, and when they begin. START names the moment at which a kept
//! route begins. Path time is how far along its route a robot should be, as a time. HOLD slows path time to a stop, and
//! RESUME lets path time run again.

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

/// Distance to the end of its route within which a robot has arrived, metres. With a smaller value, robots with noisy
/// fixes arrive late. With a larger value, pictures look blurred.
const NEAR_M: f64 = 0.0125;
/// Path time after the end of a route from which the coarser arrival test of the original robots (20 mm) is enough.
/// With a larger value, a robot that cannot get nearer to its place arrives later.
const TRYING: Span = Span::from_millis(1500);
/// During a hold, a robot farther than this from the present place of its route drives back there, metres. With a
/// smaller value, noise makes the robot turn on the spot. With a larger value, robots near it have less room than
/// planned.
const STRAYED_M: f64 = 0.0055;
/// The drive back ends within this distance of the place of the route, metres. The difference to [`STRAYED_M`] is
/// hysteresis.
const BACK_M: f64 = 0.004;
/// A route is an old message that arrived late if its number is the newest one or below it by less than this. A route
/// whose number is farther below comes from a restarted controller. With a smaller value, more late messages count as
/// new routes.
const OLD_NUMBERS: u32 = 64;

const _: () = assert!(BACK_M < STRAYED_M && STRAYED_M < NEAR_M);

/// The route under way.
#[derive(Debug)]
struct Running {
    starts: Instant,
    /// Where the route ends, stage metres.
    end: Vec2,
    look_ahead: LookAhead,
    /// The drive to the end of the route, if the route is over and the robot has not arrived; otherwise `None`.
    seek: Option<Seek>,
    /// The drive back to the place of the route during a hold; otherwise `None`.
    back: Option<Seek>,
    slot: Slot,
    /// Whether path time stands still at the moment when the latest setpoint takes effect.
    rests: bool,
    room_mm: Option<u16>,
    seq: u32,
    duration: Span,
    /// Path time at the moment when the latest setpoint takes effect.
    time: Span,
    /// Rate of path time at `time`, in path time per show time, 0 to 1. Negative while path time goes back.
    rate: f64,
    /// Place of the route at `time`, stage metres.
    due: Vec2,
    off_m: f64,
    /// Distance between the robot and the place where the route should be by all known holds, metres. It differs from
    /// `off_m` while path time goes back after a late HOLD.
    due_off_m: f64,
    cursor: RouteCursor,
    steady: SteadyTime,
    follow: Follow,
}

/// The routes of a robot. Their pieces lie in [`RouteStorage`].
#[derive(Debug)]
pub(crate) struct Routes {
    running: Option<Running>,
    timeline: Timeline,
    kept: Option<KeptRoute>,
    /// Number of the route that was finished last; 0 if none was since power-on or the latest STOP or TARGET.
    finished: u32,
    /// Whether the link was out since the latest accepted START, STOP or TARGET. If so, a received route may be an old
    /// message, and the robot does not turn towards it before its START.
    was_out: bool,
}

impl Routes {
    pub(crate) fn new() -> Self {
        Self { running: None, kept: None, timeline: Timeline::new(), finished: 0, was_out: false }
    }

    /// Keeps a route until its START; it replaces the route that was kept before. Old messages change nothing, and
    /// neither do copies of the route that is kept, under way or just finished.
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

    /// Handles a START: sets that the kept route with the number `seq` begins at the moment `at`, show clock. A START
    /// that comes too late is ignored. A further START counts only if its moment is later: a START with an earlier
    /// moment is an old message that was overtaken. Returns whether the moment changed.
    pub(crate) fn start(&mut self, seq: u32, at: Instant, show: Option<Instant>) -> bool {
        let Some(kept) = self.kept.as_mut().filter(|kept| kept.seq == seq && !kept.is_late(at, show)) else {
            return false;
        };
        self.was_out = false;
        kept.start(at)
    }

    /// Planned clearance of the route under way, millimetres; `None` if no route is under way or its clearance is
    /// unknown.
    pub(crate) fn room_mm(&self) -> Option<u16> {
        self.running.as_ref()?.room_mm
    }

    /// Notes a HOLD (`hold`) or a RESUME for the moment `at`, show clock.
    pub(crate) fn note(&mut self, at: Instant, hold: bool) {
        self.timeline.note(at, hold);
    }

    /// Slows the route under way to rest from the moment `at` (show clock) on, or from its start if that is later.
    /// Discards the kept route.
    pub(crate) fn rest(&mut self, at: Instant) {
        self.kept = None;
        if let Some(running) = &self.running {
            self.timeline.rest(at.max(running.starts));
        }
    }

    /// Begins the kept route if its start time has come at `show`, and returns whether it began. A start time that is
    /// past by more than [`TOO_LATE`] is discarded, for example if the show clock was unknown at that time.
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

    /// The next setpoint along the route under way; `None` if no route is under way. `takes_effect`: show time at which
    /// the setpoint takes effect. `aside`: offset from the route at which the robot shall drive, stage metres. It is
    /// ignored while path time stands still, and on the drive to the end of a route that is over.
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

    /// Stops turning towards the kept route until its START comes. After a silence of the link, any other message may
    /// be old.
    pub(crate) fn await_start(&mut self) {
        if let Some(kept) = &mut self.kept {
            kept.await_start();
        }
    }

    /// Notes that the link was out, and stops turning towards the kept route until its START comes. The outage is noted
    /// only for a robot that keeps, drives or has finished a route: only then can a message about routes be old.
    pub(crate) fn note_outage(&mut self) {
        self.was_out |= self.named() != 0;
        self.await_start();
    }

    /// The setpoint that turns the robot towards the first direction of the kept route. `None` if no route is kept, or
    /// the robot shall not turn.
    pub(crate) fn prepare(&mut self, body: BodyPose) -> Option<Setpoint> {
        self.kept.as_mut()?.prepare(body)
    }

    /// Ends the route under way and returns its number. The route must be over at `show` (show clock), and the robot at
    /// `at` (stage metres) must be near enough to its end. Otherwise changes nothing and returns `None`.
    pub(crate) fn finish(&mut self, show: Instant, at: Vec2) -> Option<u32> {
        let over = |running: &mut Running| {
            let time = self.timeline.at(show).time;
            time >= running.duration && running.is_there(time, at, running.end)
        };
        let done = self.running.take_if(over)?;
        self.finished = done.seq;
        Some(self.finished)
    }

    /// Gives up the route under way, without an arrival. The kept route stays.
    pub(crate) fn abandon(&mut self) {
        self.running = None;
    }

    /// Discards all routes, and also the number of the finished route and the note of an outage.
    pub(crate) fn clear(&mut self) {
        self.running = None;
        self.kept = None;
        self.finished = 0;
        self.was_out = false;
    }

    /// Gives up the route under way and forgets holds and resumes, because the show clock was reset. The kept route
    /// stays, but waits for a new START.
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

    /// Whether a route is under way, or is kept with a known start time.
    pub(crate) fn in_a_run(&self) -> bool {
        self.running.is_some() || self.kept.as_ref().is_some_and(|kept| kept.starts.is_some())
    }

    /// Whether a route is under way and a hold is in force at the moment `show`, show clock. `false` if the moment is
    /// unknown.
    pub(crate) fn held(&self, show: Option<Instant>) -> bool {
        self.running.is_some() && show.is_some_and(|show| self.timeline.held(show))
    }

    /// Whether a route is under way whose path time stood still in the latest step.
    pub(crate) fn rests_held(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.rests)
    }

    /// Number of the route that reports name: the kept route, else the route under way, else the route finished last; 0
    /// if there is none.
    pub(crate) fn named(&self) -> u32 {
        let running = self.running.as_ref().map(|running| running.seq);
        self.kept.as_ref().map(|kept| kept.seq).or(running).unwrap_or(self.finished)
    }

    /// When the kept route begins, or else when the route under way began, show clock; `None` if that is unknown.
    pub(crate) fn starts(&self) -> Option<Instant> {
        match &self.kept {
            Some(kept) => kept.starts,
            None => self.running.as_ref().map(|running| running.starts),
        }
    }

    /// Place of the route under way at the moment when the latest setpoint takes effect, stage metres; before its first
    /// step, its start. `None` if no route is under way.
    pub(crate) fn due(&self) -> Option<Vec2> {
        self.running.as_ref().map(|running| running.due)
    }

    /// Straight distance from the present place of the route to its place after `within` more path time, metres. 0 if
    /// no route is under way.
    pub(crate) fn way_ahead_m(&self, within: Span, storage: &RouteStorage) -> f64 {
        let Some(running) = &self.running else { return 0.0 };
        let route = storage.at(running.slot);
        let path = PathRef::new(route.start, &route.pieces);
        path.at(running.time + within).position.distance(running.due)
    }

    /// Distance of the robot from the present place of the route under way, metres; `None` if no route is under way.
    pub(crate) fn off_m(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.off_m)
    }

    /// Distance between the robot and the place where the route should be by all known holds, metres; `None` if no
    /// route is under way. While path time goes back after a late HOLD, it differs from [`off_m`](Self::off_m).
    pub(crate) fn due_off_m(&self) -> Option<f64> {
        self.running.as_ref().map(|running| running.due_off_m)
    }
}

impl Running {
    /// Whether the robot at `at` is near enough to `end`, both stage metres. Near enough is within [`NEAR_M`]. From
    /// [`TRYING`] after the end of the route on, the arrival test of the original robots is enough. `time`: path time.
    fn is_there(&self, time: Span, at: Vec2, end: Vec2) -> bool {
        at.distance(end) <= NEAR_M || time >= self.duration + TRYING && within_arrival(at, end)
    }
}

/// Returns `vector` rotated by the angle of the unit vector `by`.
fn turned_by(vector: Vec2, by: Vec2) -> Vec2 {
    Vec2::new(vector.x * by.x - vector.y * by.y, vector.x * by.y + vector.y * by.x)
}

/// Converts motion per path time into motion per show time, for a `rate` of path time per show time. The acceleration
/// while a hold slows the rate is neglected, because it is small.
fn by_show_time(motion: Motion, rate: f64) -> Motion {
    if rate == 1.0 {
        return motion;
    }
    Motion { velocity: motion.velocity * rate, acceleration: motion.acceleration * (rate * rate), ..motion }
}

#[cfg(test)]
#[path = "routes_tests.rs"]
mod tests;

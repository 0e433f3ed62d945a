//! The second part of a step: the wheel rates, and arrivals.

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Span, Vec2};

use super::state::Robot;
use crate::drive::{BodyPose, Setpoint};
use crate::reflex::Wish;
use crate::storage::RouteStorage;

/// While fixes are overdue, a robot does not report its arrival if the error of its place is larger than this, metres,
/// 1 sigma. With a smaller value, a robot that loses its fixes at the end of a route arrives only once fixes come
/// again. With a larger value, the robot reports arrivals at places where it does not stand.
const SURE_M: f64 = 0.003;
/// While fixes are overdue, a robot stops and waits for fixes once its predicted error is larger than this, metres, 1
/// sigma. That is the error of its place after braking. It is less than the error that makes the robot lost (20 mm).
/// With a smaller value, the robot pauses in short outages. With a larger value, the robot becomes lost and abandons
/// its route.
const PAUSE_M: f64 = 0.016;
/// Speed at which a robot with unknown heading drives straight on to learn its heading from its motion, m/s. With a
/// smaller value, noise of the fixes hides the direction for longer. With a larger value, the robot drives too far
/// before it knows its heading.
const CREEP_MPS: f64 = 0.08;

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    /// Returns the wheel rates until the next step, left and right, rad/s. If the robot has arrived, also queues the
    /// report of the arrival. A faulty robot stands and does not arrive.
    pub(super) fn act(&mut self, now: Instant, route_time: Option<Instant>, took: Span) -> [f64; 2] {
        if self.hot.supervisor.faulty(now) {
            return self.hot.drive.halt();
        }
        let dt = took.as_secs();
        let may_drive = !self.hot.supervisor.is_cut() && !self.is_lost_now();
        let wanted = if may_drive { self.want(route_time, took) } else { None };
        let pauses = self.pauses();
        let wanted =
            wanted.filter(|_| !pauses).unwrap_or_else(|| self.hot.drive.rolling_out(dt, &self.hot.limits));
        let wheels = if self.hot.is_wary {
            self.drive_warily(wanted, dt)
        } else {
            let hot = &mut self.hot;
            hot.drive.gently = false;
            hot.drive.step(wanted, hot.estimate.slip(), dt, &hot.limits)
        };
        self.arrive(route_time);
        wheels
    }

    /// Returns the wheel rates towards the wanted setpoint that the safety layer allows, left and right, rad/s. `dt`:
    /// length of the step, seconds.
    #[inline(never)]
    fn drive_warily(&mut self, wanted: Setpoint, dt: f64) -> [f64; 2] {
        let hot = &mut self.hot;
        let rolls_out = !hot.routes.under_way() && hot.seek.is_none() && hot.drive.rolls();
        let most_mps = if hot.routes.under_way() || rolls_out {
            let [speed_mps, told_mps] = [wanted.speed_mps, hot.drive.speed_mps()].map(|mps| mps as f32);
            let wish = Wish { speed_mps, told_mps, dt: dt as f32 };
            let are_told = hot.routes.tells_neighbours(hot.range_m, self.storage.borrow());
            let most_mps = self.reflex.limit(wish, hot.routes.room_mm().filter(|_| !are_told));
            self.reflex.note(hot.now);
            most_mps
        } else {
            self.reflex.forget();
            None
        };
        hot.drive.gently = self.reflex.sees_strays();
        let slip = hot.estimate.slip();
        match (self.reflex.blocked_mps(), most_mps) {
            // A robot that rolls out was about to stand anyway.
            (Some(_), _) if rolls_out => hot.drive.halt(),
            // A robot that rests on a held route still turns on the spot towards the direction in which the route goes
            // on.
            (Some(0.0), _) if !hot.routes.rests_held() => hot.drive.halt(),
            (Some(speed_mps), _) if !hot.routes.rests_held() => {
                hot.drive.step(Setpoint { speed_mps, turn_radps: 0.0 }, slip, dt, &hot.limits)
            }
            (_, Some(most_mps)) => hot.drive.step_within(wanted, most_mps, slip, dt, &hot.limits),
            (_, None) => hot.drive.step(wanted, slip, dt, &hot.limits),
        }
    }

    /// Returns whether the robot stands still until fixes come again, because it might be lost if it drove on. See
    /// [`PAUSE_M`]. Stores the result in `Hot::pauses`.
    fn pauses(&mut self) -> bool {
        let hot = &mut self.hot;
        hot.pauses = hot.quality.blind
            && (hot.pauses || hot.estimate.error_at_worst_m(hot.drive.braking_m(&hot.limits)) > PAUSE_M);
        hot.pauses
    }

    /// The setpoint before the safety layer limits it: along the route under way, else to the target, else a turn
    /// towards the first direction of the kept route. A robot with unknown heading drives straight on slowly instead of
    /// along a route or to a target. `None` if there is nothing to drive or to turn to. A kept route alone also gives
    /// `None` during a silence, or while the heading is unknown.
    fn want(&mut self, route_time: Option<Instant>, took: Span) -> Option<Setpoint> {
        let hot = &mut self.hot;
        if !hot.routes.under_way() && hot.seek.is_none() && !hot.routes.keeps_one() {
            return None;
        }
        if !hot.estimate.aligned() {
            let drives = hot.routes.under_way() || hot.seek.is_some();
            return drives.then_some(Setpoint { speed_mps: CREEP_MPS, turn_radps: 0.0 });
        }
        let body = BodyPose { at: hot.estimate.at(), facing: hot.estimate.facing() };
        let soon = hot.drive.foresee(body, took.as_secs());
        if let Some(time) = route_time.filter(|_| hot.routes.under_way()) {
            let aside = if hot.is_wary {
                let away = self.reflex.give_way(hot.routes.room_mm());
                soon.facing * away.x + soon.facing.left() * away.y
            } else {
                Vec2::ZERO
            };
            return hot.routes.step(time + took, soon, aside, &hot.limits, self.storage.borrow());
        }
        match hot.seek.as_mut() {
            Some(seek) => Some(seek.step(soon, &hot.limits)),
            // A silent controller may be gone for good, and people may come to look: the robot does not turn.
            None if hot.supervisor.is_silent(hot.now) => {
                hot.routes.await_start();
                None
            }
            None => hot.routes.prepare(soon),
        }
    }

    /// Once the robot stands at the end of its route or at its target, queues the report of the arrival and ends that
    /// drive. A lost robot does not arrive. While fixes are overdue, a robot does not arrive if the error of its place
    /// exceeds [`SURE_M`].
    fn arrive(&mut self, route_time: Option<Instant>) {
        let is_lost = self.is_lost_now();
        let hot = &mut self.hot;
        if !hot.drive.stands() || is_lost {
            return;
        }
        if hot.quality.blind && hot.estimate.error_m() > SURE_M {
            return;
        }
        let at = hot.estimate.at();
        if let Some(route) = route_time.and_then(|time| hot.routes.finish(time, at)) {
            hot.outbox.arrived(route);
        }
        if hot.seek.take_if(|seek| seek.reached(at)).is_some() {
            hot.outbox.arrived(0);
        }
    }
}

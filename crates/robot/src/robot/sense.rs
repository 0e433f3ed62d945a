//! The first part of a step: sensor readings correct the estimates.

use core::borrow::BorrowMut;

use lightbots_base::{Instant, Span};

use super::state::Robot;
use crate::config::{Inputs, SENSORS};
use crate::drive::BodyPose;
use crate::routes::InSight;
use crate::storage::RouteStorage;

/// A robot abandons its route if its estimated place jumps by more than this, metres: about a robot's size. It also
/// abandons a route that begins farther than this from its place. With a smaller value, a robot that was pushed aside
/// does not go back on its route. With a larger value, a robot that was lifted drives through others.
pub(super) const AWAY_M: f64 = 0.05;
/// Largest length of a step; longer gaps between steps are cut to it. With a larger value, a pause of the simulation
/// would move a robot along its route without its wheels. With a smaller value, a board that skips a few steps would
/// fall behind its route.
pub(super) const LONGEST_STEP: Span = Span::from_millis(100);
/// A planned neighbour may be in sight up to this much beyond the sensors' range, metres, because both robots deviate
/// from their planned places. With a smaller value, the safety layer takes a planned neighbour for a stranger. With a
/// larger value, the safety layer compares more neighbours than necessary.
const OFF_PLAN_M: f64 = 0.025;
/// Largest valid wheel turn in a step, as a multiple of what the motors can turn in the longest step. A larger reading
/// means that the sensor is broken, and counts as a fault. With a larger value, more wrong readings reach the estimate.
const WHEEL_TURN_RESERVE: f64 = 2.0;

impl<S: BorrowMut<RouteStorage>> Robot<S> {
    pub(super) fn sense(&mut self, world: Instant, inputs: &Inputs, dt: f64) {
        let hot = &mut self.hot;
        let most = hot.limits.wheel_radps * LONGEST_STEP.as_secs() * WHEEL_TURN_RESERVE;
        if inputs.wheel_turns_rad.iter().all(|turn| turn.abs() <= most) {
            hot.estimate.advance(world, inputs.wheel_turns_rad, &mut self.storage.borrow_mut().history);
            let sees = inputs.proximity_m.as_ref().filter(|gaps_m| is_any_within(gaps_m, hot.range_m));
            if hot.is_wary || sees.is_some() {
                self.sense_neighbours(inputs.wheel_turns_rad, sees, dt);
            }
            if self.hot.stall.sample(inputs.wheel_turns_rad, dt) {
                self.hot.supervisor.fault(self.hot.now);
            }
        } else {
            hot.supervisor.fault(hot.now);
        }
        if let Some(fix) = &inputs.fix {
            self.hot.estimate.correct(world, fix, &self.storage.borrow().history);
            if self.hot.estimate.take_jump_m() > AWAY_M {
                self.hot.routes.abandon();
            }
            if self.hot.estimate.take_senseless() {
                self.hot.supervisor.fault(self.hot.now);
            }
        }
        if let Some(percent) = inputs.battery {
            self.battery = Some(percent.min(100));
        }
    }

    /// Passes the wheel turns, the proximity readings and the planned neighbours that may be in sight to the safety
    /// layer. `dt`: length of the step, seconds.
    #[inline(never)]
    fn sense_neighbours(&mut self, [left, right]: [f64; 2], gaps_m: Option<&[f32; SENSORS]>, dt: f64) {
        let hot = &mut self.hot;
        let way_m = 0.5 * (left + right) * hot.limits.wheel_radius_m;
        let turn_rad = (right - left) * hot.limits.wheel_radius_m / hot.limits.track_m;
        let mut expected = InSight::new();
        let body = BodyPose { at: hot.estimate.at(), facing: hot.estimate.facing() };
        let sight_m = hot.limits.contact_m() + f64::from(hot.range_m) + OFF_PLAN_M;
        hot.routes.expect(body, sight_m, self.storage.borrow(), &mut expected);
        self.reflex.look(gaps_m, (way_m, turn_rad), dt, &expected, hot.estimate.error_m());
        hot.is_wary = true;
    }
}

/// Whether any reading is less than `range_m`, metres. Compares all readings, because that is quicker than to stop at
/// the first that is less.
#[inline]
fn is_any_within(gaps_m: &[f32; SENSORS], range_m: f32) -> bool {
    gaps_m.iter().fold(false, |any, &gap_m| any | (gap_m < range_m))
}

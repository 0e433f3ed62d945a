//! What happens to robots from outside: their power comes back, they are lifted and put down elsewhere.

use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_robot::Config;
use lightbots_show::Stage;
use lightbots_wire::RobotState;

use super::RobotSet;
use crate::firmware::{Ours, RobotFirmware};
use crate::original::Original;

/// Gap of rims between a robot that a person puts down and its neighbours, metres.
const PUT_DOWN_GAP_M: f64 = 0.03;
/// Scale of the spiral of places that are tried, metres: place n lies this times the square root of n from the first.
const TRIED_EVERY_M: f64 = 0.02;
/// Number of places that are tried. The last one is 1.3 m away.
const TRIED: u32 = 4_000;
/// Angle between places that are tried one after the other, radians: the golden angle, which fills a disc evenly (Vogel,
/// 1979).
const GOLDEN_RAD: f64 = 2.399_963_229_728_653;

impl RobotSet {
    /// Switches a robot on again after its power failed, with a link.
    pub fn restart(&mut self, now: Instant, robot: usize) {
        self.restart_as(now, robot, self.robots[robot].id);
    }

    /// Switches a robot off and on, with a new name.
    pub fn restart_as(&mut self, now: Instant, robot: usize, id: RobotId) {
        let simulated = &mut self.robots[robot];
        simulated.id = id;
        simulated.clock.restart(now);
        simulated.firmware = match &simulated.firmware {
            RobotFirmware::Ours(before) => RobotFirmware::Ours(Ours::with_storage(
                Config { id, ..before.config().clone() },
                Box::default(),
            )),
            RobotFirmware::Original(_) => RobotFirmware::Original(Original::new(id)),
        };
        self.alive[robot] = true;
        self.link(now, robot, true);
    }

    /// Puts a robot down at the free place that is nearest to `to`. The robot stays where it is if none is free.
    pub fn put_down(&mut self, robot: usize, to: Vec2) {
        if let Some(place) = self.free_place(robot, to) {
            self.world.put(robot, place);
        }
    }

    /// Puts a person's foot on the floor, at the free place that is nearest to `to`. `None`: takes it off.
    pub fn put_foot(&mut self, stage: &Stage, to: Option<Vec2>) {
        let place = to.and_then(|to| self.free_place(self.robots.len(), to));
        self.world.put_foot(stage, place);
    }

    /// The place nearest to `to` that is free for a disc; `None` if no place that is tried is free.
    fn free_place(&self, disc: usize, to: Vec2) -> Option<Vec2> {
        let place = |number: u32| {
            let off_m = TRIED_EVERY_M * libm::sqrt(f64::from(number));
            to + Vec2::unit(GOLDEN_RAD * f64::from(number)) * off_m
        };
        (0..TRIED).map(place).find(|&place| self.world.is_free(disc, place, PUT_DOWN_GAP_M))
    }

    /// Whether a robot has power.
    pub fn is_on(&self, robot: usize) -> bool {
        self.alive[robot]
    }

    /// Whether a robot runs our firmware, which reports its place on the way.
    pub fn is_ours(&self, robot: usize) -> bool {
        matches!(self.robots[robot].firmware, RobotFirmware::Ours(_))
    }

    /// Place at this moment on the route that a robot follows, stage metres; `None` without a route.
    pub fn route_place(&self, robot: usize) -> Option<Vec2> {
        match &self.robots[robot].firmware {
            RobotFirmware::Ours(robot) => robot.route_place(),
            RobotFirmware::Original(_) => None,
        }
    }

    /// Whether a robot may drive although it receives nothing, because it drives to a target (R44 of docs/protocol.md).
    pub fn is_on_target(&self, robot: usize) -> bool {
        match &self.robots[robot].firmware {
            RobotFirmware::Ours(robot) => {
                robot.state() == RobotState::Driving && robot.route_place().is_none()
            }
            RobotFirmware::Original(_) => true,
        }
    }
}

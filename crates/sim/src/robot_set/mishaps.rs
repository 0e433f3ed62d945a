//! What happens to robots from outside: their power comes back, or a person lifts them and puts them down elsewhere.

use lightbots_base::{Instant, RobotId, Vec2};
use lightbots_robot::Config;
use lightbots_show::Stage;
use lightbots_wire::RobotState;

use super::RobotSet;
use crate::firmware::{Ours, RobotFirmware};
use crate::original::Original;

/// Least gap between the rim of a robot or foot that is put down and the rims of other robots, metres.
const PUT_DOWN_GAP_M: f64 = 0.03;
/// Scale of the spiral of places that are tried, metres. Place n is this times the square root of n from the first
/// place.
const TRIED_EVERY_M: f64 = 0.02;
/// Number of places that are tried. The last place is 1.3 m from the first.
const TRIED: u32 = 4_000;
/// Angle between successive places of the spiral, radians: the golden angle, which fills a disc evenly (Vogel, 1979).
const GOLDEN_RAD: f64 = 2.399_963_229_728_653;

impl RobotSet {
    /// Switches a robot on again after its power failed, with its old name and a link.
    pub fn restart(&mut self, now: Instant, robot: usize) {
        self.restart_as(now, robot, self.robots[robot].id);
    }

    /// Switches a robot off and on. Its firmware starts without memory, with the name `id` and a link.
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

    /// Puts a robot down at the free place nearest to `to` among those tried. It stays where it is if none of them is
    /// free.
    pub fn put_down(&mut self, robot: usize, to: Vec2) {
        if let Some(place) = self.free_place(robot, to) {
            self.world.put(robot, place);
        }
    }

    /// Puts a person's foot on the floor, at the free place nearest to `to` among those tried. If `to` is `None`, or no
    /// place is free, the foot goes beside the floor.
    pub fn put_foot(&mut self, stage: &Stage, to: Option<Vec2>) {
        let place = to.and_then(|to| self.free_place(self.robots.len(), to));
        self.world.put_foot(stage, place);
    }

    /// The place nearest to `to`, among those tried, that is free for the disc with this index; `None` if none is free.
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

    /// Place where the route wants the robot at this moment, stage metres; `None` if the robot follows no route.
    pub fn route_place(&self, robot: usize) -> Option<Vec2> {
        match &self.robots[robot].firmware {
            RobotFirmware::Ours(robot) => robot.route_place(),
            RobotFirmware::Original(_) => None,
        }
    }

    /// Whether a robot may drive although it receives nothing: it drives to a target (R44 of docs/protocol.md). Always
    /// true for an original robot.
    pub fn is_on_target(&self, robot: usize) -> bool {
        match &self.robots[robot].firmware {
            RobotFirmware::Ours(robot) => {
                robot.state() == RobotState::Driving && robot.route_place().is_none()
            }
            RobotFirmware::Original(_) => true,
        }
    }
}

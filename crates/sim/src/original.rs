//! A robot of the first LightBots, as far as its program is known. It turns towards its target on the spot, drives at
//! full speed and corrects small heading errors in a curve. It stops its wheels once both coordinates are within 20 mm.

use lightbots_base::{Pose, Rgb, RobotId, Vec2, wrap};
use lightbots_robot::Message;
use lightbots_wire::{Command, Report, Topic, commands};

/// The robot has arrived if no coordinate differs from the target's by more than this, metres.
const ARRIVED_M: f64 = 0.02;
/// Wheel rate of a straight drive, rad/s.
const CRUISE_RADPS: f64 = 60.0;
/// Wheel rate of a turn on the spot, rad/s.
const SPIN_RADPS: f64 = 20.0;
/// Error of the heading above which the robot begins to turn on the spot, radians.
const SPIN_FROM_RAD: f64 = 0.35;
/// Error of the heading at which a turn on the spot ends, radians.
const SPIN_TO_RAD: f64 = 0.1;
/// In a curve, the inner wheel turns slower by this times the error of the heading in radians, rad/s. It does not turn
/// backwards.
const CURVE_RADPS: f64 = 100.0;
/// Largest number of UUID reports that wait to be sent. Further requests are ignored.
const WAITING: usize = 16;

/// One robot, which understands only TARGET, COLOR and UUID.
#[derive(Debug)]
pub(crate) struct Original {
    id: RobotId,
    target: Option<Vec2>,
    spins: bool,
    light: Rgb,
    at: Option<Vec2>,
    /// Whether its program ended, because it lost the broker.
    ended: bool,
    introduces: usize,
    arrived: bool,
}

/// Outputs of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OriginalOutputs {
    /// Wheel rates, left and right, rad/s.
    pub wheels_radps: [f64; 2],
    pub light: Rgb,
}

impl Original {
    /// A robot that was just switched on.
    pub fn new(id: RobotId) -> Self {
        Self {
            id,
            target: None,
            spins: false,
            light: Rgb::BLACK,
            at: None,
            ended: false,
            introduces: 0,
            arrived: false,
        }
    }

    /// Brings its link up, after which the robot reports its UUID once, or breaks it. When the link breaks, the robot's
    /// program ends for good.
    pub fn link(&mut self, up: bool) {
        self.ended |= !up;
        self.introduces = usize::from(up && !self.ended);
    }

    /// Handles a message that the robot received.
    pub fn receive(&mut self, payload: &[u8]) {
        if self.ended {
            return;
        }
        for command in commands(payload).flatten() {
            match command {
                Command::Target(at) => {
                    (self.target, self.spins, self.arrived) = (Some(at), true, false);
                }
                Command::Color(color) => self.light = color,
                Command::Uuid => self.introduces = (self.introduces + 1).min(WAITING),
                _ => {}
            }
        }
    }

    /// Takes one step. `fix`: the robot's pose; without it, the wheels stand.
    pub fn step(&mut self, fix: Option<Pose>) -> OriginalOutputs {
        self.at = fix.map(|fix| fix.at).or(self.at);
        let wheels_radps = fix.filter(|_| !self.ended).map_or([0.0; 2], |pose| self.drive(pose));
        OriginalOutputs { wheels_radps, light: self.light }
    }

    fn drive(&mut self, pose: Pose) -> [f64; 2] {
        let Some(target) = self.target else { return [0.0; 2] };
        let way = target - pose.at;
        if way.x.abs() <= ARRIVED_M && way.y.abs() <= ARRIVED_M {
            (self.target, self.arrived) = (None, true);
            return [0.0; 2];
        }
        let off_rad = wrap(way.y.atan2(way.x) - pose.heading);
        self.spins = off_rad.abs() > if self.spins { SPIN_TO_RAD } else { SPIN_FROM_RAD };
        if self.spins {
            let rate = SPIN_RADPS.copysign(off_rad);
            return [-rate, rate];
        }
        let slower = (CURVE_RADPS * off_rad.abs()).min(CRUISE_RADPS);
        if off_rad > 0.0 {
            [CRUISE_RADPS - slower, CRUISE_RADPS]
        } else {
            [CRUISE_RADPS, CRUISE_RADPS - slower]
        }
    }

    /// Writes the robot's next message to `payload`. Returns its topic; `None` if there is no message.
    pub fn outgoing(&mut self, payload: &mut Message) -> Option<Topic> {
        let topic = if std::mem::take(&mut self.arrived) {
            Topic::Arrival
        } else {
            self.introduces = self.introduces.checked_sub(1)?;
            Topic::Uuid
        };
        payload.clear();
        Report { id: self.id, at: self.at, details: None }.encode(payload).ok()?;
        Some(topic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(robot: &mut Original) -> Vec<(Topic, String)> {
        let mut payload = Message::new();
        std::iter::from_fn(|| robot.outgoing(&mut payload).map(|topic| (topic, payload.as_str().to_string())))
            .collect()
    }

    #[test]
    fn it_turns_drives_and_arrives_once_for_each_target() {
        let mut robot = Original::new(RobotId::new("old").unwrap());
        let payload_of = |robot: &mut Original, text: &str| robot.receive(text.as_bytes());
        payload_of(&mut robot, "|TARGET 1.0 0,0||COLOR 255||DANCE|");
        let away = robot.step(Some(Pose::new(Vec2::ZERO, 2.0)));
        assert_eq!(away, OriginalOutputs { wheels_radps: [20.0, -20.0], light: Rgb::new(0, 0, 255) });
        assert_eq!(robot.step(Some(Pose::new(Vec2::ZERO, 0.0))).wheels_radps, [60.0, 60.0]);
        assert_ne!(robot.step(Some(Pose::new(Vec2::new(0.98, 0.021), 0.0))).wheels_radps, [0.0; 2]);
        let near = Pose::new(Vec2::new(0.981, 0.019), 0.0);
        assert_eq!(robot.step(Some(near)).wheels_radps, [0.0; 2]);
        robot.step(Some(near));
        assert_eq!(said(&mut robot), [(Topic::Arrival, "old 0.981 0.019".to_string())]);
        payload_of(&mut robot, "|TARGET 1.0 0.0||UUID|");
        robot.step(Some(near));
        assert_eq!(
            said(&mut robot).iter().map(|said| said.0).collect::<Vec<_>>(),
            [Topic::Arrival, Topic::Uuid]
        );
    }

    #[test]
    fn without_a_broker_it_ends() {
        let mut robot = Original::new(RobotId::new("old").unwrap());
        robot.link(true);
        robot.receive(b"TARGET 1 0");
        robot.link(false);
        assert_eq!(robot.step(Some(Pose::default())).wheels_radps, [0.0; 2]);
        robot.link(true);
        assert_eq!(said(&mut robot), []);
    }
}

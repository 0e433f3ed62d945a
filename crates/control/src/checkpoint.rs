//! A checkpoint: a controller at rest as bytes. At rest there is no run, robots are not being stopped, and all outputs
//! were taken.
//!
//! An input log holds these bytes in its header, so that a run is replayed without the hours before it.

use crate::controller::Controller;
use crate::robot::KnownRobot;
use lightbots_base::Vec2;

impl Controller {
    /// Whether there is no run, robots are not being stopped, and all outputs were taken.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.run.is_none()
            && self.stopping.is_none()
            && self.context.plan_request.is_none()
            && self.context.outbox.is_drained()
            && self.context.log.is_drained()
    }

    /// Returns the controller as bytes; `None` if it is not at rest.
    pub(crate) fn checkpoint(&self) -> Option<Vec<u8>> {
        if self.is_at_rest() { postcard::to_allocvec(self).ok() } else { None }
    }

    /// Restores the controller of a checkpoint; `None` if the bytes are not valid. `bytes` may be anything: this is
    /// checked.
    pub(crate) fn from_checkpoint(bytes: &[u8]) -> Option<Self> {
        let mut controller: Self = postcard::from_bytes(bytes).ok()?;
        if !controller.context.fleet.reindex() {
            return None;
        }
        for index in 0..controller.context.fleet.robots().len() {
            check(controller.context.fleet.robot_mut(index));
        }
        Some(controller)
    }
}

/// Removes from a robot what a controller at rest cannot hold: a participant number, and a reported place or a goal
/// that is not finite.
fn check(robot: &mut KnownRobot) {
    let is_finite = |at: &Vec2| at.x.is_finite() && at.y.is_finite();
    robot.participant = None;
    robot.reported.at = robot.reported.at.filter(is_finite);
    robot.last_run.goal = robot.last_run.goal.filter(is_finite);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Config, Operation};
    use lightbots_base::{Instant, RobotId};
    use lightbots_show::{Frame, Layer, LayerSpan, Pixel, Show};
    use std::sync::Arc;

    fn lived() -> Controller {
        let mut controller = Controller::new(Config { seq_base: 77, ..Config::default() });
        controller.connected(Instant(10));
        let show = Show {
            name: "Ä".into(),
            layers: vec![Layer {
                name: "glow".into(),
                kind: "pulse".into(),
                span: LayerSpan::default(),
                settings: Vec::new(),
            }],
            frames: vec![Frame {
                air_time_s: 0.1 + 0.2,
                pixels: vec![Pixel { id: 3, at: Vec2::new(1.0 / 3.0, -0.0), ..Pixel::default() }],
                ..Frame::default()
            }],
            ..Show::default()
        };
        controller.operate(Instant(20), Operation::Open(Arc::new(show))).unwrap();
        controller.operate(Instant(30), Operation::Pin { pixel: 3, robot: RobotId::new("b") }).unwrap();
        for (at, text) in [(40, "a 0.1 0.2"), (50, "b 0.3 nan st=idle bat=80"), (60, "junk")] {
            controller.message(Instant(at), "T/LightBot/Status", text.as_bytes());
        }
        controller
    }

    #[test]
    fn a_controller_goes_to_bytes_and_back() {
        let mut controller = lived();
        assert_eq!(controller.checkpoint(), None, "messages and events wait");
        while controller.next_send().is_some() {}
        while controller.next_event().is_some() {}
        let bytes = controller.checkpoint().unwrap();
        let again = Controller::from_checkpoint(&bytes).unwrap();
        assert_eq!(again.checkpoint(), Some(bytes));
        assert_eq!(again.snapshot(Instant(70)), controller.snapshot(Instant(70)));
        assert_eq!(again.show(), controller.show());
        assert_eq!(again.wake_at(), controller.wake_at());
    }

    #[test]
    fn bytes_that_are_no_checkpoint_are_refused_or_read_without_a_panic() {
        let mut controller = lived();
        while controller.next_send().is_some() {}
        while controller.next_event().is_some() {}
        let bytes = controller.checkpoint().unwrap();
        for cut in 0..bytes.len() {
            assert!(Controller::from_checkpoint(&bytes[..cut]).is_none(), "cut at {cut}");
        }
        for at in 0..bytes.len() {
            for bit in 0..8 {
                let mut changed = bytes.clone();
                changed[at] ^= 1 << bit;
                if let Some(mut controller) = Controller::from_checkpoint(&changed) {
                    controller.wake(Instant(80));
                }
            }
        }
    }
}

//! The colours that robots show for a lighting desk, for screens.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use lightbots_base::{Rgb, RobotId};
use lightbots_control::Snapshot;

/// Colours from a lighting desk, by robot. Clones share them.
#[derive(Clone, Debug, Default)]
pub struct DeskLights(Arc<Mutex<BTreeMap<RobotId, Rgb>>>);

impl DeskLights {
    /// Replaces all colours.
    pub fn set(&self, lights: impl Iterator<Item = (RobotId, Rgb)>) {
        *self.lock() = lights.collect();
    }

    /// Replaces the controller's colours in a snapshot by those of the lighting desk. Robots for which the desk has no
    /// colour keep the colour of the controller.
    pub fn cover(&self, snapshot: &mut Snapshot) {
        let lights = self.lock();
        if lights.is_empty() {
            return;
        }
        for robot in &mut snapshot.robots {
            robot.light = lights.get(&robot.id).copied().unwrap_or(robot.light);
        }
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<RobotId, Rgb>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

//! What only a simulator knows of a rehearsal.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId, Vec2};

use crate::model::ShowReport;
use crate::track::PlaceTrack;

/// What the simulator of a rehearsal knows, and what the recorded messages of its robots do not contain.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Number of contacts of two rims.
    pub contacts: u64,
    /// Number of times that the safety layer began to slow a robot.
    pub brakes: u64,
    /// How many of `brakes` happened without a faulty or off-route robot ahead.
    pub false_brakes: u64,
    /// Number of messages that were lost on the way.
    pub messages_lost: u64,
    /// Smallest gap between two rims, metres; `None`: no two robots came near each other.
    pub closest_m: Option<f64>,
    places: BTreeMap<RobotId, PlaceTrack>,
}

impl Truth {
    /// Adds the true place of a robot, stage metres, at a moment of the show clock. Samples of one robot must come in order
    /// of time.
    pub fn add(&mut self, at: Instant, robot: RobotId, place: Vec2) {
        self.places.entry(robot).or_default().add(at.as_secs(), place);
    }

    /// Fills in the figures of a report that a recording alone does not give. The true number of brakes and the true
    /// closest gap replace the reported ones.
    pub(crate) fn tell(&self, report: &mut ShowReport) {
        report.contacts = Some(self.contacts);
        report.brakes.all = self.brakes;
        report.brakes.unfounded = Some(self.false_brakes);
        report.messages.lost = Some(self.messages_lost);
        report.closest_m = self.closest_m;
        report.has_true_places = !self.places.is_empty();
    }

    /// Removes and returns the true places of a robot; `None` if none were added.
    pub(crate) fn take(&mut self, robot: RobotId) -> Option<PlaceTrack> {
        self.places.remove(&robot)
    }
}

//! What only a simulator knows of a rehearsal.

use std::collections::BTreeMap;

use lightbots_base::{Instant, RobotId, Vec2};

use crate::model::ShowReport;
use crate::track::PlaceTrack;

/// The truth of a rehearsal, beside what its robots reported.
#[derive(Clone, Debug, Default)]
pub struct Truth {
    /// Contacts of rims.
    pub contacts: u64,
    /// Number of times that the safety layer began to slow a robot.
    pub brakes: u64,
    /// Number of these times with no faulty and no off-route robot ahead.
    pub false_brakes: u64,
    /// Messages that were lost on the way.
    pub messages_lost: u64,
    /// Least gap between two rims, metres; `None`: no two robots came near each other.
    pub closest_m: Option<f64>,
    places: BTreeMap<RobotId, PlaceTrack>,
}

impl Truth {
    /// Adds the place of a robot. Samples of one robot must come in order of time.
    pub fn add(&mut self, at: Instant, robot: RobotId, place: Vec2) {
        self.places.entry(robot).or_default().add(at.as_secs(), place);
    }

    /// Fills in the figures of a report that the recorded inputs do not contain.
    pub(crate) fn tell(&self, report: &mut ShowReport) {
        report.contacts = Some(self.contacts);
        report.brakes.all = self.brakes;
        report.brakes.unfounded = Some(self.false_brakes);
        report.messages.lost = Some(self.messages_lost);
        report.closest_m = self.closest_m;
        report.has_true_places = !self.places.is_empty();
    }

    /// Removes and returns the places of a robot.
    pub(crate) fn take(&mut self, robot: RobotId) -> Option<PlaceTrack> {
        self.places.remove(&robot)
    }
}

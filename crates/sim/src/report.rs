//! The result of a rehearsal.

use lightbots_show::Issues;
use serde::Serialize;

use crate::brakes::BrakeCounts;
use crate::light_watch::LightCounts;
use crate::network::MessageCounts;
use crate::statistics::Spread;

/// The report of a rehearsal. The names of its fields are the keys of its JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RehearsalReport {
    /// Whether the show finished, reached as many frames as it has, had no contact, and lost no more robots to dropouts
    /// than had a breakdown.
    pub ok: bool,
    /// Number of robots.
    pub robots: usize,
    /// Number of frames that robots reached. A frame that was reached several times, as in a loop, counts each time.
    pub frames_played: usize,
    /// Number of frames of the show.
    pub frames: usize,
    /// Time from the first departure to the end of the run, or until the rehearsal was given up, seconds.
    pub duration_s: f64,
    /// Planned duration of the show, seconds.
    pub planned_s: f64,
    /// No plan for this show can be shorter than this, seconds.
    pub lower_bound_s: f64,
    /// Number of contacts of two robots, or of a robot with a no-go area. A robot that is pressed over the floor's edge
    /// by more than [`EDGE_SLACK_M`](crate::EDGE_SLACK_M) also counts as a contact.
    pub contacts: u64,
    /// Number of contacts of two robots after the first replan began. They are attributed to recovery rather than to
    /// the first plan.
    pub contacts_after_replan: u64,
    /// Number of replans since the first departure.
    pub replans: usize,
    /// Number of touches of the floor's edge, however light.
    pub wall_contacts: u64,
    /// Largest distance by which the floor's edge has pushed a robot back during one contact, metres. It is a sum over
    /// the steps of the contact.
    pub wall_pressed_m: f64,
    /// Number of braking episodes of the safety layers, and of those without a faulty or off-route robot ahead.
    pub brakes: BrakeCounts,
    /// The least distance of two centres, metres; `None` if no two robots came near each other.
    pub closest_m: Option<f64>,
    /// Time between the first and the last robot's arrival at a frame, one value a frame, seconds.
    pub arrival_spread_s: Spread,
    /// True distance of robots from their pixels when a frame was reached, one value a robot and frame, metres.
    pub position_error_m: Spread,
    /// Distance between the estimated and the true place of robots on a route, metres.
    pub estimate_error_m: Spread,
    /// Distance between the true place of robots on a route and the place where the route wants them at that moment,
    /// metres.
    pub tracking_error_m: Spread,
    /// Largest difference between the show clocks of two robots, one value a second, seconds. Departures and lights
    /// meant for one moment differ by as much between robots.
    pub clock_spread_s: Spread,
    /// Comparisons of lights with the layers of the show; 0 without layers.
    pub lights: LightCounts,
    /// Longest time from a crash of the controller, or from a restart less than 2.2 s later, until all robots stood
    /// still, seconds. `None` if nothing was measured, for example because the controller was not killed.
    pub stop_after_crash_s: Option<f64>,
    /// Numbers of messages sent and lost. A broadcast counts once for each receiver.
    pub messages: MessageCounts,
    /// Number of robots that dropped out.
    pub dropouts: usize,
    /// The seed: the same show, conditions and seed give the same run.
    pub seed: u64,
    /// Hash of the messages that reached the controller and, once a second, of the world's state: 16 hexadecimal
    /// digits. Equal runs have equal hashes.
    pub state_hash: String,
    /// Speed of the rehearsal as a multiple of real time. The caller fills it in, because this crate reads no clock.
    pub real_time_factor: Option<f64>,
    /// Faults and remarks.
    pub issues: Issues,
    /// The frames that robots reached, in the order played.
    pub per_frame: Vec<FrameRecord>,
}

impl RehearsalReport {
    /// Touches of the floor's edge, as text.
    pub fn edge_touches(&self) -> String {
        match self.wall_contacts {
            0 => "0".into(),
            count => format!("{count}, at most {:.1} mm over it", self.wall_pressed_m * 1e3),
        }
    }
}

/// A pixel is shown if a robot is at most this far from it, metres: a third of a robot's diameter of 57 mm.
pub const SHOWN_M: f64 = 0.019;

/// One frame that robots reached.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameRecord {
    /// Its index in the show, counted from 0.
    pub frame: usize,
    /// Its name.
    pub name: String,
    /// Time at which robots had reached the frame, seconds after the first departure.
    pub at_s: f64,
    /// Time since the drive to the frame began, or since the first drive after the last new plan, seconds.
    pub drive_s: f64,
    /// Time between the first and the last robot's arrival at the frame, seconds.
    pub arrival_spread_s: f64,
    /// Distance of robots from their pixels when the frame was reached, metres. If no robot takes part any more:
    /// distance of each pixel from the nearest robot.
    pub position_error_m: Spread,
    /// Number of the distances in [`Self::position_error_m`] that are at most [`SHOWN_M`].
    pub pixels_shown: usize,
}

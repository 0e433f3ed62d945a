//! What a rehearsal found out.

use lightbots_show::Issues;
use serde::Serialize;

use crate::brakes::BrakeCounts;
use crate::network::MessageCounts;
use crate::statistics::Spread;

/// The report of a rehearsal. Its JSON has these keys.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RehearsalReport {
    /// Every frame was played, nobody touched anybody, and nobody dropped out but those who were made to.
    pub ok: bool,
    /// How many robots took part.
    pub robots: usize,
    /// How many frames stood.
    pub frames_played: usize,
    /// How many frames the show has.
    pub frames: usize,
    /// From the first departure to the end of the last air time, seconds.
    pub duration_s: f64,
    /// How long the show is planned to take, seconds.
    pub planned_s: f64,
    /// What no plan can be shorter than, seconds; see the plan.
    pub lower_bound_s: f64,
    /// How often two robots came to touch, or one an obstacle, or one went over the floor's edge by more than robots may
    /// be off their routes, [`EDGE_SLACK_M`](crate::EDGE_SLACK_M).
    pub contacts: u64,
    /// Contacts of two robots after the first replan began: recovery caused them.
    pub contacts_after_replan: u64,
    /// How often the run was planned anew from where robots stood.
    pub replans: usize,
    /// How often a robot touched the edge of the floor, however lightly.
    pub wall_contacts: u64,
    /// How far a robot would have come over the edge of the floor at most, metres.
    pub wall_pressed_m: f64,
    /// How often safety layers slowed robots, and how often nothing faulty or off its route was ahead of them.
    pub brakes: BrakeCounts,
    /// The least distance of two centres, metres; `None` where nobody came near anybody.
    pub closest_m: Option<f64>,
    /// Between the first and the last robot that comes to stay at its place in a frame, one value a frame, seconds.
    pub arrival_spread_s: Spread,
    /// How far robots really were from their pixels when their frame stood, one value a robot and frame, metres.
    pub position_error_m: Spread,
    /// How far robots on their way were from where they believed to be, metres.
    pub estimate_error_m: Spread,
    /// How far robots on their way were from where their routes were, metres.
    pub tracking_error_m: Spread,
    /// Between the robots' clocks that are furthest apart, one value a second, seconds: so much apart are departures
    /// and changes of light that are meant for one moment.
    pub clock_spread_s: Spread,
    /// What was said, each receiver counted, and what was lost on the way.
    pub messages: MessageCounts,
    /// Robots that were lost.
    pub dropouts: usize,
    /// The seed: the same show, conditions and seed give the same run.
    pub seed: u64,
    /// Fingerprint of the whole run, 16 hexadecimal digits.
    pub state_hash: String,
    /// How many times faster than real time it went. Filled in by the caller, as there is no clock in here.
    pub real_time_factor: Option<f64>,
    /// What is wrong or worth knowing.
    pub issues: Issues,
    /// The frames that stood, in the order played.
    pub per_frame: Vec<FrameRecord>,
}

impl RehearsalReport {
    /// How often the floor's edge was touched, in words.
    pub fn edge_touches(&self) -> String {
        match self.wall_contacts {
            0 => "0".into(),
            count => format!("{count}, at most {:.1} mm over it", self.wall_pressed_m * 1e3),
        }
    }
}

/// One frame that stood.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrameRecord {
    /// Which, counted from 0.
    pub frame: usize,
    /// Its name.
    pub name: String,
    /// When it stood, seconds after the first departure.
    pub at_s: f64,
    /// How long the drive to it took, seconds.
    pub drive_s: f64,
    /// Between the first and the last arrival, seconds.
    pub arrival_spread_s: f64,
    /// How far robots were from their pixels, metres.
    pub position_error_m: Spread,
}

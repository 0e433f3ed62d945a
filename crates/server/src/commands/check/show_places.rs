//! Finds frame names, pixels and times in a plan, for the texts of `check`.

use lightbots_plan::ShowPlan;
use lightbots_show::{Show, frame_label};

/// Returns the id of the pixel to which a robot drives in a transition; `None` if the robot has no pixel.
pub fn pixel(made: &ShowPlan, transition: usize, robot: usize) -> Option<u32> {
    made.mapping.get(transition)?.get(robot).copied().flatten()
}

/// Number and name of a frame.
pub fn frame_name(show: &Show, frame: usize) -> String {
    frame_label(frame, show.frames.get(frame).map_or("", |frame| &frame.name))
}

/// Start of a transition, seconds after the start of the show.
pub fn began_s(show: &Show, made: &ShowPlan, transition: usize) -> f64 {
    let before = made.transitions.iter().zip(&show.frames).take(transition);
    before.map(|(way, frame)| way.duration.as_secs() + frame.air_time_s).sum()
}

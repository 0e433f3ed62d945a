//! Validation of a show before planning.

mod findings;
mod fleet;
mod frame;
mod limits;
mod motion;
mod parts;
mod stage;
mod words;

use crate::{Issues, Show};
use findings::Findings;

pub use limits::{
    MAX_ASSETS, MAX_BEATS, MAX_FRAMES, MAX_LABEL_CHARS, MAX_LAYERS, MAX_MARKS, MAX_MOTION_PLACES,
    MAX_OBSTACLES, MAX_PICTURES_BETWEEN, MAX_PIXELS, MAX_SETTING_DEPTH, MAX_SETTING_VALUES,
    MAX_SETTINGS_OF_SHOW, MAX_SOURCES, MAX_SOURCES_OF_SHOW, MAX_TRAJECTORIES, MAX_TRAJECTORY_PIECES,
    PROVABLE_GAP_M,
};

/// Returns the issues of a show; any show is accepted. Issues of the stage and of all frames together come first, then
/// those of each frame, then those of other parts. A show with an error must not be planned. At most a thousand issues
/// are listed, and one more then says that there are others.
pub fn validate(show: &Show) -> Issues {
    let mut findings = Findings::default();
    let is_sound = stage::check(&show.stage, &mut findings);
    fleet::check(show, is_sound, &mut findings);
    for index in 0..show.frames.len().min(MAX_FRAMES) {
        frame::check(show, index, is_sound, &mut findings);
        motion::check(show, index, &mut findings);
    }
    parts::check(show, &mut findings);
    findings.issues
}

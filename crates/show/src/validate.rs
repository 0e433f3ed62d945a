//! Validation of a show before planning.

mod findings;
mod fleet;
mod frame;
mod limits;
mod stage;
mod words;

use crate::{Issues, Show};
use findings::Findings;

pub use limits::{MAX_FRAMES, MAX_OBSTACLES, MAX_PIXELS, PROVABLE_GAP_M};

/// The issues of a show in the order of its frames. Empty if the show can be planned. Accepts any show and always finds
/// the same issues in the same show.
pub fn validate(show: &Show) -> Issues {
    let mut findings = Findings::default();
    let is_sound = stage::check(&show.stage, &mut findings);
    fleet::check(show, is_sound, &mut findings);
    for index in 0..show.frames.len().min(MAX_FRAMES) {
        frame::check(show, index, is_sound, &mut findings);
    }
    findings.issues
}

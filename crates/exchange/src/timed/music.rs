//! The music of a file -> the music of a show.

use std::sync::Arc;

use lightbots_show::{Issue, MAX_LABEL_CHARS, Show};

use crate::archive::asset_of;

/// Largest time between the start of the music and that of the first frame's air time that counts as none, seconds. A
/// time this short is not noticed (docs/exchange.md).
const TOLERANCE_S: f64 = 0.05;

/// Music in a file.
#[derive(Clone, Debug)]
pub(crate) struct TimedMusic {
    /// Name of the music's file, for people.
    pub name: String,
    /// Media type, such as `audio/mpeg`.
    pub media_type: String,
    /// When the music begins, seconds from the start of the timed show in the file; may be negative.
    pub start_s: f64,
    /// The sound.
    pub content: Arc<[u8]>,
}

impl TimedMusic {
    /// How much later than `first_s` the music begins, seconds; negative: earlier. 0 if the difference is at most
    /// [`TOLERANCE_S`]. `first_s` counts from the start of the timed show in the file.
    pub fn late_s(&self, first_s: f64) -> f64 {
        let late_s = self.start_s - first_s;
        if late_s.abs() > TOLERANCE_S { late_s } else { 0.0 }
    }
}

/// Adds the music of a file to `show`. `first_s` is the moment of the file, in seconds, that became the start of the
/// first frame's air time. Music of a show always begins there: returns a warning if it began elsewhere in the file.
pub(super) fn add(show: &mut Show, music: &TimedMusic, first_s: f64) -> Option<Issue> {
    let name: String = music.name.chars().take(MAX_LABEL_CHARS).collect();
    show.assets.extend([asset_of(&name, &music.media_type, music.content.clone())]);
    show.music = Some(name);
    let late_s = music.late_s(first_s);
    let what = if late_s > 0.0 {
        format!("{late_s:.2} s after the first frame, and is now early: put silence before it")
    } else if late_s < 0.0 {
        format!("{:.2} s before the first frame, and is now late: cut its begin off", -late_s)
    } else {
        return None;
    };
    Some(Issue::warning("music-moved", format!("the music of the file began {what}")))
}

//! The music of a file -> the music of a show.

use std::sync::Arc;

use lightbots_show::{Issue, MAX_LABEL_CHARS, Show};

use crate::archive::asset_of;

/// Largest time between the begins of music and first frame at which no difference is heard, seconds
/// (docs/exchange.md).
const TOLERANCE_S: f64 = 0.05;

/// Music in a file.
#[derive(Clone, Debug)]
pub(crate) struct TimedMusic {
    /// Name of its file, for people.
    pub name: String,
    /// Media type, such as `audio/mpeg`.
    pub media_type: String,
    /// When it begins, seconds since the begin of the file.
    pub start_s: f64,
    /// The sound.
    pub content: Arc<[u8]>,
}

impl TimedMusic {
    /// How much later than `first_s` of the file it begins, seconds; negative: earlier. 0 if no difference is heard.
    pub fn late_s(&self, first_s: f64) -> f64 {
        let late_s = self.start_s - first_s;
        if late_s.abs() > TOLERANCE_S { late_s } else { 0.0 }
    }
}

/// Adds the music to a show. The air time of its first frame begins at `first_s` of the file. Music of a show begins
/// there too: returns an issue if it began at another moment.
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

//! Where the music of a show is on the timeline.

use lightbots_base::Instant;

/// Where the music of a show is on the timeline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MusicTime {
    /// When the position of the music was last noted, and that position in show time, seconds. `None`: the music is
    /// where the show is.
    pub seen: Option<(Instant, f64)>,
    /// Number of the routes that robots drove at that time, or had driven last.
    pub leg: u32,
    /// Whether the music moves on.
    pub runs: bool,
    /// Whether the operator moves the show to another place, to which the music jumps.
    pub is_led: bool,
    /// Number of frames reached when a frame was last made to catch up with the music.
    pub stood: usize,
}

impl MusicTime {
    /// Notes that the operator moves the show to another place, to which the music jumps.
    pub fn lead(&mut self) {
        self.is_led = true;
    }
}

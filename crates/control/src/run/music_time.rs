//! Where the music of a show is on the timeline.

use lightbots_base::Instant;

/// Where the music of a show is on the timeline.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MusicTime {
    /// When the position of the music was last noted, and that position, as show time in seconds. `None`: the music is
    /// where the show is.
    pub seen: Option<(Instant, f64)>,
    /// Number of the routes that robots drove when the position was noted, or had driven last.
    pub leg: u32,
    /// Whether the music goes on from the noted position. `false`: it stands.
    pub runs: bool,
    /// Whether the operator has moved the show to another frame, to which the music has yet to jump.
    pub is_led: bool,
    /// Number of frames that robots had reached when the show was last compared with the music. By this number the air
    /// time of each frame is adapted to the music only once.
    pub stood: usize,
}

impl MusicTime {
    /// Notes that the operator moves the show to another frame, to which the music is to jump.
    pub fn lead(&mut self) {
        self.is_led = true;
    }
}

//! Where the music of a show is.

use lightbots_base::Instant;

/// Where the music of a show is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct MusicTime {
    /// The moment at which that was known last, and where it was then, seconds of the show. `None`: music is where the
    /// robots are.
    pub seen: Option<(Instant, f64)>,
    /// Number of the routes that robots drove then, or had driven last.
    pub leg: u32,
    /// Whether it moves on.
    pub runs: bool,
    /// The operator moves the show: the music goes with it.
    pub is_led: bool,
    /// Number of frames that stood when the last of them was made to catch up.
    pub stood: usize,
}

impl MusicTime {
    /// The operator moves the show to another place, and the music goes there too.
    pub fn lead(&mut self) {
        self.is_led = true;
    }
}

//! What happens to a robot, or what the operator does, at a moment of a rehearsal, beside breakdowns.

use lightbots_base::Vec2;

/// Something that happens at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mishap {
    /// The operator stops all robots.
    Stop,
    /// The operator pauses the show.
    Pause,
    /// The operator ends the pause.
    Resume,
    /// A robot's power fails.
    Off(usize),
    /// A robot's power is back: it begins as if it were new.
    On(usize),
    /// A robot is lifted, and put down about this place, stage metres.
    Moved(usize, Vec2),
}

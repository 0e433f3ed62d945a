//! Mishaps: what happens at one moment of a rehearsal, apart from breakdowns. A mishap happens to a robot or a
//! computer, or the operator or another person causes it.

use lightbots_base::{Span, Vec2};

/// Something that happens at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mishap {
    /// The operator stops all robots.
    Stop,
    /// The operator pauses the show.
    Pause,
    /// The operator ends the pause.
    Resume,
    /// The operator sends robots to a frame, counted from 0.
    GoTo(usize),
    /// The operator skips the next frame.
    Skip,
    /// The operator lays rainbow colours over the show (`true`) or takes them off.
    Rainbow(bool),
    /// A robot's power fails.
    Off(usize),
    /// A robot's power is back: its firmware starts without any memory.
    On(usize),
    /// A robot is lifted, and put down at the free place nearest to this place, stage metres.
    Moved(usize, Vec2),
    /// From now on a robot reports its place with this error, metres along the stage axes; zero: it reports true places
    /// again.
    Lies(usize, Vec2),
    /// A robot begins (`true`) or ceases to flood the network with its last report.
    Floods(usize, bool),
    /// The first robot is switched off and on, and then has the name of the second robot.
    Named(usize, usize),
    /// A person puts a foot on the floor at the free place nearest to this place, stage metres; `None`: the person
    /// leaves.
    Person(Option<Vec2>),
    /// The disk of the journal is full for this long.
    DiskFull(Span),
    /// The time of day of the controller's computer is set forwards by this span; negative: back.
    ClockSet(Span),
    /// The controller's computer, on which the broker runs as well, sleeps for this long.
    Sleeps(Span),
    /// During the first span, each piece of the journal takes the second span until it is on the disk.
    DiskSlow(Span, Span),
}

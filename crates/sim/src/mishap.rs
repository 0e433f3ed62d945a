//! Mishaps: what happens to a robot or what the operator does at a moment of a rehearsal, apart from breakdowns.

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
    /// The operator puts a rainbow over the show, or takes it off.
    Rainbow(bool),
    /// A robot's power fails.
    Off(usize),
    /// A robot's power is back: it starts as if it were new.
    On(usize),
    /// A robot is lifted, and put down near this place, stage metres.
    Moved(usize, Vec2),
    /// A robot reports places that are off by this, metres; zero: it reports true places again.
    Lies(usize, Vec2),
    /// A robot begins (`true`) or ceases to flood the network with its last report.
    Floods(usize, bool),
    /// A robot is switched off and on, and then has the name of another one.
    Named(usize, usize),
    /// A person stands on the floor near this place, stage metres; `None`: the person leaves.
    Person(Option<Vec2>),
    /// The disk of the journal is full for this long.
    DiskFull(Span),
    /// The time of day of the controller's computer is set forwards by this span.
    ClockSet(Span),
    /// The controller's computer sleeps for this long, with the broker on it.
    Sleeps(Span),
    /// During the first span, each piece of the journal takes the second span until it is on the disk.
    DiskSlow(Span, Span),
}

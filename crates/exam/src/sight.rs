//! What only eyes can tell.

use lightbots_base::{Instant, Rgb};

/// A question about the light, for whoever sees the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// What to ask people, to be answered with yes or no.
    pub text: String,
    /// The same for a program that has watched the light.
    pub sights: Vec<Sight>,
}

/// What the light shows if the rule is kept. Moments are those of the exam's own clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// This colour at that moment.
    Colour {
        /// When.
        at: Instant,
        /// What.
        colour: Rgb,
    },
    /// White and black in turn, 125 ms each.
    Flashing {
        /// From when.
        from: Instant,
        /// Until when.
        to: Instant,
    },
}

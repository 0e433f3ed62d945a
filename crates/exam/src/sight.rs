//! Questions that only a person or a camera can answer.

use lightbots_base::{Instant, Rgb};

/// A question about the light, for the observer of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// Question with the answers yes and no.
    pub text: String,
    /// The question for a program that has recorded the light: the answer is yes if the light showed all of these.
    pub sights: Vec<Sight>,
}

/// What the light shows if the rule is kept. Moments are on the exam's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// The light has a colour at a moment.
    Colour {
        /// Moment.
        at: Instant,
        /// Colour.
        colour: Rgb,
    },
    /// White and black in turn, 125 ms each.
    Flashing {
        /// Beginning.
        from: Instant,
        /// End.
        to: Instant,
    },
}

//! Questions about the light, which a person or a camera must answer.

use lightbots_base::{Instant, Rgb};

/// A question about the light, for the observer of the robot.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// A question that can be answered with yes or no.
    pub text: String,
    /// The same question for a program that has recorded the light. The answer is yes if the light showed all of these.
    pub sights: Vec<Sight>,
}

/// What the light shows if the robot keeps the rule. Times are on the exam's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// The light has a colour at a moment.
    Colour {
        /// Moment.
        at: Instant,
        /// Colour.
        colour: Rgb,
    },
    /// The light is white and black in turn, 125 ms each.
    Flashing {
        /// Beginning.
        from: Instant,
        /// End.
        to: Instant,
    },
}

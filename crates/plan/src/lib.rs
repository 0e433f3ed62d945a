//! Who goes where, and how: a show becomes an assignment and timed paths, with a proof that nobody touches.
//!
//! Pure: same input, same bits out. It knows nothing of messages, clocks or files.

mod problem;

pub use problem::{Closest, Path, Stuck, Transition, TransitionProblem};

//! Right and wrong robots under examination, in virtual time: our own core on simulated wheels behind a network that is
//! 5 to 20 ms late, with something in between that makes it wrong.

// What was found is shown when a test fails.
#![allow(clippy::print_stderr)]

mod bench;
mod flaws;
mod right;
mod wrong;

//! Exams of correct and faulty robots in virtual time. Each robot is our own core on simulated wheels, behind a network
//! with delays of 5 to 20 ms. A flaw between core and network makes it faulty.

// A failing test prints the findings.
#![allow(clippy::print_stderr)]

mod bench;
mod flaws;
mod right;
mod wrong;

//! The messages between controller and robot: bytes ↔ values, as `docs/protocol.md` specifies them.
//!
//! Decoding never panics, never allocates, and takes time linear in the bytes. It knows nothing of brokers, shows or
//! wheels. The original protocol is kept byte for byte; what is ours is added beside it, so that an original robot and
//! an original controller still work.
#![no_std]

mod command;
mod report;
mod topic;

pub use command::{Blink, Command, Fade, MAX_PIECES, Pieces, Route, TimeAnswer};
pub use report::{Abilities, Details, Firmware, Report, RobotState, TimeQuestion};
pub use topic::Topic;

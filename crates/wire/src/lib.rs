//! The messages between controller and robot: bytes ↔ values, as `docs/protocol.md` specifies them.
//!
//! Decoding never panics, never allocates, and takes time linear in the bytes. The crate knows nothing of brokers,
//! shows or wheels. The original protocol is kept byte for byte. Our additions leave it unchanged, so that an original
//! robot and an original controller still work.
//!
//! ```
//! use lightbots_base::Vec2;
//! use lightbots_wire::{Command, commands, encode};
//! let mut payload = String::new();
//! encode(&Command::Target(Vec2::new(0.5, -1.25)), &mut payload).unwrap();
//! assert_eq!(payload, "|TARGET 0.500000 -1.250000|");
//! let german = commands(b"|TARGET 0,500000 -1,250000|").next();
//! assert_eq!(german, Some(Ok(Command::Target(Vec2::new(0.5, -1.25)))));
//! ```
#![no_std]

mod base64_text;
mod command;
mod decode;
mod encode;
mod fields;
mod light;
mod live;
mod neighbours;
mod number;
mod path;
mod report;
mod report_text;
mod text_buffer;
mod topic;

pub use command::{Blink, Command, Fade, MAX_PIECES, Pieces, Route, TimeAnswer};
pub use decode::{Commands, MAX_PAYLOAD, Unknown, commands};
pub use encode::encode;
pub use light::{LightAnchor, LightRecords, LightStretch, MAX_LIGHT_RECORDS};
pub use live::{LiveColours, LiveRelease, MAX_LIVE_COLOURS};
pub use neighbours::{Knot, MAX_KNOTS, MAX_NEIGHBOURS, Neighbour, NeighbourMotion, Neighbours};
pub use number::number;
pub use report::{Abilities, Blocked, Details, Firmware, Report, RobotState, TimeQuestion};
pub use topic::{Topic, TopicText};

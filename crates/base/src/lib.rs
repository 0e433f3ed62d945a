//! Types and functions that other crates share: vectors, poses, angles, instants, ids, colours, limits, braking, timed
//! paths, light tracks, random numbers, percentiles and hashes.
//!
//! The crate depends on no other of our crates, allocates nothing and reads no clock. Lengths are metres and angles are
//! radians counter-clockwise. [`Instant`] and [`Span`] count microseconds.
//!
//! ```
//! use lightbots_base::{PathRef, Piece, Span, Vec2};
//! let metre = [Piece::straight(Vec2::ZERO, Vec2::new(1.0, 0.0), Span::from_secs(4.0))];
//! let path = PathRef::new(Vec2::ZERO, &metre);
//! assert_eq!(path.at(Span::from_secs(2.0)).position, Vec2::new(0.5, 0.0));
//! ```
#![no_std]

mod angle;
pub mod braking;
mod colour;
mod hash;
mod id;
mod light_cursor;
mod light_track;
mod limits;
mod path;
pub mod random;
pub mod shape;
pub mod statistics;
mod time;
mod vec2;

pub use angle::{difference, wrap};
pub use colour::{Rgb, srgb_decoded};
pub use hash::StateHash;
pub use id::RobotId;
pub use light_cursor::LightCursor;
pub use light_track::{
    LightRecord, LightTrack, LightTrackError, TICK, TICKS_MAX, decode_light_track, varint,
};
pub use limits::Limits;
pub use path::{Motion, PathRef, Piece};
pub use time::{Instant, Span};
pub use vec2::{Pose, Vec2};

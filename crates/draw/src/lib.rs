//! Words, drawings and pictures become places and colours for any number of robots.
//!
//! The crate does no IO: bytes and numbers in, places and colours out, with the same bits for the same input and seed. In
//! reading order: a [`Drawing`] is lines and areas with colours.

mod drawing;
mod error;

pub use drawing::{Area, Drawing, Group, Raster, Rule, Stroke};
pub use error::{DrawError, Made, Note};

//! The show document: what people draw. Parse, migrate, validate, import and export.
//!
//! It knows nothing of robots' wheels, messages or plans, and does no IO: bytes in, values and issues out.

mod issue;
mod model;

pub use issue::{Issue, Issues, Severity};
pub use model::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage};

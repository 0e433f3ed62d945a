//! The show document that people draw: the model in memory and its validation.
//!
//! The crate knows nothing of wheels, messages, plans and files, and does no IO. In reading order: [`Show`] is the
//! document, [`validate`] gives [`Issues`] of a document, [`front_rows`] gives places where robots wait before the first
//! frame. `lightbots-exchange` reads and writes files.
//!
//! ```
//! use lightbots_show::{Frame, Show, validate};
//! let empty = Show { frames: vec![Frame::default()], ..Show::default() };
//! assert_eq!(validate(&empty)[0].message, "frame 1: it has no pixels; add some or delete the frame");
//! ```

mod front;
mod issue;
mod label;
mod model;
mod need;
mod spacing;
mod validate;

pub use front::front_rows;
pub use issue::{Issue, Issues, Severity};
pub use label::{excerpt, frame_label};
pub use model::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage, with_floor};
pub use need::{most_pixels, robots_asked_for, robots_needed};
pub use spacing::{CloseApproach, close_pairs};
pub use validate::{MAX_FRAMES, MAX_OBSTACLES, MAX_PIXELS, PROVABLE_GAP_M, validate};

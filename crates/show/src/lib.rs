//! The show document: what people draw. Read, validate and write.
//!
//! It knows nothing of robots' wheels, messages or plans, and does no IO: bytes in, values and issues out. In reading
//! order: [`Show`] is the document in memory, [`read`] makes it from a file of either [`Format`], [`validate`] says
//! what is wrong with it, [`write()`] makes a file again, [`front_rows`] says where robots wait before it.
//!
//! ```
//! let file = br##"{"lightbots": 1, "frames": [
//!     {"name": "Dot", "air_time_s": 2, "pixels": [{"id": 0, "place": [0.5, 0], "color": "#ffa500"}]}
//! ]}"##;
//! let loaded = lightbots_show::read(file, Some("json")).unwrap();
//! assert!(lightbots_show::validate(&loaded.show).is_empty());
//! assert_eq!(loaded.show.frames[0].pixels[0].color.r, 255);
//! ```

mod error;
mod front;
mod issue;
mod json;
mod model;
mod need;
mod read;
mod spacing;
mod validate;
mod write;

pub use error::{PixelName, ReadError, frame_label};
pub use front::front_rows;
pub use issue::{Issue, Issues, Severity};
pub use model::{Easing, Frame, Identity, Obstacle, Pixel, Show, Stage, with_floor};
pub use need::{most_pixels, robots_asked_for, robots_needed};
pub use read::{Format, Loaded, MAX_BYTES, read};
pub use spacing::{CloseApproach, close_pairs};
pub use validate::{MAX_FRAMES, MAX_OBSTACLES, MAX_PIXELS, PROVABLE_GAP_M, validate};
pub use write::{losses, write};

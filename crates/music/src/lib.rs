//! Finds beats of music: samples in, times of beats out.
//!
//! The crate decodes nothing and reads no file, so that the program and the browser find the same beats. docs/music.md
//! describes the method. Reading order: [`Sound`], [`find_beats`], [`steady`].
//!
//! ```
//! use lightbots_music::{NoBeats, Sound, find_beats};
//! let silence = vec![0.0; 8_000 * 60];
//! let sound = Sound::new(&silence, 8_000.0).expect("a minute is long enough");
//! assert_eq!(find_beats(&sound), Err(NoBeats::Silent));
//! ```

mod follow;
mod onsets;
mod regular;
mod sound;
mod tempo;

pub use follow::{FoundBeats, find_beats};
pub use regular::{SteadyBeats, steady};
pub use sound::{NoBeats, Sound};

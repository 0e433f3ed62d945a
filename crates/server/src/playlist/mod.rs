//! A day by playlist: shows at set times, pauses between them, and what became of each.
//!
//! `list` has the entries, `day` what happened and, as a pure function of both and of the time, what to do next;
//! `view` is the same for screens, `store` keeps both in files. The task that acts on it is `playlist_player`.

mod day;
mod list;
mod store;
mod times;
mod view;

pub use day::{PlaylistAct, TurnEnd, TurnKey};
pub use list::PlaylistTurn;
pub use store::{ChangeRefused, PlaylistStore, now_s};
pub use times::clock_text;

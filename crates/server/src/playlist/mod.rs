//! Plays shows by a playlist, at set times with pauses between them, and records what became of each.
//!
//! `list` has the entries. `day` has what happened, and decides what to do next, as a pure function of both and of the
//! time. `view` presents that to screens, and `store` keeps it in files. The task `playlist_player` carries it out.

mod day;
mod list;
mod store;
mod times;
mod view;

pub use day::{PlaylistAct, TurnEnd, TurnKey};
pub use list::PlaylistTurn;
pub use store::{ChangeRefused, PlaylistStore, now_s};
pub use times::clock_text;

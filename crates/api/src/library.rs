//! The library of shows over HTTP.
//!
//! | request | answer |
//! |---|---|
//! | `GET /api/shows` | `ShowEntry[]`, by name |
//! | `GET /api/shows/{name}` | the document (our format) with its `ETag` |
//! | `PUT /api/shows/{name}` | body: a document in either format. `If-Match: <etag>` to replace, `If-None-Match: *`
//! to create only; 412 and a `Problem` where another client saved first. Answers the `ShowEntry`: for a read-only
//! show that of a copy, with a name of its own and `copy_of` |
//! | `DELETE /api/shows/{name}` | 204; honours `If-Match`; 403 and a `Problem` for a read-only show |
//! | `POST /api/check` | body: a document; answers a `Plan` with paths |
//! | `POST /api/convert?to=lightbots\|original` | body: a document; answers it in that format |
//! | `GET /api/plan` | the `Plan` with paths of the show that is open |

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A show in the library.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct ShowEntry {
    /// Its name in the library: what `open` and `/api/shows/{name}` take.
    pub name: String,
    /// What its author called it; may be empty.
    pub title: String,
    /// How many frames it has.
    pub frames: usize,
    /// How many pixels its fullest frame has.
    pub pixels: usize,
    /// When it was last saved, milliseconds since 1970.
    pub modified_ms: u64,
    /// Its version, as `If-Match` takes it, with its quotes.
    pub etag: String,
    /// Where it comes from.
    pub origin: ShowOrigin,
    /// Only in the answer to a save of a read-only show: what this entry, which is new, is a copy of.
    pub copy_of: Option<ShowOrigin>,
}

/// Where a show of the library comes from. All but saved shows are read-only.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum ShowOrigin {
    /// It is a file of the library's folder.
    Saved,
    /// It comes with the program.
    Example,
    /// It is the file the program was started with.
    StartFile,
}

/// The body of every HTTP answer that is not a success.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Problem {
    /// One line for people: what is wrong, and what to do.
    pub error: String,
}

//! The library of shows over HTTP.
//!
//! | request | answer |
//! |---|---|
//! | `GET /api/shows` | `ShowEntry[]`, by name |
//! | `GET /api/shows/{name}` | the document (our format) with its `ETag` |
//! | `PUT /api/shows/{name}` | body: a document in either format. `If-Match: <etag>` to replace, `If-None-Match: *` to create only; 412 and a `Problem` where somebody else was faster. Answers the `ShowEntry` |
//! | `DELETE /api/shows/{name}` | 204; honours `If-Match` |
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
    /// Whether it came with the program: saving it makes a copy of the same name that can be deleted again.
    pub example: bool,
}

/// The body of every HTTP answer that is not a success.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Problem {
    /// One line for people: what is wrong, and what to do.
    pub error: String,
}

//! The library of shows over HTTP.
//!
//! | request | answer |
//! |---|---|
//! | `GET /api/shows` | `ShowEntry[]`, by name |
//! | `GET /api/shows/{name}` | the document (our format) with its `ETag` |
//! | `GET /api/shows/{name}/file` | the file as the library keeps it: the document, or all of a file that is only partly
//! understood |
//! | `PUT /api/shows/{name}` | body: a file of any format. `If-Match: <etag>` replaces that version, `If-None-Match: *`
//! creates only; 412 and a `Problem` if another client saved first. Answers the `ShowEntry`. A read-only show is
//! saved as a copy, whose entry has a new name and `copy_of`. A file with unknown fields is kept byte for byte; 403 and
//! a `Problem` for a show whose file has such fields |
//! | `DELETE /api/shows/{name}` | 204; honours `If-Match`; 403 and a `Problem` for a read-only show |
//! | `GET /api/assets/{hash}` | a file that shows name by its SHA-256 |
//! | `PUT /api/assets/{hash}` | body: the file; 204, or 422 and a `Problem` if it has another hash |
//! | `POST /api/check` | body: a file of any format; answers a `Plan` with paths |
//! | `POST /api/convert?to=FORMAT` | body: a file of any format; answers a file of that format of `FORMATS`, with the files
//! of the library that it names |
//! | `GET /api/plan` | the `Plan` of the open show, with paths |

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A show in the library.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct ShowEntry {
    /// Name in the library, for `open` and `/api/shows/{name}`.
    pub name: String,
    /// Name that the author gave the show; may be empty.
    pub title: String,
    /// Number of frames.
    pub frames: usize,
    /// Number of pixels of the largest frame.
    pub pixels: usize,
    /// Time of the last save, milliseconds since 1970; 0 for a read-only show.
    pub modified_ms: u64,
    /// Version of the document with its quotes, for `If-Match`.
    pub etag: String,
    /// Where the show comes from.
    pub origin: ShowOrigin,
    /// Why the show cannot be saved under its name, for people: its file holds more than this version knows. null: it
    /// can, or it is a read-only show by its origin.
    pub read_only: Option<String>,
    /// Origin of the read-only show that this new entry is a copy of. Only in the answer to a save of such a show.
    pub copy_of: Option<ShowOrigin>,
}

/// Where a show of the library comes from. Only saved shows can be changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum ShowOrigin {
    /// The show is a file in the library's folder.
    Saved,
    /// The show is part of the program.
    Example,
    /// The show is the file on the command line of the program.
    StartFile,
}

/// The body of an HTTP answer that refuses a request.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct Problem {
    /// One line for people: cause and remedy.
    pub error: String,
}

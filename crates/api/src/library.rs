//! Shows, their files and their plans over HTTP.
//!
//! | request | body | answer |
//! |---|---|---|
//! | `GET /api/shows` | | list of [`ShowEntry`], by name |
//! | `GET /api/shows/{name}` | | the document in our own format, with its `ETag` |
//! | `GET /api/shows/{name}/file` | | the file as the library keeps it: the document, or all of a file that is only
//! partly understood |
//! | `PUT /api/shows/{name}` | a file of any format | [`ShowEntry`]. `If-Match: ETAG` replaces that version,
//! `If-None-Match: *` only creates; 412 if another client saved first. Instead of replacing an example or the start
//! file, a copy is saved: its entry has a new name and `copy_of`. A file with unknown fields is kept byte for byte. 403
//! if the show to be replaced is a file with unknown fields; 422 for a file that is no show |
//! | `DELETE /api/shows/{name}?renamed_to=NAME` | | 204; honours `If-Match`; 403 for a read-only show. The query is
//! optional: NAME is the show under its new name, which gets the earlier states |
//! | `GET /api/shows/{name}/states` | | list of [`ShowState`], the newest first; the first is the current state |
//! | `GET /api/shows/{name}/states/{number}` | | the document of an earlier state; saving it with `PUT` restores it, and
//! makes what it replaces an earlier state |
//! | `GET /api/assets/{hash}` | | a file to which shows refer by its SHA-256 |
//! | `PUT /api/assets/{hash}` | the file | 204; 422 if it has another hash |
//! | `POST /api/check` | a file of any format | its [`Plan`](crate::Plan) with paths. A newer request from the same
//! address ends the older one with 409 |
//! | `POST /api/convert?to=FORMAT` | a file of any format | a file of that format, with the files of the library that it
//! names; 422 for a file that is no show, and for a show that cannot be planned where the format has timed paths |
//! | `GET /api/plan` | | the [`Plan`](crate::Plan) of the open show, with paths |

use serde::{Deserialize, Serialize};
use ts_rs::TS;

use crate::Issue;

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
    /// Time of the last save, milliseconds since 1970; 0 unless `origin` is `saved`.
    pub modified_ms: u64,
    /// Version of the document with its quotes, for `If-Match`.
    pub etag: String,
    /// Where the show comes from.
    pub origin: ShowOrigin,
    /// Why the show cannot be saved under its name, for people: its file holds fields that this version does not know.
    /// null: the show can be saved, or is read-only because of `origin`.
    pub read_only: Option<String>,
    /// Origin of the example or start file of which this new entry is a copy. Only in the answer to a save under the
    /// name of an example or the start file; otherwise null.
    pub copy_of: Option<ShowOrigin>,
    /// Issues found in the file, such as contents that a show cannot hold. Only in the answer to a save.
    pub issues: Vec<Issue>,
}

/// A saved state of a show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, TS)]
pub struct ShowState {
    /// Number for `/api/shows/{name}/states/{number}`; null: the current state.
    pub number: Option<u32>,
    /// Time of the save, milliseconds since 1970; 0 for an example or the start file.
    pub saved_ms: u64,
    /// Name that the author gave the show; may be empty.
    pub title: String,
    /// Number of frames.
    pub frames: usize,
    /// Number of pixels of the largest frame.
    pub pixels: usize,
    /// Version of the file, with its quotes. States with equal versions have equal content.
    pub etag: String,
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

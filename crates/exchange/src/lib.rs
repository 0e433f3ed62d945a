//! File formats for shows and plans: from bytes to values and back.
//!
//! [`FORMATS`] is the only list of formats. A further format is a module beside `lightbots`, `archive` and `original`,
//! and a row of the table. `skyc`, `csv`, `vviz` and `fseq` are formats of other programs, which have no frames.
//! `timed` converts between them and shows.
//!
//! The crate does no IO and does not check shows: [`lightbots_show::validate`] does. In reading order: [`Format`] is a
//! row of the table. [`read()`] reads a file of any format and returns [`Loaded`] or a [`ReadError`]. [`Format::write`]
//! returns [`Written`].
//!
//! ```
//! use lightbots_exchange::{ORIGINAL, read, sniff};
//! let file = br##"{"lightbots": 1, "frames": [
//!     {"name": "Dot", "air_time_s": 2, "pixels": [{"id": 0, "place": [0.5, 0], "color": "#ffa500"}]}
//! ]}"##;
//! let loaded = read(file, Some("dot.lightbots.json")).unwrap();
//! assert_eq!(loaded.show.frames[0].pixels[0].color.r, 255);
//! let written = ORIGINAL.write(&loaded.show, None);
//! assert_eq!(written.issues[0].code, "not-30-pixels");
//! assert_eq!(sniff(&written.bytes), Some(&ORIGINAL));
//! ```

mod archive;
mod csv;
mod error;
mod format;
mod fseq;
mod json;
mod lightbots;
mod limits;
mod original;
mod part;
mod read;
mod sequence_file;
mod skyc;
mod table;
mod timed;
mod vviz;
mod zip_files;

pub use archive::{asset_of, hash_of};
pub use error::{PixelName, ReadError};
pub use format::{Format, Loaded, Written};
pub use fseq::{put_onto, sniff as is_sequence};
pub use lightbots::read_layer;
pub use limits::MAX_BYTES;
pub use part::Part;
pub use read::read;
pub use sequence_file::sequence_picture;
pub use table::{
    ARCHIVE, CSV, FORMATS, FSEQ, LIGHTBOTS, ORIGINAL, SKYC, VVIZ, for_file, formats_in_words, named, sniff,
    stem,
};
pub use timed::import::replanned;

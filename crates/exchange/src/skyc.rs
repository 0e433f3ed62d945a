//! Skybrush's compiled shows, `.skyc`: a zip archive with `show.json`. Each drone has a path of lines and Bézier
//! curves whose parameter is proportional to time, as ours, and a light program of bytes. Colours are linear light.
//! The music may be in the archive.

mod encoded;
mod light_program;
mod media;
mod read;
mod reference;
mod write;

pub(crate) use read::read;
pub(crate) use write::encode;

use crate::archive;
use crate::zip_files::holds;

/// Name of the document in an archive.
pub(crate) const DOCUMENT: &str = "show.json";
/// Largest number of drones that Skybrush reads in a file.
const DRONES_MAX: usize = 5_000;
/// Number of ticks of a light program in a second.
const TICKS_PER_S: f64 = 50.0;

/// Whether the bytes are a zip archive with Skybrush's document `show.json` and without our document.
pub(crate) fn sniff(bytes: &[u8]) -> bool {
    holds(bytes, |name| name == DOCUMENT.as_bytes())
        && !holds(bytes, |name| name == archive::DOCUMENT.as_bytes())
}

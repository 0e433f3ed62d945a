//! The example shows that come with the program.

include!(concat!(env!("OUT_DIR"), "/examples.rs"));

/// Every example: its name in the library, and its file's bytes. Sorted by name.
pub fn all() -> &'static [(&'static str, &'static [u8])] {
    EXAMPLES
}

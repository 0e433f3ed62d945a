//! The example shows that come with the program.

include!(concat!(env!("OUT_DIR"), "/examples.rs"));

/// Returns every example, sorted by file name: its name (the file name without its ending), and the bytes of its file.
pub fn all() -> impl Iterator<Item = (&'static str, &'static [u8])> {
    EXAMPLES.iter().map(|(file, bytes)| (lightbots_exchange::stem(file), *bytes))
}

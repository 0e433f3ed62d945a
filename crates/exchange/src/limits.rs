//! Bounds on files.

/// Longest file that is read, bytes: room for 10,000 robots in 100 frames, since a pixel takes about 60 bytes in our
/// format. A longer file is refused before it is parsed, so that a wrong file does not fill the memory.
pub const MAX_BYTES: usize = 64 << 20;

/// Longest show in a file of another program, seconds: one day. Times in our own show files have the same bound.
pub(crate) const LONGEST_S: f64 = 86_400.0;

//! The partner of a row or column in a matching: an index, or [`NONE`].

/// Marks a row or column that has no partner yet.
pub(super) const NONE: u32 = u32::MAX;

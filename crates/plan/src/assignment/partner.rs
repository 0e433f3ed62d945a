//! The partner of a row or column in a matching: an index, or [`NONE`].

/// No partner yet.
pub(super) const NONE: u32 = u32::MAX;

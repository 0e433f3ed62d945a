//! Partners of rows and columns in a matching, as the matchings of this folder store them: an index, or [`NONE`].

/// No partner yet.
pub(super) const NONE: u32 = u32::MAX;

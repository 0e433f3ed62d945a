//! The limit on open files.

/// Raises it as far as the system lets us: every connection is one.
pub fn raise_limit() {
    const WANTED: u64 = 65_536;
    if let Err(error) = rlimit::increase_nofile_limit(WANTED) {
        tracing::warn!("the limit on open files stays as it is: {error}");
    }
}

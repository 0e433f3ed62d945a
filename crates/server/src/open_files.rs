//! What the system lets this process have: open files, memory.

/// Raises it as far as the system lets us: every connection is one.
pub fn raise_limit() {
    const WANTED: u64 = 65_536;
    if let Err(error) = rlimit::increase_nofile_limit(WANTED) {
        tracing::warn!("the limit on open files stays as it is: {error}");
    }
}

/// Bounds the memory of the broker's process, where the system can: one that runs away ends and is started again, instead
/// of taking the whole machine with it.
pub fn limit_memory() {
    #[cfg(target_os = "linux")]
    {
        let most = crate::live::broker::PROCESS_BYTES;
        if let Err(error) = rlimit::Resource::DATA.set(most, most) {
            tracing::warn!("the broker's memory has no bound: {error}");
        }
    }
}

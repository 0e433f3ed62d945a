//! What the system lets this process have: open files, memory.

/// Raises it as far as the system lets us: every connection is one.
pub fn raise_limit() {
    const WANTED: u64 = 65_536;
    if let Err(error) = rlimit::increase_nofile_limit(WANTED) {
        tracing::warn!("the limit on open files stays as it is: {error}");
    }
}

/// Open files that the system lets this process have.
pub fn limit() -> usize {
    // Where the limit is not known, the least that systems have.
    let known = rlimit::Resource::NOFILE.get_soft().unwrap_or(256);
    usize::try_from(known).unwrap_or(usize::MAX)
}

/// Whether an error says that this process, or the whole system, has as many open files as it may.
pub fn is_limit(error: &std::io::Error) -> bool {
    // EMFILE and ENFILE; on Windows WSAEMFILE.
    let codes = if cfg!(windows) { [10_024, 10_024] } else { [24, 23] };
    error.raw_os_error().is_some_and(|code| codes.contains(&code))
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

//! Limits of the system for this process: open files and memory.

/// Raises the limit on open files as far as the system allows, up to 65,536. Every connection is an open file.
pub fn raise_limit() {
    const WANTED: u64 = 65_536;
    if let Err(error) = rlimit::increase_nofile_limit(WANTED) {
        tracing::warn!("the limit on open files stays as it is: {error}");
    }
}

/// Returns how many files this process may have open at once; 256 if the limit is not known.
pub fn limit() -> usize {
    // 256 if the limit is not known: the least that systems have.
    let known = rlimit::Resource::NOFILE.get_soft().unwrap_or(256);
    usize::try_from(known).unwrap_or(usize::MAX)
}

/// Whether an error means that this process, or the whole system, has reached its limit on open files.
pub fn is_limit(error: &std::io::Error) -> bool {
    // EMFILE and ENFILE; on Windows WSAEMFILE.
    let codes = if cfg!(windows) { [10_024, 10_024] } else { [24, 23] };
    error.raw_os_error().is_some_and(|code| codes.contains(&code))
}

/// Limits the memory for data of this process, the broker's, on Linux only. A broker that needs more then ends, and the
/// rest of the machine keeps its memory.
pub fn limit_memory() {
    #[cfg(target_os = "linux")]
    {
        let most = crate::live::broker::PROCESS_BYTES;
        if let Err(error) = rlimit::Resource::DATA.set(most, most) {
            tracing::warn!("the broker's memory has no bound: {error}");
        }
    }
}

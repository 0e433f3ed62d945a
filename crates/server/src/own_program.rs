//! Path of this program's file, for child processes that run it.

use std::path::PathBuf;

/// Returns the path of this program's file. On Linux, the path works even after the file was replaced by a newer build.
/// If the path is not known, returns `lightbots`.
pub fn own_program() -> PathBuf {
    let running = PathBuf::from("/proc/self/exe");
    if cfg!(target_os = "linux") && running.exists() {
        return running;
    }
    std::env::current_exe().unwrap_or_else(|_| PathBuf::from("lightbots"))
}

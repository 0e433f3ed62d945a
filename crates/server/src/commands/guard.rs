//! Reads untrusted files in a child process with a limit on memory and, where [`ReadingTime`] is used, on time. A file
//! of a few bytes can need gigabytes.

use std::process::{Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::failure::{Failure, Outcome};
use crate::own_program::own_program;
use crate::say;

/// Name of the environment variable that marks a child process, so that the child does not start a further child.
const CHILD: &str = "LIGHTBOTS_READING_CHILD";

/// Most memory for data of the child, bytes. A child that needs more is ended.
const MEMORY_MAX: u64 = 400 << 20;

/// Longest time for reading untrusted files, where [`ReadingTime`] is used. A child that takes longer exits with
/// [`TOO_LONG`].
const READING_MAX: Duration = Duration::from_secs(10);

/// Exit code of a child that took too long. No command uses this code.
const TOO_LONG: i32 = 75;

/// Whether this process is the child.
fn is_child() -> bool {
    std::env::var_os(CHILD).is_some()
}

/// If `reads_foreign_files`, runs this command again in a child process and returns the outcome of that child. Otherwise
/// returns `None`. In the child itself, limits the memory and returns `None`.
pub fn child_outcome(reads_foreign_files: bool) -> Option<Outcome> {
    if is_child() {
        limit_memory();
        return None;
    }
    reads_foreign_files.then(run_in_child)
}

/// Returns the command that starts this program as a child for reading untrusted files.
pub fn reading_child() -> Command {
    let mut child = Command::new(own_program());
    child.env(CHILD, "1").stdin(Stdio::null());
    child
}

/// Returns the predicate of a message about a source: why a child could not read it, and what to do. `None` if the child
/// ended by itself, after printing the reason of any failure. A child that a signal killed counts as out of memory.
pub fn reading_failure(status: ExitStatus) -> Option<String> {
    match status.code() {
        Some(TOO_LONG) => {
            Some(format!("takes more than {} s to read; make its file simpler", READING_MAX.as_secs()))
        }
        Some(_) => None,
        None => Some(format!("needs more than {} MB to read; make its file smaller", MEMORY_MAX >> 20)),
    }
}

/// Runs the same command in a child process and returns its outcome. A child over its limit of time or memory becomes
/// an error that says so. If the child ends with an error of its own, this process exits with the same code.
fn run_in_child() -> Outcome {
    let status = reading_child()
        .args(std::env::args_os().skip(1))
        .status()
        .map_err(|error| Failure::problem(format!("no process can be started: {error}")))?;
    match (status.code(), reading_failure(status)) {
        (_, Some(why)) => Err(Failure::input(format!("a source {why}"))),
        (Some(0), None) => Ok(true),
        (Some(1), None) => Ok(false),
        // The child has printed the reason.
        (code, None) => std::process::exit(code.unwrap_or(2)),
    }
}

/// Time limit for reading: if this process is the child, ends it when reading takes longer than `READING_MAX`.
pub struct ReadingTime(Arc<AtomicBool>);

impl ReadingTime {
    /// Starts the time limit if this process is the child. The limit holds until [`ReadingTime::decoded`] is called.
    pub fn start() -> Self {
        let done = Arc::new(AtomicBool::new(false));
        if is_child() {
            let watched = Arc::clone(&done);
            std::thread::spawn(move || {
                std::thread::sleep(READING_MAX);
                if !watched.load(Ordering::Acquire) {
                    std::process::exit(TOO_LONG);
                }
            });
        }
        Self(done)
    }

    /// Ends the time limit: all untrusted files have been read.
    pub fn decoded(&self) {
        self.0.store(true, Ordering::Release);
    }
}

fn limit_memory() {
    if let Err(error) = rlimit::Resource::DATA.set(MEMORY_MAX, MEMORY_MAX) {
        say::note(&format!("memory cannot be limited here: {error}"));
    }
}

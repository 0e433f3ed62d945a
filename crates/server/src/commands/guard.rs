//! Files of others are read in a child process with limits on memory and time: a file of a few bytes can ask for gigabytes.

use std::process::{Command, ExitStatus, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::failure::{Failure, Outcome};
use crate::own_program::own_program;
use crate::say;

/// Set for the child, so that it does not start another one.
const CHILD: &str = "LIGHTBOTS_READING_CHILD";

/// Most memory of the child, bytes.
const MEMORY_MAX: u64 = 400 << 20;

/// How long reading the sources may take.
const READING_MAX: Duration = Duration::from_secs(10);

/// Exit code of a child that took too long; other than all codes of commands.
const TOO_LONG: i32 = 75;

/// Whether this process is the child.
fn is_child() -> bool {
    std::env::var_os(CHILD).is_some()
}

/// Where files of others are to be read, the outcome of a child that runs the same command. `None`: there are none, or this
/// process is the child; its memory is limited from now on.
pub fn child_outcome(reads_foreign_files: bool) -> Option<Outcome> {
    if is_child() {
        limit_memory();
        return None;
    }
    reads_foreign_files.then(run_in_child)
}

/// This program as a child that reads what is not to be trusted.
pub fn reading_child() -> Command {
    let mut child = Command::new(own_program());
    child.env(CHILD, "1").stdin(Stdio::null());
    child
}

/// Why a child could not read, and what to do; `None`: it has said why.
pub fn reading_failure(status: ExitStatus) -> Option<String> {
    match status.code() {
        Some(TOO_LONG) => {
            Some(format!("takes more than {} s to read; make its file simpler", READING_MAX.as_secs()))
        }
        Some(_) => None,
        None => Some(format!("needs more than {} MB to read; make its file smaller", MEMORY_MAX >> 20)),
    }
}

/// Runs the same command in a child process and ends as it does.
fn run_in_child() -> Outcome {
    let status = reading_child()
        .args(std::env::args_os().skip(1))
        .status()
        .map_err(|error| Failure::problem(format!("no process can be started: {error}")))?;
    match (status.code(), reading_failure(status)) {
        (_, Some(why)) => Err(Failure::input(format!("a source {why}"))),
        (Some(0), None) => Ok(true),
        (Some(1), None) => Ok(false),
        // It has said why.
        (code, None) => std::process::exit(code.unwrap_or(2)),
    }
}

/// Ends the child if reading takes too long.
pub struct ReadingTime(Arc<AtomicBool>);

impl ReadingTime {
    /// Limits time until [`ReadingTime::decoded`], if this process is the child.
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

    /// Everything foreign has been read.
    pub fn decoded(&self) {
        self.0.store(true, Ordering::Release);
    }
}

fn limit_memory() {
    if let Err(error) = rlimit::Resource::DATA.set(MEMORY_MAX, MEMORY_MAX) {
        say::note(&format!("memory cannot be limited here: {error}"));
    }
}

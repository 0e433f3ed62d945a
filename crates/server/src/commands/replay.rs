//! `replay`: plays a recorded run again, input by input, and compares the outputs.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use lightbots_api::rounded;
use lightbots_control::{LogEnd, LogError, ReplayReport, replay};
use lightbots_report::{RunLine, run_lines};
use serde_json::json;

use super::{count, print_json};
use crate::cli::ReplayArguments;
use crate::data_folder::DataFolder;
use crate::disk;
use crate::failure::{Failure, Outcome};
use crate::growing_file::GrowingFile;
use crate::live::run_files::run_file;
use crate::progress::Bar;
use crate::say;

/// Longest log that is read, bytes: 16 times the longest that `run` records.
const BYTES_MAX: u64 = 32 << 30;

pub fn run(arguments: &ReplayArguments) -> Outcome {
    let recording = path_of(&arguments.run, arguments.data.as_ref());
    if let Some(lines) = arguments.lines.as_deref().filter(|lines| is_same_file(lines, &recording)) {
        let why = format!("--lines: {} is the recording itself; choose another file", lines.display());
        return Err(Failure::input(why));
    }
    let mut lines = arguments.lines.as_deref().map(GrowingFile::create).transpose()?;
    let (report, bytes) = replayed(&arguments.run, arguments.data.as_ref(), "replaying", |log, progress| {
        let report = match &mut lines {
            Some(lines) => run_lines(log, progress, &mut |line| append(lines, line))?,
            None => replay(log, progress)?,
        };
        Ok((report, log.len()))
    })?;
    lines.map_or(Ok(()), GrowingFile::finish)?;
    let ok = report.difference.is_none();
    if arguments.json {
        print_json(&as_json(&report))?
    } else {
        print(&report, bytes)
    }
    Ok(ok)
}

/// Returns the path of a run's file. `run` is that path, or the number of a run in the data folder `data`. A path that
/// exists has precedence.
fn path_of(run: &Path, data: Option<&PathBuf>) -> PathBuf {
    let number = run.to_str().and_then(|text| text.parse().ok());
    match number.filter(|_| !run.exists()) {
        Some(number) => run_file(&data.cloned().unwrap_or_else(DataFolder::usual), number),
        None => run.to_owned(),
    }
}

fn is_same_file(one: &Path, other: &Path) -> bool {
    matches!((one.canonicalize(), other.canonicalize()), (Ok(one), Ok(other)) if one == other)
}

fn append(lines: &mut GrowingFile<'_>, line: &RunLine) {
    // Every line can be written as JSON.
    let Ok(mut text) = serde_json::to_vec(line) else { return };
    text.push(b'\n');
    lines.append(&text);
}

/// Reads the log of a run and returns the result of `replay` on it. `run` is a file, or the number of a run in the data
/// folder `data`. `doing` is the text at the progress bar.
pub fn replayed<T>(
    run: &Path,
    data: Option<&PathBuf>,
    doing: &str,
    replay: impl FnOnce(&[u8], &mut dyn FnMut(f64)) -> Result<T, LogError>,
) -> Result<T, Failure> {
    let path = path_of(run, data);
    let failed = |why: String| Failure::input(format!("{}: {why}", path.display()));
    let log =
        disk::read_regular(&path, BYTES_MAX).map_err(|error| failed(format!("cannot be read: {error}")))?;
    // The log may come from a program that panicked. The controller then panics again, and its state is discarded.
    let made = catch_unwind(AssertUnwindSafe(|| {
        let bar = Bar::new();
        replay(&log, &mut |share| bar.set(share, doing))
    }));
    let Ok(made) = made else {
        return Err(Failure::problem(format!("{}: the controller failed in this run", path.display())));
    };
    made.map_err(|error| failed(error.to_string()))
}

fn as_json(report: &ReplayReport) -> serde_json::Value {
    let difference = report.difference.as_ref().map(|found| {
        let at_s = rounded(found.at.as_secs(), 6);
        json!({ "input": found.input, "at_s": at_s, "what": found.what, "outputs": found.outputs })
    });
    json!({
        "ok": difference.is_none(),
        "robots": report.robots,
        "inputs": report.inputs,
        "messages": report.messages,
        "plans": report.plans,
        "outputs": report.outputs,
        "duration_s": rounded(report.lasted.as_secs(), 3),
        "complete": is_complete(report.end),
        "digest": format!("{:016x}", report.digest),
        "program": report.program,
        "notes": report.notes.iter().cloned().collect::<std::collections::BTreeMap<_, _>>(),
        "difference": difference,
    })
}

/// Whether the log ends as its writer ended it. `None` if the replay did not reach the end of the log.
fn is_complete(end: LogEnd) -> Option<bool> {
    match end {
        LogEnd::Complete => Some(true),
        LogEnd::Cut(_) => Some(false),
        LogEnd::NotReached => None,
    }
}

fn print(report: &ReplayReport, bytes: usize) {
    if let Some(found) = &report.difference {
        let at_s = found.at.as_secs();
        say::line(&format!("the outputs differ after input {} at {at_s:.6} s: {}", found.input, found.what));
        for line in &found.outputs {
            say::line(&format!("  now: {line}"));
        }
        if report.program != env!("CARGO_PKG_VERSION") {
            say::line(&format!("it was recorded by version {}", report.program));
        }
        return;
    }
    if let LogEnd::Cut(after) = report.end {
        say::line(&format!("the log was cut: only {after} of its {bytes} bytes can be replayed"));
    }
    let notes: Vec<String> = report.notes.iter().map(|(name, value)| format!("{name} {value}")).collect();
    say::line(&format!(
        "the same to the bit: {} in {:.1} s of {}, {} and {} compared",
        count(report.inputs as usize, "input"),
        report.lasted.as_secs(),
        count(report.robots, "robot"),
        count(report.plans as usize, "plan"),
        count(report.outputs as usize, "output"),
    ));
    say::line(&format!("digest {:016x}; {}", report.digest, notes.join(", ")));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_that_was_not_read_to_its_end_is_neither_complete_nor_cut() {
        let ends = [LogEnd::Complete, LogEnd::Cut(9), LogEnd::NotReached].map(is_complete);
        assert_eq!(ends, [Some(true), Some(false), None]);
    }
}

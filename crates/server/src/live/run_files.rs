//! Files of recorded runs in the data folder: which there are, and which are deleted for new ones.

use std::fs::DirEntry;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::disk;

/// Folder of recorded runs in the data folder.
const FOLDER: &str = "runs";
/// File name ending of a recorded run.
const ENDING: &str = ".lblog";
/// Most recorded runs that are kept, the next one included.
const RUNS_MAX: usize = 20;
/// Most bytes of all recorded runs together, including [`RUN_BYTES_MAX`] for the next run. The oldest runs are deleted to
/// stay below this bound.
const BYTES_MAX: u64 = 4 << 30;
/// Most bytes of one recorded run; what comes later is not recorded. A robot takes 9 to 23 KB a minute, so that an hour
/// and a half of a thousand robots with light fits.
pub const RUN_BYTES_MAX: u64 = 2 << 30;
/// Returns the path of the recorded run with this number.
pub fn run_file(data: &Path, number: u64) -> PathBuf {
    data.join(FOLDER).join(format!("{number:06}{ENDING}"))
}

/// Returns the path of the facts of a run, beside its log.
pub fn facts_file(log: &Path) -> PathBuf {
    log.with_extension("json")
}

/// Returns the path of the report of a run, beside its log. The file exists once the report was made.
pub fn report_file(log: &Path) -> PathBuf {
    log.with_extension("html")
}

/// Returns the path for the next run. Deletes old runs to make room for it.
pub fn next_run(data: &Path) -> std::io::Result<PathBuf> {
    let folder = data.join(FOLDER);
    disk::create_folder(&folder)?;
    let runs = recorded_runs(data)?;
    let mut bytes = RUN_BYTES_MAX;
    for (place, &(number, length)) in runs.iter().enumerate() {
        bytes += length;
        if place + 1 >= RUNS_MAX || bytes > BYTES_MAX {
            remove_run(data, number)?;
        }
    }
    Ok(run_file(data, runs.first().map_or(1, |&(number, _)| number + 1)))
}

fn remove_run(data: &Path, number: u64) -> std::io::Result<()> {
    let log = run_file(data, number);
    for beside in [facts_file(&log), report_file(&log)] {
        match disk::remove(&beside) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    disk::remove(&log)
}

/// Returns numbers and lengths (bytes) of the recorded runs, the newest first.
pub fn recorded_runs(data: &Path) -> std::io::Result<Vec<(u64, u64)>> {
    let folder = match std::fs::read_dir(data.join(FOLDER)) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        folder => folder?,
    };
    let mut runs: Vec<(u64, u64)> = folder.flatten().filter_map(run_of_entry).collect();
    runs.sort_unstable_by(|a, b| b.cmp(a));
    Ok(runs)
}

/// Returns number and length (bytes) of a recorded run; `None` for other files.
fn run_of_entry(entry: DirEntry) -> Option<(u64, u64)> {
    let name = entry.file_name();
    let number = name.to_str()?.strip_suffix(ENDING)?.parse().ok()?;
    Some((number, entry.metadata().ok().filter(|file| file.is_file())?.len()))
}

#[cfg(test)]
mod tests {
    use std::fs::File;

    use super::*;

    #[test]
    fn the_last_runs_are_kept() {
        let data = std::env::temp_dir().join(format!("lightbots-runs-{}", std::process::id()));
        for number in 1..=25 {
            let path = next_run(&data).unwrap();
            assert_eq!(path, run_file(&data, number));
            for file in [&path, &facts_file(&path), &report_file(&path)] {
                File::create(file).unwrap();
            }
        }
        let kept: Vec<u64> = recorded_runs(&data).unwrap().iter().map(|run| run.0).collect();
        assert_eq!(kept, (6..=25).rev().collect::<Vec<_>>());
        assert_eq!(std::fs::read_dir(data.join(FOLDER)).unwrap().count(), 3 * kept.len());
        let large = File::create(run_file(&data, 25)).unwrap();
        large.set_len(BYTES_MAX).unwrap();
        next_run(&data).unwrap();
        assert_eq!(std::fs::read_dir(data.join(FOLDER)).unwrap().count(), 0);
        std::fs::remove_dir_all(data).unwrap();
    }
}

//! Which files of a data folder belong to a backup, and which paths of a backup may become files.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::LIST;

/// Deepest folder in a data folder: `history/NAME/NUMBER.lightbots.json` has two.
const DEPTH_MAX: usize = 16;
/// Longest path in a backup, bytes: as long as Linux allows names of files.
const PATH_MAX: usize = 4096;
/// Files of a running program, which say nothing once it has ended. The journal, too: a folder that is brought back must
/// not take up a run that robots drove on another day. The switch of the playlist, too: no show may start by itself then.
pub const OF_A_RUNNING_PROGRAM: [&str; 4] =
    [".lock", ".accounts-lock", "runs/present.lbjournal", "playlist-day.json"];
/// The ending of files that take the place of others once they are complete.
const DRAFT: &str = ".saving";

/// What is found in a data folder.
#[derive(Debug, Default)]
pub struct Found {
    /// Paths of regular files, with `/` between folders.
    pub files: BTreeSet<String>,
    /// What cannot be kept: links, pipes, names that are no text, folders that are too deep.
    pub odd: BTreeSet<PathBuf>,
}

/// Looks through a folder. The failure names the folder that cannot be read.
pub fn find(data: &Path) -> Result<Found, (PathBuf, std::io::Error)> {
    let mut found = Found::default();
    look(data, "", 0, &mut found)?;
    Ok(found)
}

fn look(
    folder: &Path,
    above: &str,
    depth: usize,
    found: &mut Found,
) -> Result<(), (PathBuf, std::io::Error)> {
    let failed = |error| (folder.to_owned(), error);
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        let kind = match entry.file_type() {
            Ok(kind) => kind,
            // It was removed a moment ago.
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
            Err(error) => return Err((entry.path(), error)),
        };
        let name = entry.file_name();
        let path = name.to_str().map(|name| format!("{above}{name}")).filter(|path| check(path).is_ok());
        match path {
            Some(path) if kind.is_dir() && depth < DEPTH_MAX => {
                match look(&entry.path(), &format!("{path}/"), depth + 1, found) {
                    Err((_, error)) if error.kind() == std::io::ErrorKind::NotFound => {}
                    other => other?,
                }
            }
            Some(path) if kind.is_file() => {
                if !is_left_out(&path) {
                    found.files.insert(path);
                }
            }
            _ => {
                found.odd.insert(entry.path());
            }
        }
    }
    Ok(())
}

/// Whether a file belongs to no backup.
fn is_left_out(path: &str) -> bool {
    path == LIST || path.ends_with(DRAFT) || OF_A_RUNNING_PROGRAM.contains(&path)
}

/// Refuses paths that lead out of the folder, that mean something else on another system, or that a running program uses.
pub fn check(path: &str) -> Result<(), &'static str> {
    let parts = || path.split('/');
    if path.len() > PATH_MAX || parts().count() > DEPTH_MAX + 1 {
        return Err("its path is too long");
    }
    if path.chars().any(|letter| letter.is_control() || matches!(letter, '\\' | ':')) {
        return Err("its path has signs that are no part of a file's name everywhere");
    }
    if parts().any(|part| matches!(part, "" | "." | "..")) {
        return Err("its path leads out of the folder");
    }
    Ok(())
}

/// Refuses a path of a backup that no backup has.
pub fn check_restored(path: &str) -> Result<(), &'static str> {
    check(path)?;
    if is_left_out(path) { Err("a backup never holds that file") } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_stay_in_the_folder() {
        for path in
            ["a.json", "history/My show/7.lightbots.json", ".open", "runs/000001.lblog", "ä (1)!.json"]
        {
            assert_eq!(check_restored(path), Ok(()), "{path}");
        }
        let long = "a/".repeat(20) + "a";
        for path in [
            "",
            "/",
            "/etc/passwd",
            "..",
            "../a",
            "a/../../b",
            "a//b",
            "a/",
            "./a",
            "a/.",
            "a\\b",
            "C:a",
            "C:/a",
            "a\0b",
            "a\nb",
            ".lock",
            "runs/present.lbjournal",
            "playlist-day.json",
            ".a.1.saving",
            LIST,
            &long,
        ] {
            assert!(check_restored(path).is_err(), "{path:?}");
        }
    }
}

//! Which files of a data folder belong to a backup, and which paths of a backup may become files.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::LIST;

/// Deepest folder, in levels below the data folder, that is searched for files. The program needs two:
/// `history/NAME/NUMBER.lightbots.json`.
const DEPTH_MAX: usize = 16;
/// Longest path in a backup, bytes: the limit of Linux for paths.
const PATH_MAX: usize = 4096;
/// Files that matter only while the program runs. Backups leave them out. With the journal, a restored folder would resume a
/// run that robots drove on another day. With `playlist-day.json`, shows would start by themselves after a restore.
pub const OF_A_RUNNING_PROGRAM: [&str; 4] =
    [".lock", ".accounts-lock", "runs/present.lbjournal", "playlist-day.json"];
/// Ending of files that are still being written, before they replace other files.
const DRAFT: &str = ".saving";

/// Content of a data folder.
#[derive(Debug, Default)]
pub struct Found {
    /// Paths of the regular files that a backup holds, with `/` between folders.
    pub files: BTreeSet<String>,
    /// Paths that cannot be saved: links, pipes, paths that [`check`] refuses or that are no text, folders that are too
    /// deep.
    pub odd: BTreeSet<PathBuf>,
}

/// Finds the files of a data folder and its subfolders that a backup holds, and the paths that it cannot hold. The error
/// names the folder or file that cannot be read.
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
            // The entry was removed after the folder was listed.
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

/// Whether backups leave a file out.
fn is_left_out(path: &str) -> bool {
    path == LIST || path.ends_with(DRAFT) || OF_A_RUNNING_PROGRAM.contains(&path)
}

/// Checks the path of a file in a backup. Error if the path is too long or too deep, leads out of the data folder, or has
/// characters with another meaning on other systems.
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

/// Checks a path as [`check`] does. Also an error for the files that backups leave out.
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

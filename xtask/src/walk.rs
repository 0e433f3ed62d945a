//! Lists and reads files of the source tree.

use std::path::{Path, PathBuf};

/// Names of folders that are skipped: build outputs, packages and history.
const SKIPPED: [&str; 5] = ["target", "node_modules", "dist", "generated", ".git"];

/// Files under `folder` with one of these extensions, sorted by path. Folders of `SKIPPED` are left out.
pub fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut left = vec![folder.to_path_buf()];
    while let Some(folder) = left.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = entry.file_name();
            if path.is_dir() && !SKIPPED.iter().any(|skipped| name == *skipped) {
                left.push(path);
            } else if endings.iter().any(|ending| path.extension().is_some_and(|found| found == *ending)) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The path relative to `root`, as findings print it.
pub fn shown<'a>(root: &Path, path: &'a Path) -> std::path::Display<'a> {
    path.strip_prefix(root).unwrap_or(path).display()
}

/// The files under `folder` with one of these extensions, each with its text. Test files (`.test.`) are left out.
pub fn untested(folder: &Path, endings: &[&str]) -> Vec<(PathBuf, String)> {
    let paths = files(folder, endings).into_iter();
    let paths = paths.filter(|path| !path.to_string_lossy().contains(".test."));
    paths.filter_map(|path| std::fs::read_to_string(&path).ok().map(|text| (path, text))).collect()
}

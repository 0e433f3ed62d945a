//! Checks of the source tree itself: what must be absent, and how large things may grow.

mod edges;
mod sizes;
mod sources;

use crate::shell::{self, Outcome};
use std::path::{Path, PathBuf};

/// Runs all checks and prints every finding.
pub fn run() -> Outcome {
    let root = shell::root();
    let findings: Vec<String> = [edges::findings(&root), sources::findings(&root), sizes::findings(&root)]
        .into_iter()
        .flatten()
        .collect();
    for finding in &findings {
        println!("tidy: {finding}");
    }
    if findings.is_empty() { Ok(()) } else { Err(format!("{} findings in the source tree", findings.len())) }
}

/// Files under `folder` with one of these endings, in order of their names; build outputs are left out.
fn files(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut left = vec![folder.to_path_buf()];
    while let Some(folder) = left.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let name = entry.file_name();
            if path.is_dir() && !["target", "node_modules", "dist", ".git"].iter().any(|skip| name == *skip) {
                left.push(path);
            } else if endings.iter().any(|ending| path.extension().is_some_and(|found| found == *ending)) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn shown<'a>(root: &Path, path: &'a Path) -> std::path::Display<'a> {
    path.strip_prefix(root).unwrap_or(path).display()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_tree_is_tidy() {
        assert_eq!(super::run(), Ok(()));
    }
}

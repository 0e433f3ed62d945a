//! Files stay small enough to be read.

use super::{files, shown};
use std::path::Path;

const LONGEST_SOURCE: usize = 600;
const LONGEST_COMPONENT: usize = 150;

/// Every file that has grown too long. Generated files are not read by people.
pub fn findings(root: &Path) -> Vec<String> {
    files(root, &["rs", "ts", "tsx"])
        .iter()
        .filter(|path| !path.to_string_lossy().ends_with(".gen.ts"))
        .filter_map(|path| {
            let lines = std::fs::read_to_string(path).ok()?.lines().count();
            let component = path.extension().is_some_and(|ending| ending == "tsx");
            let most = if component { LONGEST_COMPONENT } else { LONGEST_SOURCE };
            (lines > most).then(|| format!("{}: {lines} lines, {most} are the most", shown(root, path)))
        })
        .collect()
}

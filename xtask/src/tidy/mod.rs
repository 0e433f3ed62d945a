//! Checks of the source tree itself: what must be absent, and how large things may grow.

mod circles;
mod edges;
mod names;
mod screen;
mod sizes;
mod sources;
mod styles;
mod width;

use crate::shell::{self, Outcome};
use crate::walk::{files, shown, untested};

/// Runs all checks and prints every finding.
pub fn run() -> Outcome {
    let root = shell::root();
    let (parsed, broken) = crate::house::tree::read(&root);
    let findings: Vec<String> = [
        broken,
        edges::findings(&root),
        sources::findings(&root),
        sizes::findings(&root),
        width::findings(&root),
        circles::findings(&parsed),
        names::findings(&parsed),
        screen::findings(&root),
        styles::findings(&root),
    ]
    .into_iter()
    .flatten()
    .collect();
    for finding in &findings {
        println!("tidy: {finding}");
    }
    if findings.is_empty() { Ok(()) } else { Err(format!("{} findings in the source tree", findings.len())) }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_tree_is_tidy() {
        assert_eq!(super::run(), Ok(()));
    }
}

//! No file of a crate uses itself over others, so that each can be read after those it uses.

use crate::house::modules::circles;
use crate::house::tree::Source;

/// Files in circles that a crate may have.
struct Exception {
    krate: &'static str,
    /// Files that stand in a circle, at most.
    files_max: usize,
    /// Why these files use each other.
    reason: &'static str,
}

const fn exception(krate: &'static str, files_max: usize, reason: &'static str) -> Exception {
    Exception { krate, files_max, reason }
}

/// Crates with circles.
const EXCEPTIONS: [Exception; 4] = [
    exception("crates/plan", 4, "stop-safety and delays hold constants that the files below them use"),
    exception("crates/robot", 11, "the methods of `Robot` lie in the files of its concerns"),
    exception("crates/server", 9, "handlers use the state in `web/mod.rs`, which routes to them"),
    exception("crates/sim", 4, "a rehearsal is played, and the play reports to it"),
];

/// Every crate with more files in circles than it may have.
pub fn findings(sources: &[Source]) -> Vec<String> {
    let mut crates: Vec<&str> = sources.iter().map(Source::krate).collect();
    crates.dedup();
    let all = circles(sources);
    crates.into_iter().filter_map(|krate| finding(krate, &all)).collect()
}

fn finding(krate: &str, circles: &[Vec<String>]) -> Option<String> {
    let own: Vec<&Vec<String>> =
        circles.iter().filter(|circle| circle[0].starts_with(&format!("{krate}/"))).collect();
    let files: usize = own.iter().map(|circle| circle.len()).sum();
    let allowed = EXCEPTIONS.iter().find(|exception| exception.krate == krate);
    if files <= allowed.map_or(0, |exception| exception.files_max) {
        return None;
    }
    let allowed = allowed.map_or_else(String::new, |exception| {
        format!("; {} are the most because {}", exception.files_max, exception.reason)
    });
    let circles: Vec<String> = own.iter().map(|circle| circle.join(" ")).collect();
    Some(format!("{krate}: {files} files use each other{allowed}: {}", circles.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crate_without_an_exception_has_no_circles() {
        let circles = [vec!["crates/base/src/a.rs".to_owned(), "crates/base/src/b.rs".to_owned()]];
        assert_eq!(
            finding("crates/base", &circles).as_deref(),
            Some("crates/base: 2 files use each other: crates/base/src/a.rs crates/base/src/b.rs")
        );
        assert_eq!(finding("crates/bas", &circles), None);
        assert_eq!(finding("crates/wire", &circles), None);
    }

    #[test]
    fn an_exception_bounds_the_files_in_circles() {
        let circle = |length: usize| vec![vec!["crates/sim/src/a.rs".to_owned(); length]];
        assert_eq!(finding("crates/sim", &circle(4)), None);
        assert!(finding("crates/sim", &circle(5)).is_some_and(|finding| finding.contains("because")));
    }
}

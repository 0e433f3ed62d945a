//! Checks that cores use no clocks, sockets, files, threads or random sources.

use super::{files, shown};
use std::path::Path;

/// Crates that are checked, because they must have no IO.
const CORES: [&str; 11] =
    ["base", "wire", "show", "draw", "light", "make", "plan", "exchange", "robot", "control", "sim"];
/// Crates that must be `no_std`, because they run on microcontrollers.
const NO_STD: [&str; 3] = ["base", "wire", "robot"];
/// Text that must not appear in a core.
const ABSENT: [&str; 8] = [
    "std::time::",
    "std::net",
    "std::fs",
    "std::thread",
    "std::env",
    "rand::thread_rng",
    "SystemTime",
    "RandomState",
];

/// All lines of cores outside comments that contain text of `ABSENT`, and crates of `NO_STD` without `no_std`.
pub fn findings(root: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for core in CORES {
        let source = root.join("crates").join(core).join("src");
        for path in files(&source, &["rs"]) {
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let lines = text.lines().enumerate().filter(|(_, line)| reaches_outside(line));
            found.extend(lines.map(|(number, line)| {
                format!("{}:{}: a core reaches outside: {}", shown(root, &path), number + 1, line.trim())
            }));
        }
        let first = std::fs::read_to_string(source.join("lib.rs")).unwrap_or_default();
        if NO_STD.contains(&core) && !first.contains("no_std") {
            found.push(format!("crates/{core}/src/lib.rs: must be no_std"));
        }
    }
    found
}

fn reaches_outside(line: &str) -> bool {
    !line.trim_start().starts_with("//") && ABSENT.iter().any(|word| line.contains(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_in_a_core_is_found_and_a_comment_is_not() {
        assert!(reaches_outside("let now = std::time::Instant::now();"));
        assert!(!reaches_outside("// std::time:: has no place here"));
    }
}

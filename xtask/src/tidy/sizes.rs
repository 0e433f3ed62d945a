//! Checks that files and functions are short enough to be read.

use super::{files, shown};
use crate::house::FUNCTION_LINES_MAX;
use crate::house::functions::{Function, functions};
use std::path::Path;

/// Most lines of a Rust or TypeScript file.
const SOURCE_LINES_MAX: usize = 600;
/// Most lines of a file with UI components (`.tsx`).
const COMPONENT_LINES_MAX: usize = 150;

/// Every file and Rust function that is too long. Generated files are exempt.
pub fn findings(root: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for path in files(root, &["rs", "ts", "tsx"]) {
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let place = shown(root, &path).to_string();
        if place.ends_with(".gen.ts") {
            continue;
        }
        let most = if place.ends_with(".tsx") { COMPONENT_LINES_MAX } else { SOURCE_LINES_MAX };
        let lines = text.lines().count();
        if lines > most {
            found.push(format!("{place}: {lines} lines, {most} are the most"));
        }
        if place.ends_with(".rs") {
            found.extend(long_functions(&text).iter().map(|function| {
                let Function { name, line, lines } = function;
                format!("{place}:{line}: `{name}` has {lines} lines, {FUNCTION_LINES_MAX} are the most")
            }));
        }
    }
    found
}

fn long_functions(text: &str) -> Vec<Function> {
    let all = syn::parse_file(text).map(|syntax| functions(&syntax)).unwrap_or_default();
    all.into_iter().filter(|function| function.lines > FUNCTION_LINES_MAX).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_function_of_seventy_lines_is_short_enough() {
        let with = |lines: usize| format!("fn f() {{\n{}}}\n", "g();\n".repeat(lines - 2));
        assert!(long_functions(&with(FUNCTION_LINES_MAX)).is_empty());
        assert_eq!(long_functions(&with(FUNCTION_LINES_MAX + 1)).len(), 1);
    }
}

//! Checks the length of lines. rustfmt breaks code, but neither comments nor texts.

use super::{files, shown};
use std::path::Path;

/// Most characters of a line. Code lines that contain a quote, or end with a backslash or a comma, may be longer.
const LINE_CHARACTERS_MAX: usize = 125;

/// Every line of Rust and TypeScript that is too long.
pub fn findings(root: &Path) -> Vec<String> {
    let mut found = Vec::new();
    for path in files(root, &["rs", "ts", "tsx"]) {
        let place = shown(root, &path).to_string();
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let wide = text.lines().enumerate().filter(|(_, line)| !place.ends_with(".gen.ts") && is_wide(line));
        found.extend(wide.map(|(number, line)| {
            let characters = line.chars().count();
            format!("{place}:{}: {characters} characters, {LINE_CHARACTERS_MAX} are the most", number + 1)
        }));
    }
    found
}

fn is_wide(line: &str) -> bool {
    let holds_text =
        ['"', '\'', '`'].iter().any(|quote| line.contains(*quote)) || line.ends_with(['\\', ',']);
    let is_comment = ["//", "*", "/*"].iter().any(|mark| line.trim_start().starts_with(mark));
    line.chars().count() > LINE_CHARACTERS_MAX && (is_comment || !holds_text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_code_are_bounded_and_texts_are_not() {
        let long = "word ".repeat(30);
        assert!(is_wide(&format!("    /// {long}")));
        assert!(is_wide(&format!("    let sum = {long};")));
        assert!(!is_wide(&format!("    let text = \"{long}\";")));
        assert!(!is_wide("    /// short"));
    }
}

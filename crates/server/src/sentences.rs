//! Turns lines for people into sentences.

/// Returns a line with a capital letter first.
pub fn capitalised(line: &str) -> String {
    let mut letters = line.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    first + letters.as_str()
}

/// Returns a line as a sentence: a capital letter first, a full stop last.
pub fn sentence(line: &str) -> String {
    capitalised(line.trim_end_matches('.')) + "."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_has_a_capital_letter_and_one_full_stop() {
        assert_eq!(sentence("the broker is gone"), "The broker is gone.");
        assert_eq!(sentence("Überall."), "Überall.");
        assert_eq!((capitalised("élan"), capitalised("")), ("Élan".into(), String::new()));
    }
}

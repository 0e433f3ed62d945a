//! Checks that a type name has one meaning in the whole repository.

use crate::house::names::doubled;
use crate::house::tree::Source;

/// Names that may be defined in more than one place, and in how many places at most.
const EXCEPTIONS: [(&str, usize); 10] = [
    ("Abilities", 2),
    ("Choice", 2),
    ("Command", 2),
    ("Config", 2),
    ("Fleet", 2),
    ("Issue", 2),
    ("Operation", 2),
    ("Path", 2),
    ("Severity", 2),
    ("Transition", 2),
];

/// Every type name that is defined in more places than it may be.
pub fn findings(sources: &[Source]) -> Vec<String> {
    let wrong = doubled(sources).into_iter().filter(|(name, places)| places.len() > meanings_max(name));
    wrong
        .map(|(name, places)| format!("`{name}` has {} meanings: {}", places.len(), places.join(", ")))
        .collect()
}

fn meanings_max(name: &str) -> usize {
    EXCEPTIONS.iter().find(|(exception, _)| *exception == name).map_or(1, |(_, most)| *most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::house::tree::parsed;

    #[test]
    fn a_second_meaning_is_found() {
        let file = |name: &str| parsed(&format!("crates/a/src/{name}.rs"), "pub struct Unheard;");
        assert!(findings(&[file("a")]).is_empty());
        assert_eq!(
            findings(&[file("a"), file("b")]),
            ["`Unheard` has 2 meanings: crates/a/src/a.rs:1, crates/a/src/b.rs:1"]
        );
    }
}

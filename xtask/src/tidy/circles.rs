//! Checks that the files of a crate form no circle of uses, so that each can be read after those it uses.

use crate::house::modules::circles;
use crate::house::tree::Source;

/// One line for each crate with circles of files.
pub fn findings(sources: &[Source]) -> Vec<String> {
    let mut crates: Vec<&str> = sources.iter().map(Source::krate).collect();
    crates.dedup();
    let all = circles(sources);
    crates.into_iter().filter_map(|krate| finding(krate, &all)).collect()
}

fn finding(krate: &str, circles: &[Vec<String>]) -> Option<String> {
    let is_own = |circle: &&Vec<String>| circle[0].starts_with(&format!("{krate}/"));
    let own: Vec<String> = circles.iter().filter(is_own).map(|circle| circle.join(" ")).collect();
    (!own.is_empty()).then(|| format!("{krate}: files use each other: {}", own.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_circle_is_named_with_its_crate() {
        let circle = |names: [&str; 2]| names.map(|name| format!("crates/base/src/{name}.rs")).to_vec();
        let circles = [circle(["a", "b"]), circle(["c", "d"])];
        assert_eq!(
            finding("crates/base", &circles).as_deref(),
            Some(
                "crates/base: files use each other: crates/base/src/a.rs crates/base/src/b.rs; \
                 crates/base/src/c.rs crates/base/src/d.rs"
            )
        );
        assert_eq!(finding("crates/bas", &circles), None);
        assert_eq!(finding("crates/wire", &circles), None);
    }
}

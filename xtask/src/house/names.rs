//! Types that are visible outside their file: names with two meanings. Also the public fields of the largest struct of
//! each crate.

use super::tree::Source;
use std::collections::BTreeMap;
use syn::{Ident, Item, ItemMod, Visibility};

/// Type names that are defined in more than one place of the crates, each with `path:line` of all places. Private types
/// do not count.
pub fn doubled(sources: &[Source]) -> BTreeMap<String, Vec<String>> {
    let mut places: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for source in sources.iter().filter(|source| source.path.starts_with("crates/")) {
        for name in public_types(&source.syntax.items) {
            let place = format!("{}:{}", source.path, name.span().start().line);
            places.entry(name.to_string()).or_default().push(place);
        }
    }
    places.retain(|_, places| places.len() > 1);
    places
}

fn public_types(items: &[Item]) -> Vec<&Ident> {
    let mut found = Vec::new();
    for item in items {
        let (visibility, name) = match item {
            Item::Struct(item) => (&item.vis, &item.ident),
            Item::Enum(item) => (&item.vis, &item.ident),
            Item::Trait(item) => (&item.vis, &item.ident),
            Item::Type(item) => (&item.vis, &item.ident),
            Item::Mod(ItemMod { content: Some((_, items)), .. }) => {
                found.extend(public_types(items));
                continue;
            }
            _ => continue,
        };
        if !matches!(visibility, Visibility::Inherited) {
            found.push(name);
        }
    }
    found
}

/// The struct with the most public fields of each crate, as `(crate, struct, fields)`.
pub fn largest_structs(sources: &[Source]) -> Vec<(String, String, usize)> {
    let mut largest: BTreeMap<&str, (String, usize)> = BTreeMap::new();
    for source in sources {
        for item in &source.syntax.items {
            let Item::Struct(item) = item else { continue };
            let fields =
                item.fields.iter().filter(|field| matches!(field.vis, Visibility::Public(_))).count();
            let entry = largest.entry(source.krate()).or_default();
            if fields > entry.1 {
                *entry = (item.ident.to_string(), fields);
            }
        }
    }
    largest.into_iter().map(|(krate, (name, fields))| (krate.to_owned(), name, fields)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::tree::parsed;
    use super::*;

    #[test]
    fn a_public_name_in_two_files_has_two_meanings() {
        let sources = [
            parsed("crates/a/src/lib.rs", "pub struct Drive; struct Own; pub(crate) struct Near;"),
            parsed("crates/b/src/lib.rs", "pub enum Drive {} pub struct Own; pub struct Near;"),
        ];
        let found = doubled(&sources);
        assert_eq!(found.keys().collect::<Vec<_>>(), ["Drive", "Near"]);
        assert_eq!(found["Drive"], ["crates/a/src/lib.rs:1", "crates/b/src/lib.rs:1"]);
    }

    #[test]
    fn only_public_fields_count() {
        let sources = [parsed(
            "crates/a/src/lib.rs",
            "pub struct A { pub b: u8, c: u8 } struct D { pub e: u8, pub f: u8 }",
        )];
        assert_eq!(largest_structs(&sources), [("crates/a".to_owned(), "D".to_owned(), 2)]);
    }
}

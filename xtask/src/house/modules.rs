//! Which file of a crate uses which other file, and circles of files that use each other.
//!
//! A file uses another file if a path in its code leads to an item there. It also uses a file that holds a method of
//! its type, if it calls that method on `self`. Paths are followed through imports to the item's own file. Neither a
//! re-export alone nor the declaration of a module is a use.

use super::modules_scope::{Scope, Scopes, import_paths};
use super::tree::Source;
use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use std::collections::{BTreeMap, BTreeSet};
use syn::{ImplItem, Item, ItemMod, Visibility};

/// A path in the code, split at `::` into one or more segments.
type NamePath = Vec<String>;
/// A used file, and the path that leads to it.
type Use = (String, String);
/// For each file, the files that it uses, each with one path that leads there.
type Edges = BTreeMap<String, BTreeMap<String, String>>;

/// Circles of files in each crate. A circle is the sorted paths of files that use each other, directly or through
/// others.
pub fn circles(sources: &[Source]) -> Vec<Vec<String>> {
    let mut crates: BTreeMap<&str, Vec<&Source>> = BTreeMap::new();
    for source in sources {
        crates.entry(source.krate()).or_default().push(source);
    }
    crates.values().flat_map(|files| components(&edges(files))).collect()
}

/// Each use of one file by another inside these circles, as `file uses file: path`.
pub fn circle_edges(sources: &[Source], circles: &[Vec<String>]) -> Vec<String> {
    let mut found = Vec::new();
    for circle in circles {
        let krate = |source: &&Source| circle[0].starts_with(&format!("{}/src/", source.krate()));
        let edges = edges(&sources.iter().filter(krate).collect::<Vec<_>>());
        for file in circle {
            let inside = edges[file].iter().filter(|(used, _)| circle.contains(used));
            found.extend(inside.map(|(used, name)| format!("{file} uses {used}: {name}")));
        }
    }
    found
}

/// The uses between files of one crate.
fn edges(files: &[&Source]) -> Edges {
    let scopes = Scopes::of(files);
    let methods = inherent_methods(files);
    let mut edges = Edges::new();
    for file in files {
        let scope = scopes.of_file(&file.path);
        let mut used: BTreeMap<String, String> =
            imported(&file.syntax.items, scope, &scopes).into_iter().collect();
        for item in &file.syntax.items {
            used.extend(mentioned(item, scope, &scopes));
            used.extend(called(item, &methods));
        }
        used.remove(&file.path);
        edges.insert(file.path.clone(), used);
    }
    edges
}

/// The files that private imports lead to. A re-export counts only if the file itself mentions the name.
fn imported(items: &[Item], scope: &Scope, scopes: &Scopes) -> Vec<Use> {
    let mut used = Vec::new();
    for item in items {
        match item {
            Item::Use(import) if matches!(import.vis, Visibility::Inherited) => {
                let paths = import_paths(&import.tree).into_iter();
                used.extend(paths.filter_map(|(path, _)| used_by(scope, &path, scopes)));
            }
            Item::Mod(ItemMod { content: Some((_, items)), .. }) => {
                used.extend(imported(items, scope, scopes))
            }
            _ => {}
        }
    }
    used
}

fn used_by(scope: &Scope, path: &NamePath, scopes: &Scopes) -> Option<Use> {
    Some((scopes.item_file(scope, path)?, path.join("::")))
}

/// The files that paths in the code of this item lead to.
fn mentioned(item: &Item, scope: &Scope, scopes: &Scopes) -> Vec<Use> {
    if matches!(item, Item::Use(_)) {
        return Vec::new();
    }
    let mut paths = BTreeSet::new();
    collect_paths(item.to_token_stream(), &mut paths);
    paths.iter().filter_map(|path| used_by(scope, path, scopes)).collect()
}

/// Collects all paths `a::b::c` and single names of these tokens. A name behind a dot is left out: it is a field or
/// method.
fn collect_paths(tokens: TokenStream, paths: &mut BTreeSet<NamePath>) {
    let (mut path, mut colons, mut after_dot): (NamePath, usize, bool) = (Vec::new(), 0, false);
    for token in tokens {
        match token {
            TokenTree::Ident(name) if colons == 2 && !path.is_empty() => path.push(name.to_string()),
            TokenTree::Ident(name) => {
                finish(&mut path, paths);
                if !after_dot {
                    path.push(name.to_string());
                }
            }
            TokenTree::Punct(mark) if mark.as_char() == ':' && !path.is_empty() => {
                colons += 1;
                continue;
            }
            other => {
                finish(&mut path, paths);
                after_dot = matches!(&other, TokenTree::Punct(mark) if mark.as_char() == '.');
                if let TokenTree::Group(group) = other {
                    collect_paths(group.stream(), paths);
                }
                colons = 0;
                continue;
            }
        }
        (colons, after_dot) = (0, false);
    }
    finish(&mut path, paths);
}

fn finish(path: &mut NamePath, paths: &mut BTreeSet<NamePath>) {
    if !path.is_empty() {
        paths.insert(std::mem::take(path));
    }
}

/// Files that hold a method in an inherent `impl` block, by type and method name.
type Methods = BTreeMap<(String, String), BTreeSet<String>>;

fn inherent_methods(files: &[&Source]) -> Methods {
    let mut methods = Methods::new();
    for file in files {
        for (kind, block) in inherent_blocks(&file.syntax.items) {
            for item in &block.items {
                if let ImplItem::Fn(method) = item {
                    let key = (kind.clone(), method.sig.ident.to_string());
                    methods.entry(key).or_default().insert(file.path.clone());
                }
            }
        }
    }
    methods
}

fn inherent_blocks(items: &[Item]) -> impl Iterator<Item = (String, &syn::ItemImpl)> {
    items.iter().filter_map(|item| match item {
        Item::Impl(block) if block.trait_.is_none() => Some((implementer(block)?, block)),
        _ => None,
    })
}

fn implementer(block: &syn::ItemImpl) -> Option<String> {
    let syn::Type::Path(kind) = &*block.self_ty else { return None };
    kind.path.segments.last().map(|segment| segment.ident.to_string())
}

/// The files of the methods that an `impl` block calls on `self`. A method counts if only one file has one of that
/// name.
fn called(item: &Item, methods: &Methods) -> Vec<Use> {
    let Item::Impl(block) = item else { return Vec::new() };
    let Some(kind) = implementer(block) else { return Vec::new() };
    let mut names = BTreeSet::new();
    collect_self_calls(block.to_token_stream(), &mut names);
    let file =
        |name: &String| methods.get(&(kind.clone(), name.clone())).filter(|files| files.len() == 1)?.first();
    names.iter().filter_map(|name| Some((file(name)?.clone(), format!("self.{name}()")))).collect()
}

fn collect_self_calls(tokens: TokenStream, names: &mut BTreeSet<String>) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for window in tokens.windows(4) {
        if let [TokenTree::Ident(object), TokenTree::Punct(dot), TokenTree::Ident(name), TokenTree::Group(_)] =
            window
            && object == "self"
            && dot.as_char() == '.'
        {
            names.insert(name.to_string());
        }
    }
    for token in tokens {
        if let TokenTree::Group(group) = token {
            collect_self_calls(group.stream(), names);
        }
    }
}

/// Strongly connected components with more than one file, each sorted.
fn components(edges: &Edges) -> Vec<Vec<String>> {
    let reached: BTreeMap<&String, BTreeSet<&String>> =
        edges.keys().map(|file| (file, reach(edges, file))).collect();
    let mut found = BTreeSet::new();
    for file in edges.keys() {
        let circle: Vec<String> = reached[file]
            .iter()
            .filter(|other| reached[**other].contains(file))
            .map(|other| (*other).clone())
            .collect();
        if circle.len() > 1 {
            found.insert(circle);
        }
    }
    found.into_iter().collect()
}

/// All files that `from` uses, directly or through others.
fn reach<'a>(edges: &'a Edges, from: &String) -> BTreeSet<&'a String> {
    let mut found = BTreeSet::new();
    let mut left: Vec<&String> = edges[from].keys().collect();
    while let Some(file) = left.pop() {
        if let Some((file, used)) = edges.get_key_value(file)
            && found.insert(file)
        {
            left.extend(used.keys());
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::tree::parsed;
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<Vec<String>> {
        let files: Vec<_> =
            files.iter().map(|(name, text)| parsed(&format!("crates/a/src/{name}.rs"), text)).collect();
        circles(&files)
    }

    fn circle(names: &[&str]) -> Vec<Vec<String>> {
        vec![names.iter().map(|name| format!("crates/a/src/{name}.rs")).collect()]
    }

    #[test]
    fn two_files_that_use_each_other_are_a_circle() {
        let files = [
            ("lib", "mod b; mod c; pub use b::B; pub use c::C;"),
            ("b", "use crate::C; pub struct B(C);"),
            ("c", "pub struct C; fn f(_: crate::b::B) {}"),
        ];
        assert_eq!(found(&files), circle(&["b", "c"]));
    }

    #[test]
    fn re_exports_alone_are_no_circle() {
        let files = [
            ("lib", "mod b; pub use b::B; pub const LIMIT: u8 = 1; pub struct Other { b: u8 }"),
            ("b", "use crate::LIMIT; pub struct B([u8; LIMIT as usize]);"),
        ];
        assert!(found(&files).is_empty());
    }

    #[test]
    fn a_parent_that_uses_its_child_and_is_used_by_it_is_a_circle() {
        let files = [
            ("lib", "mod b; pub const LIMIT: u8 = 1; pub fn f() { b::g(vec![b::H]) }"),
            ("b/mod", "mod d; pub use d::*;"),
            ("b/d", "pub const H: u8 = super::super::LIMIT; pub fn g(_: Vec<u8>) {}"),
        ];
        assert_eq!(found(&files), circle(&["b/d", "lib"]));
    }

    #[test]
    fn methods_of_one_type_in_several_files_are_followed() {
        let files = [
            (
                "lib",
                "mod b; pub struct Run; impl Run { fn f(&self) { if true { self.g() } } fn h(&self) {} }",
            ),
            ("b", "impl crate::Run { pub fn g(&self) { self.h() } }"),
        ];
        assert_eq!(found(&files), circle(&["b", "lib"]));
    }

    #[test]
    fn fields_and_variables_are_no_modules() {
        let files = [
            ("lib", "mod b; pub const LIMIT: u8 = 1; fn f(s: S) { let b = s.b; b.f(); } struct S { b: u8 }"),
            ("b", "use crate::LIMIT;"),
        ];
        assert!(found(&files).is_empty());
    }
}

//! Reads and parses the source files of a tree.

use crate::walk::files;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use syn::{Attribute, Item, ItemMod};

/// One Rust file of `crates/*/src` or `xtask/src`.
pub struct Source {
    /// Path below the root of the tree, with `/` between folders.
    pub path: String,
    /// The whole text, including tests.
    pub text: String,
    /// The syntax tree without test modules. Empty for a file that holds only tests.
    pub syntax: syn::File,
}

impl Source {
    /// Folder of the crate: `crates/plan` or `xtask`.
    pub fn krate(&self) -> &str {
        self.path.split_once("/src/").map_or("", |(krate, _)| krate)
    }
}

/// All source files of the tree in the order of their paths, and one message for each file that cannot be parsed.
pub fn read(root: &Path) -> (Vec<Source>, Vec<String>) {
    let (mut sources, mut broken, mut tests) = (Vec::new(), Vec::new(), BTreeSet::new());
    for file in source_files(root) {
        let path = relative(root, &file);
        let text = std::fs::read_to_string(&file).unwrap_or_default();
        match syn::parse_file(&text) {
            Ok(mut syntax) => {
                tests.extend(test_files(&path, &syntax));
                remove_tests(&mut syntax.items);
                sources.push(Source { path, text, syntax });
            }
            Err(error) => broken.push(format!("{path}:{}: {error}", error.span().start().line)),
        }
    }
    for source in &mut sources {
        if tests.iter().any(|test| source.path.starts_with(test.as_str())) {
            source.syntax.items.clear();
        }
    }
    (sources, broken)
}

fn source_files(root: &Path) -> Vec<PathBuf> {
    let crates = root.join("crates");
    let folders = std::fs::read_dir(crates).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut found: Vec<PathBuf> =
        folders.chain([root.join("xtask")]).flat_map(|folder| files(&folder.join("src"), &["rs"])).collect();
    found.sort();
    found
}

fn relative(root: &Path, file: &Path) -> String {
    let parts = file.strip_prefix(root).unwrap_or(file).components();
    parts.map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

/// The folder that holds the child modules of a file.
pub fn children_folder(path: &str) -> &str {
    let stem = path.strip_suffix(".rs").unwrap_or(path);
    ["/mod", "/lib", "/main"].iter().find_map(|root| stem.strip_suffix(root)).unwrap_or(stem)
}

/// Path prefixes of all files that `#[cfg(test)] mod name;` declares in this file.
fn test_files(path: &str, syntax: &syn::File) -> Vec<String> {
    let modules = syntax.items.iter().filter_map(|item| match item {
        Item::Mod(module) if module.content.is_none() && is_test(&module.attrs) => Some(module),
        _ => None,
    });
    modules.flat_map(|module| places(path, module)).collect()
}

fn places(path: &str, module: &ItemMod) -> Vec<String> {
    match path_attribute(&module.attrs) {
        Some(named) => {
            let folder = path.rsplit_once('/').map_or("", |(folder, _)| folder);
            vec![format!("{folder}/{named}")]
        }
        None => {
            let stem = format!("{}/{}", children_folder(path), module.ident);
            vec![format!("{stem}.rs"), format!("{stem}/")]
        }
    }
}

/// The value of `#[path = "..."]`, if there is such an attribute.
pub fn path_attribute(attributes: &[Attribute]) -> Option<String> {
    attributes.iter().filter(|attribute| attribute.path().is_ident("path")).find_map(|attribute| {
        let syn::Meta::NameValue(pair) = &attribute.meta else { return None };
        string(&pair.value)
    })
}

/// The value of an expression that is a string literal, otherwise `None`.
pub fn string(value: &syn::Expr) -> Option<String> {
    match value {
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
        _ => None,
    }
}

/// Whether an item has the attribute `#[test]` or `#[cfg(test)]`.
pub fn is_test(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let tokens = || attribute.meta.require_list().map(|list| list.tokens.to_string());
        attribute.path().is_ident("test")
            || attribute.path().is_ident("cfg") && tokens().is_ok_and(|tokens| tokens == "test")
    })
}

fn remove_tests(items: &mut Vec<Item>) {
    items.retain(|item| match item {
        Item::Mod(module) => !is_test(&module.attrs),
        Item::Fn(function) => !is_test(&function.attrs),
        Item::Impl(block) => !is_test(&block.attrs),
        Item::Use(import) => !is_test(&import.attrs),
        _ => true,
    });
    for item in items {
        if let Item::Mod(ItemMod { content: Some((_, items)), .. }) = item {
            remove_tests(items);
        }
    }
}

#[cfg(test)]
pub fn parsed(path: &str, text: &str) -> Source {
    let mut syntax = syn::parse_file(text).expect("the test's source is Rust");
    remove_tests(&mut syntax.items);
    Source { path: path.to_owned(), text: text.to_owned(), syntax }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn test_modules_are_left_out_wherever_they_lie() {
        let source = parsed("crates/a/src/b/mod.rs", "#[cfg(test)] mod tests { fn f() {} } fn g() {}");
        assert_eq!(source.syntax.items.len(), 1);
        let syntax =
            syn::parse_file("#[cfg(test)] mod tests; #[cfg(test)] #[path = \"b/more.rs\"] mod more;");
        assert_eq!(
            test_files("crates/a/src/b.rs", &syntax.expect("Rust")),
            ["crates/a/src/b/tests.rs", "crates/a/src/b/tests/", "crates/a/src/b/more.rs"]
        );
    }
}

//! Resolves paths in the code of a crate: in which file the item of a path stands.

use super::tree::{Source, path_attribute};
use std::collections::{BTreeMap, BTreeSet};
use syn::{Ident, Item, ItemMod, UseTree};

/// Most steps of one resolution, path segments and imports. A bound is needed because imports can form a circle.
const DEPTH_MAX: usize = 12;

/// A path and the name that an import gives it. The name `*` imports all names.
type Import = (Vec<String>, String);

/// The names that the module of one file defines and imports.
pub struct Scope {
    file: String,
    /// Path of the module from the root of the crate.
    module: Vec<String>,
    /// Names of the items that the file defines.
    items: BTreeSet<String>,
    /// The path that each imported name stands for.
    imports: BTreeMap<String, Vec<String>>,
    /// Paths of modules from which all names are imported.
    globs: Vec<Vec<String>>,
}

/// All modules of a crate, by their paths from its root.
pub struct Scopes {
    by_module: BTreeMap<Vec<String>, Scope>,
    by_file: BTreeMap<String, Vec<String>>,
}

enum Target<'a> {
    Module(&'a Scope),
    Item(&'a Scope),
}

impl Scopes {
    /// Builds the modules of these files, which belong to one crate.
    pub fn of(files: &[&Source]) -> Self {
        let renamed = renamed_files(files);
        let (mut by_module, mut by_file) = (BTreeMap::new(), BTreeMap::new());
        for file in files {
            let module = renamed.get(&file.path).cloned().unwrap_or_else(|| module_path(&file.path, files));
            by_file.insert(file.path.clone(), module.clone());
            by_module.insert(module.clone(), Scope::of(file, module));
        }
        Self { by_module, by_file }
    }

    /// The module of a file.
    pub fn of_file(&self, path: &str) -> &Scope {
        &self.by_module[&self.by_file[path]]
    }

    /// The file of the item that this path leads to from the module `from`. `None` if the path leads to a module, out
    /// of the crate, or to a variable.
    pub fn item_file(&self, from: &Scope, path: &[String]) -> Option<String> {
        match self.resolve(from, path, DEPTH_MAX)? {
            Target::Item(scope) => Some(scope.file.clone()),
            Target::Module(_) => None,
        }
    }

    fn resolve<'a>(&'a self, from: &'a Scope, path: &[String], depth: usize) -> Option<Target<'a>> {
        let depth = depth.checked_sub(1)?;
        let Some((first, rest)) = path.split_first() else { return Some(Target::Module(from)) };
        let inside = |module: &[String]| self.by_module.get(module);
        match first.as_str() {
            "crate" => return self.resolve(inside(&[])?, rest, depth),
            "self" if !rest.is_empty() => return self.resolve(from, rest, depth),
            "super" => return self.resolve(inside(from.module.split_last()?.1)?, rest, depth),
            _ => {}
        }
        let mut child = from.module.clone();
        child.push(first.clone());
        if let Some(child) = inside(&child) {
            return self.resolve(child, rest, depth);
        }
        if from.items.contains(first) {
            return Some(Target::Item(from));
        }
        if let Some(target) = from.imports.get(first) {
            let through = self.resolve_import(from, first, target, depth)?;
            return match through {
                Target::Module(module) => self.resolve(module, rest, depth),
                item => Some(item),
            };
        }
        from.globs.iter().find_map(|glob| match self.resolve(from, glob, depth)? {
            Target::Module(module) if module.module != from.module => self.resolve(module, path, depth),
            _ => None,
        })
    }

    /// The target of the import called `name`, whose path is `path`. If the path begins with `name`, as in `use
    /// plan::plan`, that first segment must be a child module. Otherwise it would mean the import itself, and the
    /// target is `None`.
    fn resolve_import<'a>(
        &'a self,
        from: &'a Scope,
        name: &str,
        path: &[String],
        depth: usize,
    ) -> Option<Target<'a>> {
        let itself = path.first().is_some_and(|first| first == name);
        let is_child = || {
            let mut child = from.module.clone();
            child.push(name.to_owned());
            self.by_module.contains_key(&child)
        };
        if itself && !is_child() { None } else { self.resolve(from, path, depth) }
    }
}

impl Scope {
    fn of(file: &Source, module: Vec<String>) -> Self {
        let mut scope = Self {
            file: file.path.clone(),
            module,
            items: BTreeSet::new(),
            imports: BTreeMap::new(),
            globs: Vec::new(),
        };
        scope.add(&file.syntax.items);
        scope
    }

    fn add(&mut self, items: &[Item]) {
        for item in items {
            match item {
                Item::Use(import) => {
                    import_paths(&import.tree).into_iter().for_each(|import| self.add_import(import))
                }
                Item::Mod(ItemMod { content: Some((_, items)), ident, .. }) => {
                    self.items.insert(ident.to_string());
                    self.add(items);
                }
                other => self.items.extend(item_name(other)),
            }
        }
    }

    fn add_import(&mut self, (mut path, name): Import) {
        if name == "*" {
            path.pop();
            self.globs.push(path);
        } else if name != "_" {
            self.imports.insert(name, path);
        }
    }
}

/// Each path of a `use` tree and the name it gets. The name `*` imports all names.
pub fn import_paths(tree: &UseTree) -> Vec<Import> {
    match tree {
        UseTree::Path(path) => prefixed(&path.ident, import_paths(&path.tree)),
        UseTree::Name(name) if name.ident == "self" => vec![(Vec::new(), String::new())],
        UseTree::Name(name) => vec![(vec![name.ident.to_string()], name.ident.to_string())],
        UseTree::Rename(name) => vec![(vec![name.ident.to_string()], name.rename.to_string())],
        UseTree::Glob(_) => vec![(vec!["*".to_owned()], "*".to_owned())],
        UseTree::Group(group) => group.items.iter().flat_map(import_paths).collect(),
    }
}

fn prefixed(first: &Ident, paths: Vec<Import>) -> Vec<Import> {
    let first = first.to_string();
    let longer = paths.into_iter().map(|(mut path, mut name)| {
        if path.is_empty() {
            name.clone_from(&first);
        }
        path.insert(0, first.clone());
        (path, name)
    });
    longer.collect()
}

fn item_name(item: &Item) -> Option<String> {
    let name = match item {
        Item::Const(item) => &item.ident,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Union(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        _ => return None,
    };
    Some(name.to_string())
}

/// The module path of a file, from its place in `src`. A `main.rs` beside a `lib.rs` is a separate crate: no path leads
/// to it.
fn module_path(path: &str, files: &[&Source]) -> Vec<String> {
    let inside = path.split_once("/src/").map_or(path, |(_, inside)| inside);
    let has_lib = files.iter().any(|file| file.path.ends_with("/src/lib.rs"));
    if inside == "main.rs" && has_lib {
        return vec!["<main>".to_owned()];
    }
    let stem = inside.strip_suffix(".rs").unwrap_or(inside);
    let mut parts: Vec<String> = stem.split('/').map(str::to_owned).collect();
    if parts.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
        parts.pop();
    }
    parts
}

/// Module paths of the files that a `#[path]` attribute names, by file.
fn renamed_files(files: &[&Source]) -> BTreeMap<String, Vec<String>> {
    let mut renamed = BTreeMap::new();
    for file in files {
        for item in &file.syntax.items {
            if let Item::Mod(module) = item
                && let Some(named) = path_attribute(&module.attrs)
            {
                let folder = file.path.rsplit_once('/').map_or("", |(folder, _)| folder);
                let mut path = module_path(&file.path, files);
                path.push(module.ident.to_string());
                renamed.insert(format!("{folder}/{named}"), path);
            }
        }
    }
    renamed
}

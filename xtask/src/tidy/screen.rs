//! Checks imports between files of the browser app: between folders they point one way, and files form no circle.

use super::{shown, untested};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

/// The folders of `ui/src` that the files of each folder may import. Every folder may import itself. Files directly in
/// `ui/src` put the app together and may import every folder. Tests may import more.
const EDGES: [(&str, &[&str]); 16] = [
    ("base", &[]),
    ("api", &["base"]),
    ("model", &["base", "api"]),
    ("make", &["base", "api", "model"]),
    ("light", &["base", "api", "model", "stage"]),
    ("music", &["base", "api", "model"]),
    ("stage", &["base", "api", "model"]),
    ("session", &["base", "api", "model"]),
    ("parts", &["base", "api", "model", "stage", "session"]),
    ("shell", &["base", "api", "model", "stage", "session", "parts"]),
    ("live", &["base", "api", "model", "light", "music", "stage", "session", "parts"]),
    ("film", &["base", "api", "model", "light"]),
    ("audience", &["base", "api", "model", "stage", "session", "parts"]),
    (
        "edit",
        &["base", "api", "model", "make", "light", "film", "music", "stage", "session", "parts", "audience"],
    ),
    ("fit", &["base", "api", "model", "make", "stage", "session", "parts"]),
    ("start", &["base", "api", "model", "make", "stage", "session", "parts"]),
];

/// The files that each file imports. All paths are relative to `ui/src`.
type Imports = BTreeMap<PathBuf, BTreeSet<PathBuf>>;

/// Every import that `EDGES` does not allow, and every circle of files.
pub fn findings(root: &Path) -> Vec<String> {
    let source = root.join("ui/src");
    let sources: BTreeMap<PathBuf, String> = untested(&source, &["ts", "tsx"])
        .into_iter()
        .filter_map(|(path, text)| Some((path.strip_prefix(&source).ok()?.to_path_buf(), text)))
        .collect();
    let imports = imports_of(&sources);
    let place = shown(root, &source).to_string();
    wrong_directions(&imports)
        .into_iter()
        .chain(circles(&imports))
        .map(|finding| format!("{place}: {finding}"))
        .collect()
}

fn imports_of(sources: &BTreeMap<PathBuf, String>) -> Imports {
    sources
        .iter()
        .map(|(path, text)| {
            let imported = relative_imports(text)
                .filter_map(|import| {
                    let target = resolved(path, import);
                    ["ts", "tsx"]
                        .map(|ending| PathBuf::from(format!("{}.{ending}", target.display())))
                        .into_iter()
                        .find(|file| sources.contains_key(file))
                })
                .collect();
            (path.clone(), imported)
        })
        .collect()
}

/// The relative paths that a text imports: in single quotes after `from`, `import` or `import(`, beginning with a dot.
fn relative_imports(text: &str) -> impl Iterator<Item = &str> {
    ["from '.", "import '.", "import('."].into_iter().flat_map(move |start| {
        text.match_indices(start).filter_map(move |(at, _)| {
            let quoted = &text[at + start.len() - 1..];
            quoted.split('\'').next()
        })
    })
}

/// The path of an imported file without `.` and `..`. Its base folder is that of the path `importer`.
pub fn resolved(importer: &Path, import: &str) -> PathBuf {
    let mut path = importer.parent().unwrap_or(Path::new("")).to_path_buf();
    for component in Path::new(import).components() {
        match component {
            Component::ParentDir => {
                path.pop();
            }
            Component::Normal(name) => path.push(name),
            _ => {}
        }
    }
    path
}

/// The first folder of a path. `None` for a file directly in `ui/src`.
fn folder(path: &Path) -> Option<&str> {
    let folder = path.parent()?.iter().next()?;
    folder.to_str()
}

fn wrong_directions(imports: &Imports) -> Vec<String> {
    imports
        .iter()
        .flat_map(|(importer, imported)| imported.iter().map(move |target| (importer, target)))
        .filter(|(importer, target)| !may_import(folder(importer), folder(target)))
        .map(|(importer, target)| format!("{} must not import {}", importer.display(), target.display()))
        .collect()
}

fn may_import(importer: Option<&str>, target: Option<&str>) -> bool {
    let Some(importer) = importer else { return true };
    let allowed = EDGES.iter().find(|(name, _)| *name == importer).map_or(&[][..], |(_, allowed)| allowed);
    target.is_some_and(|target| target == importer || allowed.contains(&target))
}

/// One line for each circle of files, with the shortest chain of imports from its first file to itself.
fn circles(imports: &Imports) -> Vec<String> {
    imports
        .keys()
        .filter_map(|file| {
            let chain = way_back(imports, file)?;
            // A circle is reported once, for the first of its files in order of names.
            (chain.iter().min() == Some(file)).then(|| {
                let names: Vec<_> =
                    chain.iter().chain([file]).map(|file| file.display().to_string()).collect();
                format!("a circle of files: {}", names.join(" > "))
            })
        })
        .collect()
}

/// The shortest chain of imports from a file to itself, beginning with that file.
fn way_back(imports: &Imports, file: &PathBuf) -> Option<Vec<PathBuf>> {
    let mut reached: BTreeMap<&PathBuf, &PathBuf> = BTreeMap::new();
    let mut frontier = vec![file];
    while !frontier.is_empty() {
        let mut next = Vec::new();
        for importer in frontier {
            for target in imports.get(importer).into_iter().flatten() {
                if target == file {
                    return Some(chain_to(&reached, file, importer));
                }
                if !reached.contains_key(target) {
                    reached.insert(target, importer);
                    next.push(target);
                }
            }
        }
        frontier = next;
    }
    None
}

fn chain_to(reached: &BTreeMap<&PathBuf, &PathBuf>, start: &PathBuf, end: &PathBuf) -> Vec<PathBuf> {
    let mut chain = vec![end.clone()];
    let mut at = end;
    while at != start {
        at = reached[at];
        chain.push(at.clone());
    }
    chain.reverse();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn imports(sources: &[(&str, &str)]) -> Imports {
        imports_of(&sources.iter().map(|(path, text)| (PathBuf::from(path), (*text).to_owned())).collect())
    }

    #[test]
    fn an_import_against_the_direction_is_found() {
        let imports = imports(&[
            ("model/show.ts", "import type { Camera } from '../stage/camera';"),
            ("stage/camera.ts", "import type { Point } from '../base/geometry';"),
            ("base/geometry.ts", ""),
            ("App.tsx", "import './styles.css';\nimport { show } from './model/show';"),
        ]);
        assert_eq!(wrong_directions(&imports), ["model/show.ts must not import stage/camera.ts"]);
    }

    #[test]
    fn a_circle_is_found_once_and_a_diamond_is_none() {
        let imports = imports(&[
            ("a.ts", "import { b } from './b';\nimport { c } from './c';"),
            ("b.ts", "import {\n  d,\n} from './d';"),
            ("c.ts", "import { d } from './d';"),
            ("d.tsx", "const e = import('./e');"),
            ("e.ts", "export { d } from './d';"),
        ]);
        assert_eq!(circles(&imports), ["a circle of files: d.tsx > e.ts > d.tsx"]);
    }
}

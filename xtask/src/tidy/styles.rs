//! Checks styles of the browser app: colours are defined in one place, and components use exactly the classes beside
//! them.

use super::{shown, untested};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Files of `ui/src` that may contain colours: the design tokens, and the same colours for canvases.
const WITH_COLOURS: [&str; 2] = ["style/tokens.css", "stage/palette.ts"];

const MODULE: &str = ".module.css";

/// Every colour outside `WITH_COLOURS`, every class that is used but not defined, and every class without a use.
pub fn findings(root: &Path) -> Vec<String> {
    let source = root.join("ui/src");
    let texts = untested(&source, &["css", "ts", "tsx"]);
    let colours = texts
        .iter()
        .filter(|(path, _)| !WITH_COLOURS.iter().any(|file| path.ends_with(file)))
        .flat_map(|(path, text)| colours_in(&shown(root, path).to_string(), text));
    let modules = texts
        .iter()
        .filter(|(path, _)| path.to_string_lossy().ends_with(MODULE))
        .map(|(path, text)| (path.clone(), classes(text)))
        .collect();
    colours.chain(wrong_classes(root, &modules, &texts)).collect()
}

fn colours_in(place: &str, text: &str) -> Vec<String> {
    let is_style = place.ends_with(".css");
    text.lines()
        .enumerate()
        .filter(|(_, line)| {
            let hex = if is_style { has_hex(line, "#") } else { has_hex(line, "'#") };
            hex || (is_style && ["rgb(", "rgba(", "hsl("].iter().any(|function| line.contains(function)))
        })
        .map(|(number, line)| {
            format!("{place}:{}: a colour belongs in style/tokens.css: {}", number + 1, line.trim())
        })
        .collect()
}

/// Whether at least three hexadecimal digits follow `start` somewhere in the line.
fn has_hex(line: &str, start: &str) -> bool {
    line.match_indices(start)
        .any(|(at, _)| line[at + start.len()..].chars().take_while(char::is_ascii_hexdigit).count() >= 3)
}

/// The classes in the selectors of a style sheet, except those in `:global(...)`.
fn classes(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for selector in text.split('{').filter_map(|part| part.rsplit(['}', ';', '/']).next()) {
        let mut outside = selector.to_owned();
        while let Some(start) = outside.find(":global(") {
            let end = outside[start..].find(')').map_or(outside.len(), |length| start + length + 1);
            outside.replace_range(start..end, " ");
        }
        found.extend(outside.split('.').skip(1).map(identifier).filter(|name| !name.is_empty()));
    }
    found
}

/// The ASCII letters and digits that a text begins with.
fn identifier(text: &str) -> String {
    text.chars().take_while(char::is_ascii_alphanumeric).collect()
}

fn wrong_classes(
    root: &Path,
    modules: &BTreeMap<PathBuf, BTreeSet<String>>,
    texts: &[(PathBuf, String)],
) -> Vec<String> {
    let mut used: BTreeMap<PathBuf, BTreeSet<String>> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (path, text) in texts {
        for (name, module) in imported_modules(path, text) {
            for class in uses(text, &name) {
                if !modules.get(&module).is_some_and(|classes| classes.contains(&class)) {
                    wrong.push(format!(
                        "{}: {} has no class {class}",
                        shown(root, path),
                        shown(root, &module)
                    ));
                }
                used.entry(module.clone()).or_default().insert(class);
            }
        }
    }
    for (module, classes) in modules {
        let unused =
            classes.iter().filter(|class| !used.get(module).is_some_and(|used| used.contains(*class)));
        wrong.extend(unused.map(|class| format!("{}: no component uses {class}", shown(root, module))));
    }
    wrong
}

/// The variable and the path of each style sheet that a component imports.
fn imported_modules(path: &Path, text: &str) -> Vec<(String, PathBuf)> {
    text.lines()
        .filter_map(|line| {
            let (name, file) = line.strip_prefix("import ")?.split_once(" from '")?;
            let file = file.strip_suffix("';").filter(|file| file.ends_with(MODULE))?;
            Some((name.to_owned(), super::screen::resolved(path, file)))
        })
        .collect()
}

/// The classes that a component uses of the style sheet that it imports under this name.
fn uses(text: &str, name: &str) -> BTreeSet<String> {
    let start = format!("{name}.");
    let lines = text.lines().filter(|line| !line.starts_with("import "));
    lines
        .flat_map(|line| {
            line.match_indices(&start)
                .filter(|(at, _)| !line[..*at].ends_with(|before: char| before.is_alphanumeric()))
                .map(|(at, _)| identifier(&line[at + start.len()..]))
                .filter(|class| !class.is_empty())
                .collect::<Vec<_>>()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_found_and_ids_are_not() {
        assert_eq!(colours_in("x.css", "a { color: #fff; }\nb { color: var(--ink); }").len(), 1);
        assert_eq!(colours_in("x.tsx", "const RED = '#f00';\ngoTo('#live');").len(), 1);
    }

    #[test]
    fn classes_of_components_match_the_style_sheet_beside_them() {
        let sheet =
            "/* .old */\n.page { margin: 0.5px; }\n.page .side:global(.m-Tab) > i {}\n@media x { .bar {} }";
        assert_eq!(classes(sheet), ["bar", "page", "side"].map(str::to_owned).into());
        let modules = [(PathBuf::from("live/page.module.css"), classes(sheet))].into();
        let text =
            "import styles from './page.module.css';\n<a className={styles.page} /> styles.lost styles.bar";
        let wrong =
            wrong_classes(Path::new(""), &modules, &[(PathBuf::from("live/Page.tsx"), text.to_owned())]);
        assert_eq!(
            wrong,
            [
                "live/Page.tsx: live/page.module.css has no class lost",
                "live/page.module.css: no component uses side"
            ]
        );
    }
}

//! Checks the dependencies between crates of the workspace.

use super::{files, shown};
use std::path::Path;

/// The crates of this workspace that each crate may use. Its tests may use more.
const EDGES: [(&str, &[&str]); 23] = [
    ("base", &[]),
    ("wire", &["base"]),
    ("show", &["base"]),
    ("draw", &["base"]),
    ("light", &["base"]),
    ("music", &[]),
    ("lighting", &["base", "light", "show", "plan"]),
    ("make", &["base", "light", "show", "draw"]),
    ("plan", &["base", "show"]),
    ("exchange", &["base", "light", "lighting", "show", "plan"]),
    ("robot", &["base", "wire"]),
    ("control", &["base", "wire", "show", "plan", "lighting"]),
    ("sim", &["base", "wire", "show", "plan", "lighting", "robot", "control"]),
    ("report", &["base", "wire", "show", "control"]),
    ("exam", &["base", "wire"]),
    ("dmx", &["base", "light", "wire"]),
    ("api", &["base", "show", "plan", "exchange"]),
    ("browser", &["base", "show", "plan", "lighting", "exchange", "draw", "make", "film", "music", "api"]),
    ("film", &["base", "show", "draw", "light", "lighting"]),
    ("link", &["base", "wire"]),
    ("webots", &["base", "wire", "robot", "link"]),
    ("standin", &[]),
    (
        "server",
        &[
            "base", "wire", "show", "plan", "lighting", "robot", "control", "dmx", "sim", "exam", "exchange",
            "draw", "make", "film", "api", "link", "report",
        ],
    ),
];

/// All dependencies that `EDGES` does not allow.
pub fn findings(root: &Path) -> Vec<String> {
    let manifests = files(&root.join("crates"), &["toml"]);
    manifests
        .iter()
        .filter_map(|path| Some((path, std::fs::read_to_string(path).ok()?)))
        .flat_map(|(path, text)| {
            let place = shown(root, path).to_string();
            wrong_edges(&text).into_iter().map(move |wrong| format!("{place}: {wrong}"))
        })
        .collect()
}

fn wrong_edges(manifest: &str) -> Vec<String> {
    let mut section = "";
    let mut name = "";
    let mut wrong = Vec::new();
    for line in manifest.lines().map(str::trim) {
        if line.starts_with('[') {
            section = line;
        } else if section == "[package]" && line.starts_with("name") {
            name = line.split('"').nth(1).unwrap_or_default();
        } else if section == "[dependencies]" && line.starts_with("lightbots-") {
            let used = line.split(['.', ' ', '=']).next().unwrap_or_default();
            if !may_use(name, used) {
                wrong.push(format!("{name} must not depend on {used}"));
            }
        }
    }
    wrong
}

fn may_use(user: &str, used: &str) -> bool {
    let short = |name: &str| name.trim_start_matches("lightbots-").to_owned();
    EDGES.iter().any(|(name, allowed)| *name == short(user) && allowed.contains(&short(used).as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_edge_that_points_back_is_found() {
        let manifest =
            "[package]\nname = \"lightbots-wire\"\n[dependencies]\nlightbots-show.workspace = true\n";
        assert_eq!(wrong_edges(manifest), ["lightbots-wire must not depend on lightbots-show"]);
    }

    #[test]
    fn tests_may_use_more() {
        let manifest =
            "[package]\nname = \"lightbots-base\"\n[dev-dependencies]\nlightbots-wire.workspace = true\n";
        assert!(wrong_edges(manifest).is_empty());
    }
}

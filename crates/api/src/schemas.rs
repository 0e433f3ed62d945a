//! JSON Schemas (draft 2020-12) of files, for other programs.

use schemars::{Schema, schema_for};

use crate::Plan;
use crate::document::ShowDocument;

/// The schemas of shows and plans, with the names of their files.
pub fn schemas() -> [(&'static str, Schema); 2] {
    [("show.schema.json", schema_for!(ShowDocument)), ("plan.schema.json", schema_for!(Plan))]
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::{Path, PathBuf};

    use super::*;

    const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

    fn validator(nth: usize) -> jsonschema::Validator {
        jsonschema::validator_for(schemas()[nth].1.as_value()).unwrap()
    }

    /// Returns where and how a file violates the schema.
    fn wrong(validator: &jsonschema::Validator, text: &str) -> Vec<String> {
        let value = serde_json::from_str(text).unwrap();
        validator.iter_errors(&value).map(|error| format!("{}: {error}", error.instance_path())).collect()
    }

    fn examples() -> Vec<PathBuf> {
        let folder = fs::read_dir(Path::new(ROOT).join("shows")).unwrap();
        let files = folder.map(|entry| entry.unwrap().path());
        files.filter(|file| file.to_string_lossy().ends_with(".lightbots.json")).collect()
    }

    #[test]
    fn the_schemas_in_the_docs_are_those_of_the_types() {
        for (name, schema) in schemas() {
            let kept = fs::read_to_string(Path::new(ROOT).join("docs/schemas").join(name)).unwrap();
            // Compared as values, because the order of fields depends on the features of `serde_json` in a build.
            let kept: serde_json::Value = serde_json::from_str(&kept).unwrap();
            assert!(
                kept == *schema.as_value(),
                "{name}: `cargo run -p lightbots-api --example schemas` writes it"
            );
        }
    }

    #[test]
    fn every_example_show_is_valid_and_a_broken_one_is_not() {
        let show = validator(0);
        let files = examples();
        assert!(files.len() >= 7);
        for file in files {
            assert_eq!(wrong(&show, &fs::read_to_string(&file).unwrap()), [""; 0], "{}", file.display());
        }
        let page = fs::read_to_string(Path::new(ROOT).join("docs/show-format.md")).unwrap();
        let example = page.split("```json\n").nth(1).unwrap().split("```").next().unwrap();
        assert_eq!(wrong(&show, example), [""; 0], "the example of docs/show-format.md");
        for broken in [
            r#"{"lightbots": 3, "frames": []}"#,
            r#"{"lightbots": 1}"#,
            r##"{"lightbots": 1, "frames": [{"pixels": [{"id": 0, "place": [1], "color": "#ff0000"}]}]}"##,
            r#"{"lightbots": 1, "frames": [{"pixels": [{"id": 0, "place": [1, 2], "color": "red"}]}]}"#,
            r#"{"lightbots": 1, "frames": [], "nonsense": 1}"#,
        ] {
            assert_ne!(wrong(&show, broken), [""; 0], "{broken}");
        }
    }

    #[test]
    fn plans_are_valid() {
        let text = fs::read_to_string(Path::new(ROOT).join("shows/heart.lightbots.json")).unwrap();
        let show = lightbots_exchange::read(text.as_bytes(), None).unwrap().show;
        let plan = lightbots_plan::show(
            &show,
            &lightbots_show::starting_places(&show),
            &lightbots_plan::ShowOptions::default(),
        );
        let document = crate::plan_document(&plan, &Vec::new(), 1.0);
        assert_eq!(wrong(&validator(1), &serde_json::to_string(&document).unwrap()), [""; 0]);
        assert_ne!(wrong(&validator(1), "{}"), [""; 0]);
    }
}

//! The JSON Schema (draft 2020-12) of `lightbots report --json`.

use schemars::schema_for;

use crate::model::ShowReport;

/// The schema as a text.
pub fn schema() -> String {
    let schema = schema_for!(ShowReport);
    // A schema is plain JSON.
    serde_json::to_string_pretty(schema.as_value()).unwrap_or_default() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_schema_in_the_docs_is_that_of_the_type_and_a_report_is_valid() {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas/report.schema.json");
        // As values: the order of fields depends on what else a build asks of `serde_json`.
        let value = |text: &str| serde_json::from_str::<serde_json::Value>(text).unwrap();
        assert!(
            value(&std::fs::read_to_string(file).unwrap()) == value(&schema()),
            "`cargo run -p lightbots-report --example schema` writes it"
        );
        let validator = jsonschema::validator_for(&serde_json::from_str(&schema()).unwrap()).unwrap();
        let report = serde_json::to_value(ShowReport::default()).unwrap();
        assert!(validator.is_valid(&report));
        assert!(!validator.is_valid(&serde_json::json!({ "ok": true })));
    }
}

//! Writes the JSON Schemas of reports and of lines of runs in `docs/schemas`.

fn main() -> std::io::Result<()> {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas"));
    for (name, schema) in lightbots_report::schemas() {
        std::fs::write(folder.join(name), serde_json::to_string_pretty(schema.as_value())? + "\n")?;
    }
    Ok(())
}

//! Writes the JSON Schemas in `docs/schemas`.

fn main() -> std::io::Result<()> {
    let folder = std::path::Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas"));
    std::fs::create_dir_all(folder)?;
    for (name, schema) in lightbots_api::schemas() {
        std::fs::write(folder.join(name), serde_json::to_string_pretty(schema.as_value())? + "\n")?;
    }
    Ok(())
}

//! Writes the JSON Schema of reports in `docs/schemas`.

fn main() -> std::io::Result<()> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/schemas/report.schema.json");
    std::fs::write(file, lightbots_report::schema())
}

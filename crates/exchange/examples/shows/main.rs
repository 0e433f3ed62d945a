//! Writes the example shows into the folder `shows` of the project: `cargo run -p lightbots-exchange --example shows`.

#[path = "programme.rs"]
mod programme;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shows");
    for entry in programme::all() {
        std::fs::write(folder.join(entry.file), entry.bytes())?;
    }
    Ok(())
}

//! Draws the film strips of docs/light.md into docs/light.

mod film;

use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/light");
    std::fs::create_dir_all(&folder)?;
    for (name, strip) in film::strips() {
        strip.save(folder.join(name))?;
    }
    Ok(())
}

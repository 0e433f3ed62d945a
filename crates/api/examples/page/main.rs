//! Writes `docs/api.md`.

#[path = "generate.rs"]
mod generate;

fn main() -> std::io::Result<()> {
    std::fs::write(generate::file(), generate::page())
}

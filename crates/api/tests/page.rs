//! Checks that `docs/api.md` is current.

#[path = "../examples/page/generate.rs"]
mod generate;

#[test]
fn the_page_is_current() {
    let kept = std::fs::read_to_string(generate::file()).expect("docs/api.md is missing");
    assert!(kept == generate::page(), "run `cargo run -p lightbots-api --example page`");
}

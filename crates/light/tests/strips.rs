//! Checks that the film strips of docs/light.md show the present effects.

#[path = "../examples/strips/film.rs"]
mod film;

use std::path::Path;

#[test]
fn the_strips_in_the_docs_are_not_old() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let page = std::fs::read_to_string(docs.join("light.md")).expect("the page is there");
    for (name, strip) in film::strips() {
        let kept = image::open(docs.join("light").join(&name)).expect("the strip is there");
        let remedy = "draw it again: cargo run -p lightbots-light --example strips";
        assert!(kept.to_rgb8() == strip, "docs/light/{name} is old; {remedy}");
        assert!(page.contains(&format!("(light/{name})")), "docs/light.md does not show {name}");
    }
}

//! The fonts for texts in SVG files. Fonts installed on the machine are not used, so that a drawing looks the same
//! everywhere.

use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use usvg::fontdb::{Database, Family, Query, Source};
use usvg::{FontFamily, Group, Node};

use crate::error::Note;
use crate::text::outline_files;

/// Largest number of missing fonts that a note names.
const NAMED: usize = 3;

/// The font family that replaces all fonts that are not built in.
pub const FAMILY: &str = "Lato";

/// All built-in fonts that have outlines.
pub fn faces() -> Arc<Database> {
    static FACES: OnceLock<Arc<Database>> = OnceLock::new();
    FACES
        .get_or_init(|| {
            let mut faces = Database::new();
            for bytes in outline_files() {
                faces.load_font_source(Source::Binary(Arc::new(bytes)));
            }
            faces.set_serif_family(FAMILY);
            faces.set_sans_serif_family(FAMILY);
            faces.set_monospace_family(FAMILY);
            faces.set_cursive_family(FAMILY);
            faces.set_fantasy_family(FAMILY);
            Arc::new(faces)
        })
        .clone()
}

/// Returns a note that names at most [`NAMED`] fonts of texts that are not built in. `None` if all fonts are built in.
pub fn missing(root: &Group) -> Option<Note> {
    let mut families = BTreeSet::new();
    collect(root, &mut families);
    let known = faces();
    let is_inside = |family: &str| {
        known.query(&Query { families: &[Family::Name(family)], ..Query::default() }).is_some()
    };
    families.retain(|family| !is_inside(family));
    if families.is_empty() {
        return None;
    }
    let names: Vec<&str> = families.iter().take(NAMED).map(String::as_str).collect();
    let message = format!(
        "Texts in the font {} are drawn in Lato Bold. Convert them to paths in the program that made the file to keep their shape.",
        names.join(", ")
    );
    Some(Note::new("svg-font", message))
}

/// Collects the first font family of each piece of text, if it has a name.
fn collect(group: &Group, families: &mut BTreeSet<String>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => collect(inner, families),
            Node::Text(text) => {
                let spans = text.chunks().iter().flat_map(|chunk| chunk.spans());
                families.extend(spans.filter_map(|span| match span.font().families().first() {
                    Some(FontFamily::Named(name)) => Some(name.clone()),
                    _ => None,
                }));
            }
            Node::Path(_) | Node::Image(_) => {}
        }
    }
}

//! Counts the elements of an SVG that cannot be drawn, for notes that tell people what is missing and what to do.

use usvg::roxmltree::{Document, Node};

use crate::error::Note;

/// A kind of element that is left out.
struct Missing {
    code: &'static str,
    elements: &'static [&'static str],
    /// Words of the note for one element, and words for several elements, which follow their number.
    names: (&'static str, &'static str),
    remedy: &'static str,
}

/// All kinds of elements that are left out.
const MISSING: [Missing; 4] = [
    Missing {
        code: "svg-image",
        elements: &["image", "feImage"],
        names: ("A picture inside the SVG is", "pictures inside the SVG are"),
        remedy: "Load each picture as a file of its own.",
    },
    Missing {
        code: "svg-foreign",
        elements: &["foreignObject"],
        names: ("A foreign object, such as HTML, is", "foreign objects, such as HTML, are"),
        remedy: "Convert them to paths in the program that made the file.",
    },
    Missing {
        code: "svg-animation",
        elements: &["animate", "animateTransform", "animateMotion", "set", "script"],
        names: ("An animation or script is", "animations and scripts are"),
        remedy: "The drawing is as it is before they start.",
    },
    Missing {
        code: "svg-filter",
        elements: &["filter"],
        names: ("A filter, such as blur or shadow, is", "filters, such as blur or shadow, are"),
        remedy: "Areas and lines are drawn without filters.",
    },
];

/// Returns a note for each kind of element that is left out.
pub fn notes(document: &Document) -> Vec<Note> {
    let count = |elements: &[&str]| {
        let named = |node: &Node| node.is_element() && elements.contains(&node.tag_name().name());
        document.descendants().filter(named).count()
    };
    let missing = MISSING.iter().filter_map(|missing| {
        let (one, several) = missing.names;
        let what = counted(count(missing.elements), one, several)?;
        Some(Note::new(missing.code, format!("{what} not drawn. {}", missing.remedy)))
    });
    let outside = document.descendants().map(|node| outside(&node)).sum();
    let outside = counted(outside, "A reference to another file is", "references to other files are");
    let outside = outside.map(|what| {
        let message =
            format!("{what} not followed. Put everything that is to be drawn into the SVG file itself.");
        Note::new("svg-outside", message)
    });
    missing.chain(outside).collect()
}

/// Returns the words `one` for a count of 1, and the number with the words `several` for more. `None` for 0.
pub fn counted(count: usize, one: &str, several: &str) -> Option<String> {
    match count {
        0 => None,
        1 => Some(one.to_owned()),
        _ => Some(format!("{count} {several}")),
    }
}

/// Counts an element's references to other files.
fn outside(node: &Node) -> usize {
    let is_outside =
        |value: &str| !value.starts_with(['#']) && !value.starts_with("data:") && !value.is_empty();
    let drawn = matches!(node.tag_name().name(), "use" | "linearGradient" | "radialGradient" | "pattern");
    let links = node.attributes().filter(|attribute| drawn && attribute.name() == "href");
    let links = links.filter(|attribute| is_outside(attribute.value().trim())).count();
    let sheet = if node.tag_name().name() == "style" { node.text().unwrap_or("") } else { "" };
    links + sheet.matches("@import").count()
}

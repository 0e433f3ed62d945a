//! Checks the bytes of an SVG before any parser reads them.

use crate::error::DrawError;

/// Largest file that is read, bytes. Larger drawings have more parts than robots can show.
const BYTES_MAX: usize = 10_000_000;
/// Largest number of levels of nested elements. The library usvg would stop only at 1,024, and needs more stack for
/// each level.
pub const DEPTH_MAX: usize = 256;
/// Largest number of attributes of an element. The parser compares every pair of attributes: 10⁵ attributes took over
/// 25 s on 2026-11-23.
const ATTRIBUTES_MAX: usize = 500;

/// Returns the text of an SVG file if it may be given to a parser.
///
/// # Errors
/// A file that is too large, not UTF-8, nested too deeply, or has an element with too many attributes.
pub fn text(bytes: &[u8]) -> Result<&str, DrawError> {
    if bytes.len() > BYTES_MAX {
        return Err(too_large(format!(
            "it has {} MB, at most {} can be read",
            bytes.len() / 1_000_000,
            BYTES_MAX / 1_000_000
        )));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let message = format!(
            "The SVG file is not UTF-8 text: byte {} is wrong. Save it again as UTF-8, for example with Inkscape.",
            error.valid_up_to()
        );
        DrawError::new("svg-text", message)
    })?;
    let text = text.trim_start_matches('\u{feff}');
    tags(text).try_fold(0usize, |depth, tag| {
        if tag.attributes > ATTRIBUTES_MAX {
            return Err(too_large(format!("an element has more than {ATTRIBUTES_MAX} attributes")));
        }
        let inside = match tag.kind {
            TagKind::Opens => depth + 1,
            TagKind::Closes => depth.saturating_sub(1),
            TagKind::Empty => depth,
        };
        if inside > DEPTH_MAX { Err(too_deep()) } else { Ok(inside) }
    })?;
    Ok(text)
}

/// The error for elements that are nested too deeply.
pub fn too_deep() -> DrawError {
    let message = format!(
        "The SVG file nests elements more than {DEPTH_MAX} deep. Ungroup its parts in the program that made it."
    );
    DrawError::new("svg-too-deep", message)
}

/// The error for a file that would take too long or too much memory.
pub fn too_large(reason: String) -> DrawError {
    let message =
        format!("The SVG file is too large to draw: {reason}. Simplify it in the program that made it.");
    DrawError::new("svg-too-large", message)
}

/// How a tag changes the nesting of elements.
enum TagKind {
    Opens,
    Closes,
    Empty,
}

/// A tag.
struct Tag {
    kind: TagKind,
    /// Number of equals signs outside quotation marks: at least the number of attributes.
    attributes: usize,
}

/// Returns the tags in a text. Tags inside XML entities are included; comments and character data are skipped.
fn tags(text: &str) -> impl Iterator<Item = Tag> + '_ {
    let mut rest = text;
    std::iter::from_fn(move || {
        loop {
            rest = &rest[rest.find('<')? + 1..];
            let skipped = [("!--", "-->"), ("![CDATA[", "]]>"), ("?", "?>")]
                .into_iter()
                .find_map(|(start, end)| rest.strip_prefix(start).map(|inside| (inside, end)));
            match skipped {
                Some((inside, end)) => rest = &inside[inside.find(end)? + end.len()..],
                None if rest.starts_with('!') => {}
                None => {
                    let (tag, after) = tag(rest);
                    rest = after;
                    return Some(tag);
                }
            }
        }
    })
}

/// Reads the tag at the start of a text that begins after the tag's `<`. Also returns the text after the tag.
fn tag(text: &str) -> (Tag, &str) {
    let mut quote = None;
    let mut attributes = 0;
    let mut end = text.len();
    for (at, byte) in text.bytes().enumerate() {
        match (quote, byte) {
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'=') => attributes += 1,
            (None, b'>') => {
                end = at;
                break;
            }
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
    }
    let kind = match (text.starts_with('/'), text[..end].ends_with('/')) {
        (true, _) => TagKind::Closes,
        (false, true) => TagKind::Empty,
        (false, false) => TagKind::Opens,
    };
    (Tag { kind, attributes }, text.get(end + 1..).unwrap_or(""))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(source: &str) -> Option<&'static str> {
        text(source.as_bytes()).err().map(|error| error.code)
    }

    #[test]
    fn nesting_is_counted_without_comments_and_empty_elements() {
        let nested = |levels: usize| format!("{}{}", "<g>".repeat(levels), "</g>".repeat(levels));
        assert_eq!(code(&nested(DEPTH_MAX)), None);
        assert_eq!(code(&nested(DEPTH_MAX + 1)), Some("svg-too-deep"));
        assert_eq!(code(&"<g/><!-- <g> --><?x <g> ?><![CDATA[<g>]]>".repeat(300)), None);
        assert_eq!(
            code(&format!("<!DOCTYPE svg [<!ENTITY e \"{}\">]>", "<g>".repeat(300))),
            Some("svg-too-deep")
        );
    }

    #[test]
    fn attributes_are_counted_outside_of_quotation_marks() {
        let element = |count: usize| format!("<g {}/>", "a='=>' ".repeat(count));
        assert_eq!(code(&element(ATTRIBUTES_MAX)), None);
        assert_eq!(code(&element(ATTRIBUTES_MAX + 1)), Some("svg-too-large"));
    }

    #[test]
    fn only_utf_8_is_read() {
        let error = text(b"<svg>\xff").map_err(|error| error.message);
        assert!(error.is_err_and(|message| message.contains("byte 5")));
    }
}

//! Recognises the kind of a file by its bytes, because file names are often wrong.

use crate::error::DrawError;
use crate::list;

/// Kinds of files that become drawings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A vector drawing: areas and lines.
    Svg,
    /// A picture.
    Png,
    /// A picture.
    Jpeg,
    /// A picture or an animation.
    Webp,
    /// An animation.
    Gif,
    /// A list of places and colours.
    Csv,
}

/// Number of bytes at the start of a file in which the first element of an SVG is searched. Long comments and licences
/// may precede it.
const SVG_WITHIN: usize = 16_384;

/// Returns the kind of a file; `None` if it cannot be drawn. [`unsupported`] then says why.
pub fn sniff(bytes: &[u8]) -> Option<FileKind> {
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        Some(FileKind::Png)
    } else if bytes.starts_with(&[0xff, 0xd8, 0xff]) {
        Some(FileKind::Jpeg)
    } else if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        Some(FileKind::Webp)
    } else if bytes.starts_with(b"GIF87a") || bytes.starts_with(b"GIF89a") {
        Some(FileKind::Gif)
    } else if is_svg(bytes) {
        Some(FileKind::Svg)
    } else {
        let text = std::str::from_utf8(bytes).ok()?;
        list::looks_like(text).then_some(FileKind::Csv)
    }
}

fn is_svg(bytes: &[u8]) -> bool {
    let start = bytes.get(..SVG_WITHIN).unwrap_or(bytes);
    let start = start.strip_prefix(b"\xef\xbb\xbf").unwrap_or(start).trim_ascii_start();
    start.starts_with(b"<") && (find(start, b"<svg").is_some() || find(start, b":svg").is_some())
}

fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|window| window == wanted)
}

/// A file format that cannot be drawn. A file has it if `bytes` are at the offset `at`.
struct Foreign {
    at: usize,
    bytes: &'static [u8],
    name: &'static str,
    remedy: &'static str,
}

const fn foreign(at: usize, bytes: &'static [u8], name: &'static str, remedy: &'static str) -> Foreign {
    Foreign { at, bytes, name, remedy }
}

const AS_SVG: &str = "Save it as plain SVG.";
const AS_PICTURE: &str = "Save it as PNG or JPEG.";
const AS_VIDEO: &str = "Drop it into the browser app, or save it as GIF.";
const AS_TEXT: &str = "Choose it as the font of a word.";

/// Well-known formats that cannot be drawn. The first match counts, so a longer mark comes before a shorter one with
/// which it begins.
const FOREIGN: [Foreign; 19] = [
    foreign(0, &[0x1f, 0x8b], "a compressed file, such as svgz", AS_SVG),
    foreign(0, b"%PDF", "a PDF", AS_SVG),
    foreign(0, b"%!PS", "PostScript", AS_SVG),
    foreign(0, b"BM", "a BMP picture", AS_PICTURE),
    foreign(0, b"II*\0", "a TIFF picture", AS_PICTURE),
    foreign(0, b"MM\0*", "a TIFF picture", AS_PICTURE),
    foreign(0, b"8BPS", "a Photoshop picture", AS_PICTURE),
    foreign(0, b"\0\0\x01\0", "an icon", AS_PICTURE),
    foreign(4, b"ftypheic", "a HEIC picture", AS_PICTURE),
    foreign(4, b"ftypmif1", "a HEIF picture", AS_PICTURE),
    foreign(4, b"ftypavif", "an AVIF picture", AS_PICTURE),
    foreign(4, b"ftyp", "a video", AS_VIDEO),
    foreign(0, b"\x1a\x45\xdf\xa3", "a video", AS_VIDEO),
    foreign(8, b"AVI ", "a video", AS_VIDEO),
    foreign(
        0,
        b"PK\x03\x04",
        "an archive or office file",
        "Unpack it, or save a table as CSV and a drawing as SVG.",
    ),
    foreign(0, b"OTTO", "a font", AS_TEXT),
    foreign(0, b"\0\x01\0\0", "a font", AS_TEXT),
    foreign(0, b"wOFF", "a font", AS_TEXT),
    foreign(0, b"wOF2", "a font", AS_TEXT),
];

/// Returns the error for a file that [`sniff`] does not know: what the file is, if it can be recognised, and what to
/// do.
pub fn unsupported(bytes: &[u8]) -> DrawError {
    let known = FOREIGN
        .iter()
        .find(|format| bytes.get(format.at..).is_some_and(|rest| rest.starts_with(format.bytes)));
    let message = match known {
        Some(Foreign { name, remedy, .. }) => format!("The file is {name}, which cannot be drawn. {remedy}"),
        None if bytes.is_empty() => "The file is empty. Choose another.".to_owned(),
        None => "The file is of an unknown kind. Drawings are SVG, pictures PNG, JPEG or WebP, animations GIF or WebP, \
                 lists CSV."
            .to_owned(),
    };
    DrawError::new("unknown-kind", message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_told_from_bytes() {
        let webp = b"RIFF\0\0\0\0WEBPVP8 ";
        let long = format!("<?xml version='1.0'?><!-- {} --><svg/>", "licence ".repeat(100));
        let kinds = [
            (b"\x89PNG\r\n\x1a\n".as_slice(), Some(FileKind::Png)),
            (&[0xff, 0xd8, 0xff, 0xe0], Some(FileKind::Jpeg)),
            (webp, Some(FileKind::Webp)),
            (b"GIF89a", Some(FileKind::Gif)),
            (b"\xef\xbb\xbf\n<svg xmlns='a'/>", Some(FileKind::Svg)),
            (b"<s:svg xmlns:s='a'/>", Some(FileKind::Svg)),
            (long.as_bytes(), Some(FileKind::Svg)),
            (b"x;y;colour\n", Some(FileKind::Csv)),
            (b"1,2,red", Some(FileKind::Csv)),
            (b"Dear reader, this is no list", None),
            (b"<html/>", None),
            (b"", None),
        ];
        for (bytes, kind) in kinds {
            assert_eq!(sniff(bytes), kind, "{:?}", String::from_utf8_lossy(bytes));
            assert!((0..bytes.len()).all(|end| sniff(&bytes[..end]).is_none_or(|part| Some(part) == kind)));
        }
    }

    #[test]
    fn foreign_kinds_get_a_remedy() {
        let message = |bytes: &[u8]| unsupported(bytes).message;
        assert!(message(&[0x1f, 0x8b, 8]).ends_with("Save it as plain SVG."));
        assert!(message(b"\0\0\0\x18ftypheic").contains("HEIC"));
        assert!(message(b"\0\0\0\x18ftypmp42").contains("a video"));
        assert!(message(b"").contains("empty"));
        assert!(message(b"?").contains("unknown kind"));
    }
}

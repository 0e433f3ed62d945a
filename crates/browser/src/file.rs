//! Files that were dropped or chosen.

use lightbots_api::MakeFile;
use lightbots_draw::animation::webp_moves;
use lightbots_draw::text::Font;
use lightbots_draw::{DrawError, FileKind, sniff, unsupported};
use lightbots_show::SourceKind;

use crate::answer;

/// First bytes of fonts: OpenType, TrueType, TrueType of Apple, collections, and the two web formats.
const FONTS: [&[u8]; 6] = [b"OTTO", b"\0\x01\0\0", b"true", b"ttcf", b"wOFF", b"wOF2"];

/// What a file is, told from its bytes, and its hash, by which shows name it: pages without encryption have no function
/// of the browser for that.
pub fn file(bytes: &[u8]) -> MakeFile {
    let hash = lightbots_exchange::hash_of(bytes).to_string();
    match kind_of(bytes) {
        Ok(kind) => MakeFile { hash, kind: Some(kind.to_owned()), error: None },
        Err(error) => MakeFile { hash, kind: None, error: Some(answer::drawing(error)) },
    }
}

fn kind_of(bytes: &[u8]) -> Result<&'static str, DrawError> {
    if let Some(kind) = sniff(bytes) {
        let kind = match kind {
            FileKind::Svg => SourceKind::Svg,
            FileKind::Webp if webp_moves(bytes) => SourceKind::Animation,
            FileKind::Png | FileKind::Jpeg | FileKind::Webp => SourceKind::Picture,
            FileKind::Csv => SourceKind::List,
            FileKind::Gif => SourceKind::Animation,
        };
        return Ok(kind.name());
    }
    if FONTS.iter().any(|start| bytes.starts_with(start)) {
        return Font::read(bytes).map(|_| "font");
    }
    if lightbots_exchange::sniff(bytes).is_some() {
        return Ok("show");
    }
    Err(unsupported(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_told_from_their_bytes() {
        let kind = |bytes: &[u8]| file(bytes).kind.unwrap_or_default();
        assert_eq!(kind(b"<svg xmlns='http://www.w3.org/2000/svg'/>"), "svg");
        assert_eq!(kind(b"\x89PNG\r\n\x1a\n"), "picture");
        assert_eq!(kind(b"RIFF\0\0\0\0WEBPVP8 \0\0\0\0\0\0\0\0"), "picture");
        assert_eq!(kind(b"RIFF\0\0\0\0WEBPVP8X\x0a\0\0\0\x02\0\0\0"), "animation");
        assert_eq!(kind(b"1,2,red"), "list");
        assert_eq!(kind(b"GIF89a"), "animation");
        assert_eq!(kind(b" {\"lightbots\": 1}"), "show");
        assert_eq!(kind(b"PK\x03\x04"), "show");
        assert_eq!(file(b"").hash, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
        assert_eq!(file(b"%PDF-1.7").error.unwrap().code, "unknown-kind");
    }

    #[test]
    fn a_font_must_be_one_that_can_be_read() {
        assert_eq!(file(b"wOF2").error.unwrap().code, "font-web");
        assert!(file(b"OTTO").error.unwrap().code.starts_with("font"));
    }
}

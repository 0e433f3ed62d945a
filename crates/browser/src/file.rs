//! Identifies files that were dropped or chosen.

use lightbots_api::MakeFile;
use lightbots_draw::animation::webp_moves;
use lightbots_draw::text::Font;
use lightbots_draw::{DrawError, FileKind, sniff, unsupported};
use lightbots_show::SourceKind;

use crate::answer;

/// First bytes of fonts: OpenType, TrueType, TrueType of Apple, collections, and the two web formats.
const FONTS: [&[u8]; 6] = [b"OTTO", b"\0\x01\0\0", b"true", b"ttcf", b"wOFF", b"wOF2"];

/// Identifies a file by its bytes. Returns its kind, and the hash by which shows name the file. The hash is computed here
/// because browsers offer no hash function to pages without encryption.
pub fn file(bytes: &[u8]) -> MakeFile {
    let hash = lightbots_exchange::hash_of(bytes).to_string();
    match kind_of(bytes) {
        Ok(kind) => MakeFile { hash, kind: Some(kind.to_owned()), error: None },
        Err(error) => MakeFile { hash, kind: None, error: Some(answer::drawing(error)) },
    }
}

fn kind_of(bytes: &[u8]) -> Result<&'static str, DrawError> {
    if is_music(bytes) {
        return Ok("music");
    }
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

/// Whether a file begins like music of a known format. Only the browser's decoder can tell whether it can be played.
fn is_music(bytes: &[u8]) -> bool {
    match bytes {
        [b'I', b'D', b'3', 0..=9, ..] => true,
        // The start of a frame of MP3 or AAC.
        [0xff, second, ..] if second & 0xe0 == 0xe0 => true,
        [b'O', b'g', b'g', b'S', ..] | [b'f', b'L', b'a', b'C', ..] => true,
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'A', b'V', b'E', ..] => true,
        // MPEG-4. Still pictures share the `ftyp` mark, and the brand after it tells them apart.
        [_, _, _, _, b'f', b't', b'y', b'p', brand @ ..] => {
            [b"M4A ", b"mp42", b"mp41", b"isom", b"iso2", b"dash"]
                .iter()
                .any(|known| brand.starts_with(*known))
        }
        _ => false,
    }
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
        for music in [&b"ID3\x04\0"[..], b"\xff\xfb\x90\x64", b"OggS\0", b"fLaC\0", b"\0\0\0\x20ftypM4A \0"] {
            assert_eq!(kind(music), "music");
        }
        assert_eq!(kind(b"RIFF\0\0\0\0WAVEfmt "), "music");
        assert_eq!(file(b"\0\0\0\x20ftypavif").kind, None);
        assert_eq!(file(b"").hash, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
        assert_eq!(file(b"%PDF-1.7").error.unwrap().code, "unknown-kind");
    }

    #[test]
    fn a_font_must_be_one_that_can_be_read() {
        assert_eq!(file(b"wOF2").error.unwrap().code, "font-web");
        assert!(file(b"OTTO").error.unwrap().code.starts_with("font"));
    }
}

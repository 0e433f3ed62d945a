//! Files that frames are made from.

use lightbots_api::MakeFile;
use lightbots_draw::{DrawError, FileKind, sniff, unsupported};
use lightbots_show::SourceKind;

use crate::answer;

/// What a file is, told from its bytes, and its hash, by which shows name it: pages without encryption have no function
/// of the browser for that.
pub fn file(bytes: &[u8]) -> MakeFile {
    let hash = lightbots_exchange::hash_of(bytes).to_string();
    let kind = sniff(bytes).ok_or_else(|| unsupported(bytes)).and_then(kind_of);
    match kind {
        Ok(kind) => MakeFile { hash, kind: Some(kind.name().to_owned()), error: None },
        Err(error) => MakeFile { hash, kind: None, error: Some(answer::drawing(error)) },
    }
}

fn kind_of(kind: FileKind) -> Result<SourceKind, DrawError> {
    match kind {
        FileKind::Svg => Ok(SourceKind::Svg),
        FileKind::Png | FileKind::Jpeg | FileKind::Webp => Ok(SourceKind::Picture),
        FileKind::Csv => Ok(SourceKind::List),
        FileKind::Gif => {
            let what =
                "a GIF is a moving picture, which one frame cannot show; save one of its pictures as PNG";
            Err(DrawError::new("moving-picture", what))
        }
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
        assert_eq!(kind(b"1,2,red"), "list");
        assert_eq!(file(b"GIF89a").error.unwrap().code, "moving-picture");
        assert_eq!(file(b"").hash, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
        assert!(file(b"%PDF-1.7").error.is_some());
    }
}

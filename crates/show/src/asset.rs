//! Files that belong to a show: pictures, fonts, music.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::layer_picture::LayerPicture;

/// SHA-256 of a file's bytes. `Display` gives 64 hexadecimal digits in lower case, as in show files.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct AssetHash(pub [u8; 32]);

/// A file that belongs to a show.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Asset {
    /// Name of the file for people, such as `logo.svg`.
    pub name: String,
    /// Media type, such as `image/svg+xml`.
    pub media_type: String,
    /// Length of the file, bytes.
    pub bytes: u64,
    /// The bytes of the file. `None` if they are not at hand, for example because the show was read from a file without
    /// its assets. Serde skips this field, so it is `None` after deserialising.
    #[serde(skip)]
    pub content: Option<Arc<[u8]>>,
    /// The decoded file, if it is a picture that layers project on the floor. `None` for other files, and for a picture
    /// that was not decoded. Serde keeps this field: the light of a recorded show depends on the picture.
    #[serde(with = "crate::layer_picture::shared")]
    pub picture: Option<Arc<LayerPicture>>,
}

/// Files of a show by their hash.
pub type Assets = BTreeMap<AssetHash, Asset>;

impl AssetHash {
    /// Reads a hash from 64 hexadecimal digits in lower case. `None` for any other text.
    pub fn from_hex(text: &str) -> Option<Self> {
        let digit = |byte: u8| match byte {
            b'0'..=b'9' => Some(byte - b'0'),
            b'a'..=b'f' => Some(byte - b'a' + 10),
            _ => None,
        };
        let mut hash = [0; 32];
        if text.len() != 2 * hash.len() {
            return None;
        }
        for (byte, pair) in hash.iter_mut().zip(text.as_bytes().chunks_exact(2)) {
            *byte = digit(pair[0])? << 4 | digit(pair[1])?;
        }
        Some(Self(hash))
    }
}

impl fmt::Display for AssetHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for AssetHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hash_is_64_digits_in_lower_case() {
        let text = "00ff".repeat(16);
        assert_eq!(AssetHash::from_hex(&text).map(|hash| hash.to_string()), Some(text.clone()));
        for bad in ["", &text[1..], &text.to_uppercase(), &text.replace('f', "g"), &"é".repeat(32)] {
            assert_eq!(AssetHash::from_hex(bad), None, "{bad}");
        }
    }
}

//! Names of robots.

use core::fmt;

/// A robot's name on the wire, usually a UUID: 1 to 36 bytes of printable ASCII without space, `/`, `+`, `#` and `|`
/// (docs/protocol.md, R3). The name is a topic level and a field of reports.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RobotId {
    bytes: [u8; Self::MAX_LEN],
    len: u8,
}

impl RobotId {
    /// Longest name, bytes: the length of a UUID (docs/protocol.md, R3).
    pub const MAX_LEN: usize = 36;

    /// A name from text; `None` if the text is not a valid name.
    pub fn new(text: &str) -> Option<Self> {
        let fits = (1..=Self::MAX_LEN).contains(&text.len());
        if !fits {
            return None;
        }
        // Padded with a valid byte to the longest name. A loop over a fixed number of bytes is faster, because the
        // compiler can check several bytes at once.
        let mut bytes = [b'-'; Self::MAX_LEN];
        bytes[..text.len()].copy_from_slice(text.as_bytes());
        if !bytes.iter().fold(true, |all, &byte| all & Self::may_hold(byte)) {
            return None;
        }
        bytes[text.len()..].fill(0);
        Some(Self { bytes, len: text.len() as u8 })
    }

    /// A name in the form of a random (version 4) UUID, made of 128 random bits. Six of these bits are overwritten with
    /// the marks of the version and the variant.
    pub fn from_random(bits: u128) -> Self {
        let bits = bits & !(0xf000 << 64) & !(0xc << 60) | 0x4000 << 64 | 0x8 << 60;
        let mut bytes = [b'-'; Self::MAX_LEN];
        let mut nibble = 32;
        for (place, byte) in bytes.iter_mut().enumerate() {
            if matches!(place, 8 | 13 | 18 | 23) {
                continue;
            }
            nibble -= 1;
            *byte = b"0123456789abcdef"[(bits >> (nibble * 4) & 0xf) as usize];
        }
        Self { bytes, len: Self::MAX_LEN as u8 }
    }

    /// The name as text.
    pub fn as_str(&self) -> &str {
        core::str::from_utf8(self.as_bytes()).unwrap_or("?")
    }

    /// The bytes of the name: ASCII.
    pub fn as_bytes(&self) -> &[u8] {
        &self.bytes[..self.len as usize]
    }

    fn may_hold(byte: u8) -> bool {
        byte.is_ascii_graphic() && !matches!(byte, b'/' | b'+' | b'#' | b'|')
    }
}

impl fmt::Display for RobotId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl fmt::Debug for RobotId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for RobotId {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.as_str())
    }
}

/// Reads borrowed text only. Text that is not a valid name is an error, and so is text that the deserialiser cannot
/// lend, for example JSON with escapes.
#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for RobotId {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = <&str>::deserialize(deserializer)?;
        Self::new(text).ok_or_else(|| serde::de::Error::custom("no name of a robot"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_kept_as_it_is() {
        let uuid = "abfe6805-3c60-4e5a-ba40-2dcf7cb5d8e8";
        assert_eq!(RobotId::new(uuid).unwrap().as_str(), uuid);
    }

    #[test]
    fn what_would_break_topics_or_reports_is_no_name() {
        for text in ["", "a b", "a/b", "+", "#", "a|b", "ü", "\n", "0123456789012345678901234567890123456"] {
            assert!(RobotId::new(text).is_none(), "{text:?}");
        }
    }

    #[test]
    fn random_names_are_uuids_of_version_4() {
        assert_eq!(RobotId::from_random(0).as_str(), "00000000-0000-4000-8000-000000000000");
        assert_eq!(RobotId::from_random(u128::MAX).as_str(), "ffffffff-ffff-4fff-bfff-ffffffffffff");
    }
}

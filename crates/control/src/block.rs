//! Blocks: pieces of a file, each with its length and a checksum. Input logs and journals consist of a head and blocks.
//!
//! A block has three parts: the length of its content (4 bytes, little-endian), a CRC-32 (4 bytes, little-endian), and
//! the content. The CRC-32 covers length and content. A reader takes the first block that is cut off or was changed as
//! the end of the file.

/// Number of bytes of a block before its content: length and checksum.
const HEAD: usize = 8;

/// Appends a block with this content to `bytes`.
///
/// # Panics
/// If the content has 4 GiB or more.
pub(crate) fn append_block(bytes: &mut Vec<u8>, content: &[u8]) {
    let length = u32::try_from(content.len()).expect("a block has less than 4 GiB").to_le_bytes();
    bytes.extend_from_slice(&length);
    bytes.extend_from_slice(&checksum(length, content).to_le_bytes());
    bytes.extend_from_slice(content);
}

fn checksum(length: [u8; 4], content: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&length);
    hasher.update(content);
    hasher.finalize()
}

/// Iterator over the contents of blocks, up to the first block that is cut off or was changed.
#[derive(Clone, Debug)]
pub(crate) struct Blocks<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Blocks<'a> {
    /// Reads blocks from the offset `at` of `bytes` on.
    pub fn new(bytes: &'a [u8], at: usize) -> Self {
        Self { bytes, at }
    }

    /// Returns the offset in bytes at which the next block begins. After the last whole block: the offset at which that
    /// block ends.
    pub fn at(&self) -> usize {
        self.at
    }
}

impl<'a> Iterator for Blocks<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..)?;
        let (length, rest) = rest.split_first_chunk::<4>()?;
        let (stated, rest) = rest.split_first_chunk::<4>()?;
        let content = rest.get(..u32::from_le_bytes(*length) as usize)?;
        if checksum(*length, content) != u32::from_le_bytes(*stated) {
            return None;
        }
        self.at += HEAD + content.len();
        Some(content)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_was_cut_or_changed_ends_after_its_last_whole_block() {
        let contents: [&[u8]; 3] = [b"one", b"", b"three"];
        let mut bytes = Vec::new();
        let mut ends = vec![0];
        for content in contents {
            append_block(&mut bytes, content);
            ends.push(bytes.len());
        }
        for cut in 0..=bytes.len() {
            let mut blocks = Blocks::new(&bytes[..cut], 0);
            let whole = ends.iter().filter(|&&end| end <= cut).count() - 1;
            assert_eq!(blocks.by_ref().collect::<Vec<_>>(), contents[..whole], "cut at {cut}");
            assert_eq!(blocks.at(), ends[whole]);
        }
        for at in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[at] ^= 0x10;
            let whole = ends.iter().filter(|&&end| end <= at).count() - 1;
            assert_eq!(Blocks::new(&changed, 0).collect::<Vec<_>>(), contents[..whole], "changed at {at}");
        }
    }

    #[test]
    fn zeros_after_a_crash_are_no_block() {
        assert_eq!(Blocks::new(&[0; 64], 0).next(), None);
    }
}

//! The header of an FSEQ file: channels, blocks, ranges of channels, music.

use std::io::{Cursor, Read};

use flate2::read::ZlibDecoder;
use ruzstd::decoding::StreamingDecoder;

/// First bytes of a file.
pub(crate) const MAGIC: &[u8] = b"PSEQ";
/// Length of the header without the lists of blocks and ranges, bytes.
pub(super) const HEADER: usize = 32;
/// Length of a range of channels in the header, bytes: first channel and number of channels, three bytes each.
const RANGE: usize = 6;
/// Largest number of channels in a file: a frame, with one byte per channel, is held in memory. A larger value takes
/// more memory.
const CHANNELS_MAX: usize = 8 << 20;
/// Largest number of bytes of a file's frames when unpacked. Unpacking 1 GiB takes three seconds; with a larger value,
/// a hostile file takes longer.
const UNPACKED_MAX: u64 = 1 << 30;
/// Code in the header for no compression.
pub(super) const PLAIN: u8 = 0;
/// Code in the header for zstd.
pub(super) const ZSTD: u8 = 1;
/// Code in the header for zlib.
pub(super) const ZLIB: u8 = 2;

/// Why a file cannot be read: a text that follows the words "the file".
pub(super) type BadSequence = String;

/// The header of a file.
pub(super) struct Header {
    data_at: usize,
    variables_at: usize,
    /// Number of bytes of a frame.
    pub channels: usize,
    pub frames: usize,
    pub step_ms: u8,
    compression: u8,
    blocks: usize,
    ranges: usize,
}

/// A block of frames, compressed as in the file.
pub(super) struct FrameBlock<'a> {
    bytes: &'a [u8],
    pub frames: usize,
}

/// A range of successive channels, `count` of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ChannelRange {
    /// Index of the first channel, counted from 0.
    pub first: usize,
    pub count: usize,
}

impl Header {
    pub fn read(bytes: &[u8]) -> Result<Self, BadSequence> {
        if !bytes.starts_with(MAGIC) {
            return Err("is no FSEQ file; choose another".into());
        }
        let bytes = bytes.get(..HEADER).ok_or_else(cut_off)?;
        let short = |at: usize| usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
        let long = |at: usize| short(at) | short(at + 2) << 16;
        let (minor, major) = (bytes[6], bytes[7]);
        if major != 2 {
            return Err(format!("has FSEQ version {major}.{minor}; save it as version 2"));
        }
        let header = Self {
            data_at: short(4),
            variables_at: short(8),
            channels: long(10),
            frames: long(14),
            step_ms: bytes[18],
            compression: bytes[20] & 0x0f,
            // Version 2.1 has four more bits for the number of blocks.
            blocks: usize::from(bytes[21]) | usize::from(bytes[20] >> 4) << 8,
            ranges: usize::from(bytes[22]),
        };
        if header.step_ms == 0 {
            return Err("says that its frames last 0 ms; save it again".into());
        }
        let unpacked = header.channels as u64 * header.frames as u64;
        if header.channels > CHANNELS_MAX || unpacked > UNPACKED_MAX {
            let (channels, frames) = (header.channels, header.frames);
            return Err(format!(
                "has {frames} frames of {channels} channels, more than 1 GiB; save fewer channels"
            ));
        }
        Ok(header)
    }

    /// The ranges of channels for which the bytes of a frame stand, in the order of these bytes. A sparse file leaves
    /// channels out.
    pub fn ranges(&self, bytes: &[u8]) -> Result<Vec<ChannelRange>, BadSequence> {
        if self.ranges == 0 {
            return Ok(vec![ChannelRange { first: 0, count: self.channels }]);
        }
        let begin = HEADER + 8 * self.blocks;
        let list = bytes.get(begin..begin + RANGE * self.ranges).ok_or_else(cut_off)?;
        let three = |at: usize| {
            usize::from(list[at]) | usize::from(list[at + 1]) << 8 | usize::from(list[at + 2]) << 16
        };
        let range = |at: usize| ChannelRange { first: three(at), count: three(at + 3) };
        let ranges: Vec<ChannelRange> = (0..list.len()).step_by(RANGE).map(range).collect();
        let (count, channels) = (ranges.iter().map(|range| range.count).sum::<usize>(), self.channels);
        if count != channels {
            return Err(format!(
                "has {count} channels in its ranges and {channels} in its frames; save it again"
            ));
        }
        if ranges.iter().any(|range| range.end() > CHANNELS_MAX) {
            return Err(format!("has channels above number {CHANNELS_MAX}; save fewer channels"));
        }
        Ok(ranges)
    }

    /// The blocks of a file in order. Together they hold all frames. An uncompressed file has one block.
    pub fn blocks<'a>(&self, bytes: &'a [u8]) -> Result<Vec<FrameBlock<'a>>, BadSequence> {
        let data = bytes.get(self.data_at..).ok_or_else(cut_off)?;
        if self.compression == PLAIN {
            return Ok(vec![FrameBlock { bytes: data, frames: self.frames }]);
        }
        let list = bytes.get(HEADER..HEADER + 8 * self.blocks).ok_or_else(cut_off)?;
        let word =
            |at: usize| u32::from_le_bytes([list[at], list[at + 1], list[at + 2], list[at + 3]]) as usize;
        // Unused entries at the end have no bytes.
        let entries: Vec<(usize, usize)> = (0..self.blocks)
            .map(|nth| (word(8 * nth), word(8 * nth + 4)))
            .filter(|(_, length)| *length > 0)
            .collect();
        let begins = entries.iter().map(|(first, _)| *first).chain([self.frames]).collect::<Vec<_>>();
        let is_ordered = begins.first() == Some(&0) && begins.windows(2).all(|pair| pair[0] <= pair[1]);
        if !is_ordered {
            return Err("has blocks out of order; save it again".into());
        }
        let mut at = 0;
        let mut blocks = Vec::new();
        for (nth, (first, length)) in entries.into_iter().enumerate() {
            let bytes = data.get(at..at + length).ok_or_else(cut_off)?;
            blocks.push(FrameBlock { bytes, frames: begins[nth + 1] - first });
            at += length;
        }
        Ok(blocks)
    }

    /// File name of the music, from the variable `mf`; `None` if the header has no such variable, or an empty one.
    pub fn music(&self, bytes: &[u8]) -> Option<String> {
        let mut at = self.variables_at;
        while at + 4 <= self.data_at.min(bytes.len()) {
            let length = usize::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
            let text = bytes.get(at + 4..at + length)?;
            if &bytes[at + 2..at + 4] == b"mf" {
                let text = text.split(|byte| *byte == 0).next().unwrap_or_default();
                return Some(String::from_utf8_lossy(text).into_owned()).filter(|text| !text.is_empty());
            }
            at += length;
        }
        None
    }

    /// A reader of the bytes of a block's frames. It unpacks them while they are read.
    pub fn data<'a>(&self, block: &FrameBlock<'a>) -> Result<Box<dyn Read + 'a>, BadSequence> {
        match self.compression {
            PLAIN => Ok(Box::new(Cursor::new(block.bytes))),
            ZLIB => Ok(Box::new(ZlibDecoder::new(block.bytes))),
            ZSTD => {
                let decoder = StreamingDecoder::new(block.bytes);
                Ok(Box::new(decoder.map_err(|_| "has a damaged block; copy it again".to_owned())?))
            }
            other => Err(format!("has an unknown compression ({other}); save it uncompressed")),
        }
    }
}

impl ChannelRange {
    /// Index of the channel after the last channel of the range.
    pub fn end(self) -> usize {
        self.first + self.count
    }
}

pub(super) fn cut_off() -> BadSequence {
    "ends before its last frame; copy it again".into()
}

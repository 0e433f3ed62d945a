//! FSEQ 2: colours of lights, one frame every few milliseconds. A file has a header, lists of blocks and of ranges of
//! channels, variables, and then frames of one byte per channel. Numbers are little endian.

mod header;

use std::io::{Read, Write};

use flate2::Compression;
use flate2::write::ZlibEncoder;
use lightbots_light::PICTURE_PIXELS_MAX;
use lightbots_show::LayerPicture;

pub(crate) use header::MAGIC;
use header::{BadSequence, ChannelRange, HEADER, Header, PLAIN, ZLIB, cut_off};

/// Largest number of blocks in a written file: readers of FSEQ 2.0 read their number from one byte.
const BLOCKS_MAX: usize = 255;
/// Number of frames in a block, unless the file would have too many blocks.
const BLOCK_FRAMES: usize = 250;
/// Frames are unpacked in groups of at most this number of bytes; a longer frame is unpacked alone. Unpacking 358
/// million frames of three channels one by one took 46 s, and with this bound 0.9 s (2026-11-28).
const UNPACKED_AT_ONCE: usize = 64 << 10;

/// The contents of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SequenceFile {
    /// Time from one frame to the next, milliseconds.
    pub step_ms: u8,
    /// Number of bytes of a frame: three for each robot, its red, green and blue.
    pub channels: usize,
    /// Colour codes, frame after frame, `channels` of them for each frame.
    pub codes: Vec<u8>,
    /// File name of the music; `None`: the file names none.
    pub music: Option<String>,
}

impl SequenceFile {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.codes.len() / self.channels.max(1)
    }

    /// Writes a file with zlib blocks.
    pub fn bytes(&self) -> Vec<u8> {
        let block_frames = BLOCK_FRAMES.max(self.frames().div_ceil(BLOCKS_MAX));
        let frames = self.codes.chunks(block_frames * self.channels.max(1));
        let blocks: Vec<Vec<u8>> = frames.map(compressed).collect();
        let mut list = Vec::new();
        for (nth, block) in blocks.iter().enumerate() {
            list.extend(((nth * block_frames) as u32).to_le_bytes());
            list.extend((block.len() as u32).to_le_bytes());
        }
        let mut bytes = self.head(ZLIB, &list);
        blocks.iter().for_each(|block| bytes.extend(block));
        bytes
    }

    /// Writes a file without compression.
    pub fn plain_bytes(&self) -> Vec<u8> {
        let mut bytes = self.head(PLAIN, &[]);
        bytes.extend(&self.codes);
        bytes
    }

    /// The bytes of a file before its frames. `compression` is the code for the header. `blocks` is the list of blocks,
    /// eight bytes each.
    fn head(&self, compression: u8, blocks: &[u8]) -> Vec<u8> {
        let mut variables = variable(b"sp", "LightBots");
        if let Some(music) = &self.music {
            variables.extend(variable(b"mf", music));
        }
        let variables_at = HEADER + blocks.len();
        let data_at = (variables_at + variables.len()).next_multiple_of(4);
        let mut bytes = Vec::new();
        bytes.extend(MAGIC);
        bytes.extend((data_at as u16).to_le_bytes());
        bytes.extend([0, 2]);
        bytes.extend((variables_at as u16).to_le_bytes());
        bytes.extend((self.channels as u32).to_le_bytes());
        bytes.extend((self.frames() as u32).to_le_bytes());
        bytes.extend([self.step_ms, 0, compression, (blocks.len() / 8) as u8, 0, 0]);
        // The unique number of the file. It stays 0, because a time would make the same show give other bytes.
        bytes.extend([0; 8]);
        bytes.extend(blocks);
        bytes.extend(variables);
        bytes.resize(data_at, 0);
        bytes
    }

    /// Reads at most the first `channels` channels of a file, but at least one light; a light has three channels. If
    /// there would be more than [`PICTURE_PIXELS_MAX`] colours, keeps every n-th frame only, and makes `step_ms` n
    /// times as long. Channels that a sparse file leaves out are 0.
    pub fn read(bytes: &[u8], channels: usize) -> Result<Self, BadSequence> {
        let header = Header::read(bytes)?;
        let ranges = header.ranges(bytes)?;
        let width = ranges.iter().map(|range| range.end()).max().unwrap_or(0);
        let kept = width.min(channels.max(3)) / 3 * 3;
        if kept == 0 || header.frames == 0 || header.channels == 0 {
            return Err("has no lights; choose another".into());
        }
        if !ranges.iter().any(|range| range.first < kept && range.count > 0) {
            return Err(format!(
                "has no channel below number {kept}, and lights begin at 0; save those of the robots"
            ));
        }
        let every = (header.frames * kept).div_ceil(3 * PICTURE_PIXELS_MAX).max(1);
        let step_ms = u8::try_from(usize::from(header.step_ms) * every)
            .map_err(|_| "is too long for its lights; cut it into several".to_owned())?;
        let codes = kept_codes(&header, bytes, &ranges, (kept, every))?;
        Ok(Self { step_ms, channels: kept, codes, music: header.music(bytes) })
    }
}

/// The codes of the first `kept` channels of the frames 0, `every`, 2 · `every` and so on.
fn kept_codes(
    header: &Header,
    bytes: &[u8],
    ranges: &[ChannelRange],
    (kept, every): (usize, usize),
) -> Result<Vec<u8>, BadSequence> {
    let at_once = (UNPACKED_AT_ONCE / header.channels).max(1);
    let mut rows = vec![0; at_once * header.channels];
    let mut codes = Vec::new();
    let mut number = 0_usize;
    for block in header.blocks(bytes)? {
        let mut data = header.data(&block)?;
        let mut left = block.frames;
        while left > 0 {
            let count = left.min(at_once);
            let rows = &mut rows[..count * header.channels];
            data.read_exact(rows).map_err(|_| cut_off())?;
            let first = number.next_multiple_of(every) - number;
            for row in rows.chunks_exact(header.channels).skip(first).step_by(every) {
                add_row(&mut codes, row, ranges, kept);
            }
            number += count;
            left -= count;
        }
    }
    Ok(codes)
}

/// Adds the codes of the channels below `kept` of a frame to `codes`. `row` has the bytes of the frame, and `ranges` the
/// channels for which they stand. Channels outside all ranges are 0.
fn add_row(codes: &mut Vec<u8>, row: &[u8], ranges: &[ChannelRange], kept: usize) {
    let begin = codes.len();
    codes.resize(begin + kept, 0);
    let mut at = 0;
    for range in ranges {
        let count = range.end().min(kept).saturating_sub(range.first);
        if count > 0 {
            let to = begin + range.first;
            codes[to..to + count].copy_from_slice(&row[at..at + count]);
        }
        at += range.count;
    }
}

/// Reads the colours in the file of a layer of the kind `sequence`: one pixel per robot, one row per frame.
///
/// # Errors
/// If the file cannot be read: what is wrong with it, and what to do.
pub fn sequence_picture(bytes: &[u8]) -> Result<LayerPicture, String> {
    let file = SequenceFile::read(bytes, usize::MAX).map_err(|why| format!("the file {why}"))?;
    // `read` bounds both.
    Ok(LayerPicture { width: file.channels as u32 / 3, height: file.frames() as u32, codes: file.codes })
}

fn compressed(frames: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    // Writing to a list of bytes cannot fail.
    let _ = encoder.write_all(frames);
    encoder.finish().unwrap_or_default()
}

/// Writes a variable: its length in bytes, two letters, and a text with a zero byte at its end. The text is cut after
/// 200 characters.
fn variable(name: &[u8; 2], text: &str) -> Vec<u8> {
    let text: String = text.chars().take(200).filter(|char| *char != '\0').collect();
    let length = (4 + text.len() + 1) as u16;
    [&length.to_le_bytes()[..], name, text.as_bytes(), &[0]].concat()
}

#[cfg(test)]
mod tests {
    use super::header::ZSTD;
    use super::*;

    fn file(frames: usize) -> SequenceFile {
        let codes = (0..frames * 6).map(|at| (at % 251) as u8).collect();
        SequenceFile { step_ms: 25, channels: 6, codes, music: Some("march.ogg".into()) }
    }

    #[test]
    fn frames_and_music_come_back() {
        for frames in [1, 250, 251, 100_000] {
            let file = file(frames);
            assert_eq!(SequenceFile::read(&file.bytes(), usize::MAX).unwrap(), file);
        }
        let one = SequenceFile::read(&file(3).bytes(), 4).unwrap();
        assert_eq!((one.channels, one.codes), (3, vec![0, 1, 2, 6, 7, 8, 12, 13, 14]));
    }

    #[test]
    fn an_uncompressed_file_is_read() {
        for frames in [1, 2, 20_000] {
            let file = file(frames);
            let bytes = file.plain_bytes();
            assert!(bytes.ends_with(&file.codes) && bytes[20..23] == [PLAIN, 0, 0]);
            assert_eq!(SequenceFile::read(&bytes, usize::MAX).unwrap(), file);
        }
    }

    /// A file of two frames of six channels, whose numbers are given by `ranges`.
    fn sparse(compression: u8, ranges: &[(u32, u32)]) -> Vec<u8> {
        let codes = file(2).codes;
        let block = match compression {
            ZLIB => compressed(&codes),
            ZSTD => {
                let level = ruzstd::encoding::CompressionLevel::Fastest;
                ruzstd::encoding::compress_to_vec(&codes[..], level)
            }
            _ => codes,
        };
        let mut list = Vec::new();
        if compression != PLAIN {
            list.extend([0; 4]);
            list.extend((block.len() as u32).to_le_bytes());
        }
        let mut bytes = file(2).head(compression, &list);
        let three = |number: u32| number.to_le_bytes().into_iter().take(3);
        let ranges_at = HEADER + list.len();
        let both: Vec<u8> =
            ranges.iter().flat_map(|(first, count)| three(*first).chain(three(*count))).collect();
        bytes[22] = ranges.len() as u8;
        for at in [4, 8] {
            // The frames and the variables move back.
            bytes[at] += both.len() as u8;
        }
        bytes.splice(ranges_at..ranges_at, both);
        bytes.extend(block);
        bytes
    }

    #[test]
    fn channels_that_a_sparse_file_leaves_out_are_black() {
        for compression in [PLAIN, ZLIB, ZSTD] {
            let bytes = sparse(compression, &[(9, 2), (3, 4)]);
            let read = SequenceFile::read(&bytes, usize::MAX).unwrap();
            assert_eq!((read.channels, read.music.as_deref()), (9, Some("march.ogg")), "{compression}");
            assert_eq!(read.codes, [0, 0, 0, 2, 3, 4, 5, 0, 0, 0, 0, 0, 8, 9, 10, 11, 0, 0]);
            let two = SequenceFile::read(&bytes, 6).unwrap();
            assert_eq!(two.codes, [0, 0, 0, 2, 3, 4, 0, 0, 0, 8, 9, 10]);
            assert!(SequenceFile::read(&bytes, 3).unwrap_err().contains("no channel below number 3"));
        }
        for (ranges, part) in [
            (&[(0, 5)][..], "5 channels in its ranges and 6 in its frames"),
            (&[(0xff_ffff, 6)], "channels above number"),
            (&[(0, 0xff_ffff), (0, 7)], "channels in its ranges"),
        ] {
            let error = SequenceFile::read(&sparse(ZLIB, ranges), usize::MAX).unwrap_err();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn a_file_with_blocks_of_zstd_is_read() {
        let (mut bytes, codes) = (file(2).bytes(), file(2).codes);
        let block =
            ruzstd::encoding::compress_to_vec(&codes[..], ruzstd::encoding::CompressionLevel::Fastest);
        bytes[20] = ZSTD;
        bytes[36..40].copy_from_slice(&(block.len() as u32).to_le_bytes());
        bytes.truncate(usize::from(bytes[4]));
        bytes.extend(&block);
        assert_eq!(SequenceFile::read(&bytes, usize::MAX).unwrap().codes, codes);
        for at in 40..bytes.len() {
            for flip in 1..=255 {
                let mut changed = bytes.clone();
                changed[at] ^= flip;
                // Success and failure are both right, but reading must end.
                let _ = SequenceFile::read(&changed, usize::MAX);
            }
        }
    }

    #[test]
    fn every_prefix_is_refused_and_hostile_headers_are() {
        let whole = file(40).bytes();
        for end in 0..whole.len() {
            assert!(SequenceFile::read(&whole[..end], usize::MAX).is_err(), "{end}");
        }
        let with = |at: usize, value: u8| {
            let mut bytes = whole.clone();
            bytes[at] = value;
            SequenceFile::read(&bytes, usize::MAX).unwrap_err()
        };
        for (at, value, part) in [
            (7, 1, "version 1.0"),
            (13, 255, "more than 1 GiB"),
            (17, 255, "more than 1 GiB"),
            (18, 0, "0 ms"),
            (20, ZSTD, "damaged block"),
            (20, 9, "unknown compression"),
            (22, 1, "in its ranges"),
            (32, 1, "out of order"),
        ] {
            let error = with(at, value);
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn long_files_are_thinned() {
        let long = SequenceFile { step_ms: 20, channels: 3, codes: vec![7; 3 * 5_000_000], music: None };
        let read = SequenceFile::read(&long.bytes(), usize::MAX).unwrap();
        assert_eq!((read.step_ms, read.frames()), (40, 2_500_000));
    }
}

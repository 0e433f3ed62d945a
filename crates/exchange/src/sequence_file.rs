//! FSEQ 2: colours of lights, one frame each few milliseconds. Header, list of blocks, variables, then frames of one byte a
//! channel, little endian.

use std::io::{Cursor, Read, Write};

use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use lightbots_light::PICTURE_PIXELS_MAX;
use lightbots_show::LayerPicture;
use ruzstd::decoding::StreamingDecoder;

/// First bytes of a file.
pub(crate) const MAGIC: &[u8] = b"PSEQ";
/// Length of the header without the list of blocks, bytes.
const HEADER: usize = 32;
/// Most blocks that readers of version 2.0 count: one byte.
const BLOCKS_MAX: usize = 255;
/// Frames of a block, unless the file would have too many blocks.
const BLOCK_FRAMES: usize = 250;
/// Most channels of a file: a frame is held in memory.
const CHANNELS_MAX: usize = 8 << 20;
/// Most bytes that a file unpacks to: 1 GiB takes three seconds.
const UNPACKED_MAX: u64 = 1 << 30;
/// Kinds of compression in the header: none, zstd, zlib.
const PLAIN: u8 = 0;
/// See [`PLAIN`].
const ZSTD: u8 = 1;
/// See [`PLAIN`].
const ZLIB: u8 = 2;

/// What a file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct SequenceFile {
    /// Distance of two frames, milliseconds.
    pub step_ms: u8,
    /// Bytes of a frame: red, green and blue of each robot.
    pub channels: usize,
    /// Frames one after another.
    pub codes: Vec<u8>,
    /// File name of the music.
    pub music: Option<String>,
}

/// Words after "the file".
type Refusal = String;

impl SequenceFile {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.codes.len() / self.channels.max(1)
    }

    /// The bytes of a file, in zlib blocks.
    pub fn bytes(&self) -> Vec<u8> {
        let block_frames = BLOCK_FRAMES.max(self.frames().div_ceil(BLOCKS_MAX));
        let blocks: Vec<Vec<u8>> =
            self.codes.chunks(block_frames * self.channels.max(1)).map(compressed).collect();
        let mut variables = variable(b"sp", "LightBots");
        if let Some(music) = &self.music {
            variables.extend(variable(b"mf", music));
        }
        let variables_at = HEADER + 8 * blocks.len();
        let data_at = (variables_at + variables.len()).next_multiple_of(4);
        let mut bytes = Vec::new();
        bytes.extend(MAGIC);
        bytes.extend((data_at as u16).to_le_bytes());
        bytes.extend([0, 2]);
        bytes.extend((variables_at as u16).to_le_bytes());
        bytes.extend((self.channels as u32).to_le_bytes());
        bytes.extend((self.frames() as u32).to_le_bytes());
        bytes.extend([self.step_ms, 0, ZLIB, blocks.len() as u8, 0, 0]);
        // A number of its own for the file; a moment would make the same show give other bytes.
        bytes.extend([0; 8]);
        for (nth, block) in blocks.iter().enumerate() {
            bytes.extend(((nth * block_frames) as u32).to_le_bytes());
            bytes.extend((block.len() as u32).to_le_bytes());
        }
        bytes.extend(variables);
        bytes.resize(data_at, 0);
        blocks.iter().for_each(|block| bytes.extend(block));
        bytes
    }

    /// Reads a file; of each frame, the first `channels` bytes at most, and of many frames each n-th, so that the
    /// lights have at most [`PICTURE_PIXELS_MAX`] colours.
    pub fn read(bytes: &[u8], channels: usize) -> Result<Self, Refusal> {
        let header = Header::read(bytes)?;
        let kept = header.channels.min(channels.max(3)) / 3 * 3;
        if kept == 0 || header.frames == 0 {
            return Err("has no lights; choose another".into());
        }
        let every = (header.frames * kept).div_ceil(3 * PICTURE_PIXELS_MAX).max(1);
        let step_ms = u8::try_from(usize::from(header.step_ms) * every)
            .map_err(|_| "is too long for its lights; cut it into several".to_owned())?;
        let mut codes = Vec::new();
        let mut row = vec![0; header.channels];
        let mut number = 0;
        for block in header.blocks(bytes)? {
            let mut data = block.data(header.compression)?;
            for _ in 0..block.frames {
                data.read_exact(&mut row).map_err(|_| cut_off())?;
                if number % every == 0 {
                    codes.extend(&row[..kept]);
                }
                number += 1;
            }
        }
        Ok(Self { step_ms, channels: kept, codes, music: music(bytes, &header) })
    }
}

/// The colours in the file of a layer of the kind `sequence`: one pixel a robot, one row a frame.
///
/// # Errors
/// What is wrong with the file, and what to do.
pub fn sequence_picture(bytes: &[u8]) -> Result<LayerPicture, String> {
    let file = SequenceFile::read(bytes, usize::MAX).map_err(|why| format!("the file {why}"))?;
    // `read` bounds both.
    Ok(LayerPicture { width: file.channels as u32 / 3, height: file.frames() as u32, codes: file.codes })
}

fn compressed(frames: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    // A list of bytes takes all that is written.
    let _ = encoder.write_all(frames);
    encoder.finish().unwrap_or_default()
}

/// A variable: its length, two letters, and a text with a zero behind.
fn variable(name: &[u8; 2], text: &str) -> Vec<u8> {
    let text: String = text.chars().take(200).filter(|char| *char != '\0').collect();
    let length = (4 + text.len() + 1) as u16;
    [&length.to_le_bytes()[..], name, text.as_bytes(), &[0]].concat()
}

fn cut_off() -> Refusal {
    "ends before its last frame; copy it again".into()
}

struct Header {
    data_at: usize,
    variables_at: usize,
    channels: usize,
    frames: usize,
    step_ms: u8,
    compression: u8,
    blocks: usize,
}

/// Some frames of a file.
struct Block<'a> {
    bytes: &'a [u8],
    frames: usize,
}

impl Header {
    fn read(bytes: &[u8]) -> Result<Self, Refusal> {
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
        };
        if bytes[22] != 0 {
            return Err("holds only some of its channels (a sparse file); save it whole".into());
        }
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

    /// The blocks, together with all frames.
    fn blocks<'a>(&self, bytes: &'a [u8]) -> Result<Vec<Block<'a>>, Refusal> {
        let data = bytes.get(self.data_at..).ok_or_else(cut_off)?;
        if self.compression == PLAIN {
            return Ok(vec![Block { bytes: data, frames: self.frames }]);
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
            blocks.push(Block { bytes, frames: begins[nth + 1] - first });
            at += length;
        }
        Ok(blocks)
    }
}

impl<'a> Block<'a> {
    fn data(&self, compression: u8) -> Result<Box<dyn Read + 'a>, Refusal> {
        match compression {
            PLAIN => Ok(Box::new(Cursor::new(self.bytes))),
            ZLIB => Ok(Box::new(ZlibDecoder::new(self.bytes))),
            ZSTD => {
                let decoder = StreamingDecoder::new(self.bytes);
                Ok(Box::new(decoder.map_err(|_| "has a damaged block; copy it again".to_owned())?))
            }
            other => Err(format!("has an unknown compression ({other}); save it uncompressed")),
        }
    }
}

/// The name of the music among the variables.
fn music(bytes: &[u8], header: &Header) -> Option<String> {
    let mut at = header.variables_at;
    while at + 4 <= header.data_at.min(bytes.len()) {
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

#[cfg(test)]
mod tests {
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
        let mut bytes = file(2).bytes();
        let (data_at, codes) = (usize::from(bytes[4]), file(2).codes);
        (bytes[20], bytes[21]) = (PLAIN, 0);
        bytes.truncate(data_at);
        bytes.extend(&codes);
        assert_eq!(SequenceFile::read(&bytes, usize::MAX).unwrap().codes, codes);
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
                // Either is no fault, but it must end.
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
            (22, 1, "sparse"),
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

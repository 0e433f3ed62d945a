//! FSEQ files for tests, as other programs write them: compressed, and sparse.
#![allow(dead_code)] // Each test uses a part of it.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use ruzstd::encoding::{CompressionLevel, compress_to_vec};

/// Code in the header for no compression.
pub const PLAIN: u8 = 0;
/// Code in the header for zstd.
pub const ZSTD: u8 = 1;
/// Code in the header for zlib.
pub const ZLIB: u8 = 2;

/// Offset of the first frame in a file, bytes.
pub fn data_at(file: &[u8]) -> usize {
    usize::from(u16::from_le_bytes([file[4], file[5]]))
}

/// Makes a compressed or sparse file from a plain file. Each frame keeps its first bytes, and `ranges` (first channel,
/// number of channels) says for which channels they stand. Without ranges, all bytes are kept.
pub fn packed(plain: &[u8], compression: u8, ranges: &[(u32, u32)]) -> Vec<u8> {
    let begin = data_at(plain);
    let channels = u32::from_le_bytes(plain[10..14].try_into().unwrap());
    let kept = if ranges.is_empty() { channels } else { ranges.iter().map(|range| range.1).sum() };
    let rows = plain[begin..].chunks_exact(channels as usize);
    let frames: Vec<u8> = rows.flat_map(|row| row[..kept as usize].to_vec()).collect();
    let block = match compression {
        ZLIB => {
            let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
            encoder.write_all(&frames).unwrap();
            encoder.finish().unwrap()
        }
        ZSTD => compress_to_vec(&frames[..], CompressionLevel::Fastest),
        _ => frames,
    };
    let mut lists = Vec::new();
    if compression != PLAIN {
        lists.extend([0; 4]);
        lists.extend((block.len() as u32).to_le_bytes());
    }
    for (first, count) in ranges {
        lists.extend([&first.to_le_bytes()[..3], &count.to_le_bytes()[..3]].concat());
    }
    let mut bytes = [&plain[..32], &lists, &plain[32..begin], &block].concat();
    for at in [4, 8] {
        let place = u16::from_le_bytes([bytes[at], bytes[at + 1]]) + lists.len() as u16;
        bytes[at..at + 2].copy_from_slice(&place.to_le_bytes());
    }
    bytes[10..14].copy_from_slice(&kept.to_le_bytes());
    bytes[20] = compression;
    bytes[21] = u8::from(compression != PLAIN);
    bytes[22] = ranges.len() as u8;
    bytes
}

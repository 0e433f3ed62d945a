//! Seeded mutations of files and messages, for tests of everything that reads untrusted input.
#![allow(dead_code)] // Each test uses a part of it.

use std::path::{Path, PathBuf};

use super::numbers::Numbers;

/// Number of mutations of each file or message: LIGHTBOTS_MUTATIONS if it is set, otherwise `usual`.
pub fn rounds(usual: usize) -> usize {
    std::env::var("LIGHTBOTS_MUTATIONS").ok().and_then(|text| text.parse().ok()).unwrap_or(usual)
}

/// A copy of good bytes, changed in 1 to `most` places.
pub fn mutant(good: &[u8], most: usize, numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = good.to_vec();
    for _ in 0..=numbers.below(most) {
        mutate(&mut bytes, numbers);
    }
    bytes
}

/// Writes bytes that broke a reader into a corpus. Returns the path of the file.
pub fn keep_broken(corpus: &Path, bytes: &[u8]) -> PathBuf {
    let file = corpus.join(format!("broke-{:016x}", fnv1a(bytes)));
    std::fs::write(&file, bytes).unwrap();
    file
}

fn fnv1a(bytes: &[u8]) -> u64 {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, step)
}

/// The files of a corpus in the order of their names.
pub fn corpus_files(corpus: &Path) -> Vec<Vec<u8>> {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(corpus).unwrap().flatten().map(|file| file.path()).collect();
    files.sort();
    files.into_iter().map(|file| std::fs::read(file).unwrap()).collect()
}

/// Changes the bytes in one place, or leaves them if it finds no digit to change. `bytes` must not be empty, and is not
/// empty afterwards.
pub fn mutate(bytes: &mut Vec<u8>, numbers: &mut Numbers) {
    const WORDS: [&[u8]; 14] = [
        b"NaN",
        b"-Infinity",
        b"1e999",
        b"-1",
        b"4294967296",
        b"null",
        b"[[[[",
        b"{",
        b"\"",
        b"\\u",
        b"\xff",
        b"99999999",
        b",",
        b"1e-320",
    ];
    let at = numbers.below(bytes.len());
    match numbers.below(6) {
        0 => bytes[at] = numbers.below(256) as u8,
        1 => drop(bytes.remove(at)),
        2 => bytes.truncate(at.max(1)),
        3 => drop(bytes.splice(at..at, WORDS[numbers.below(WORDS.len())].iter().copied())),
        4 => {
            let end = (at + numbers.below(40)).min(bytes.len());
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        _ => {
            // A changed number is the mutation that most often survives reading.
            let Some(number) = bytes[at..].iter().position(u8::is_ascii_digit) else { return };
            let word = WORDS[numbers.below(5)];
            bytes.splice(at + number..=at + number, word.iter().copied());
        }
    }
    if bytes.is_empty() {
        bytes.push(b' ');
    }
}

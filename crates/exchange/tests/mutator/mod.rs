//! Seeded mutations of files and messages, for tests of everything that reads what others send.

use super::numbers::Numbers;

/// Changes the bytes in one place; they are never empty afterwards.
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
            // The likeliest to survive reading: another number in the place of one.
            let Some(number) = bytes[at..].iter().position(u8::is_ascii_digit) else { return };
            let word = WORDS[numbers.below(5)];
            bytes.splice(at + number..=at + number, word.iter().copied());
        }
    }
    if bytes.is_empty() {
        bytes.push(b' ');
    }
}

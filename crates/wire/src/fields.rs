//! Splits texts into fields, eight bytes at a time, because a controller reads many short messages.

/// A word of eight bytes in which the lowest bit of each byte is set. Multiplied by a byte, it repeats this byte eight
/// times.
const LOW_BITS: u64 = 0x0101_0101_0101_0101;
/// A word of eight bytes in which the highest bit of each byte is set.
const HIGH_BITS: u64 = 0x8080_8080_8080_8080;

/// Iterator over the fields between ASCII whitespace, equal to `str::split_ascii_whitespace`.
#[derive(Clone, Debug)]
pub(crate) struct Fields<'a> {
    rest: &'a str,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        Self { rest: text }
    }
}

impl<'a> Iterator for Fields<'a> {
    type Item = &'a str;

    #[inline]
    fn next(&mut self) -> Option<&'a str> {
        loop {
            let end = first(self.rest.as_bytes(), below_exclamation, |byte| byte.is_ascii_whitespace());
            let field = &self.rest[..end];
            self.rest = self.rest.get(end + 1..).unwrap_or("");
            if !field.is_empty() {
                return Some(field);
            }
            if self.rest.is_empty() {
                return None;
            }
        }
    }
}

/// Returns the texts before and after the first `stop`, an ASCII character. If the text has no `stop`, returns the
/// whole text and `None`.
#[inline]
pub(crate) fn cut(text: &str, stop: u8) -> (&str, Option<&str>) {
    let pattern = LOW_BITS * u64::from(stop);
    let end = first(text.as_bytes(), |word| zeros(word ^ pattern), |byte| byte == stop);
    (&text[..end], text.get(end + 1..))
}

/// Returns the index of the first byte for which `sought` holds, or the number of bytes if there is none. `marks` gets
/// eight bytes as a word, and sets the highest bit of each byte for which `sought` may hold. Only the lowest bit that
/// it sets has to be right; the search goes on behind that byte.
#[inline]
fn first(bytes: &[u8], marks: impl Fn(u64) -> u64, sought: impl Fn(u8) -> bool) -> usize {
    let mut at = 0;
    while let Some(word) = bytes[at..].first_chunk() {
        let marks = marks(u64::from_le_bytes(*word));
        if marks == 0 {
            at += 8;
            continue;
        }
        at += marks.trailing_zeros() as usize / 8;
        if sought(bytes[at]) {
            return at;
        }
        at += 1;
    }
    at + bytes[at..].iter().position(|&byte| sought(byte)).unwrap_or(bytes.len() - at)
}

/// Marks bytes below `!`: whitespace and control characters. Of the marked bytes, only the first one surely is such a
/// byte.
fn below_exclamation(word: u64) -> u64 {
    word.wrapping_sub(LOW_BITS * 0x21) & !word & HIGH_BITS
}

/// Marks bytes that are zero. Of the marked bytes, only the first one surely is zero.
fn zeros(word: u64) -> u64 {
    word.wrapping_sub(LOW_BITS) & !word & HIGH_BITS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_those_of_the_standard_library() {
        // Every class of byte, in all orders across the boundary of two words.
        let parts = ["a", " ", "\t", "\u{b}", "ü", "=\u{1}", "bcdefgh"];
        for number in 0..7u32.pow(6) {
            let mut text = heapless::String::<64>::new();
            for place in 0..6 {
                text.push_str(parts[(number / 7u32.pow(place)) as usize % 7]).unwrap();
            }
            assert!(Fields::new(&text).eq(text.split_ascii_whitespace()), "{text:?}");
            let (before, after) = cut(&text, b'=');
            match text.split_once('=') {
                Some(both) => assert_eq!((before, after), (both.0, Some(both.1)), "{text:?}"),
                None => assert_eq!((before, after), (text.as_str(), None), "{text:?}"),
            }
        }
    }

    #[test]
    fn there_are_no_fields_in_nothing() {
        assert_eq!(Fields::new("").next(), None);
        assert_eq!(Fields::new("  \r\n ").next(), None);
        assert_eq!(cut("", b'|'), ("", None));
        assert_eq!(cut("|", b'|'), ("", Some("")));
    }
}

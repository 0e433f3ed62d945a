//! A buffer in front of a slow text sink.

use core::fmt::{self, Write};

/// Size of the buffer, bytes; most messages fit as a whole. With a smaller buffer the sink is called more often, and a
/// larger one needs more stack. The longest report of a robot (343 bytes) is written in several parts.
const BUFFER_BYTES: usize = 320;

/// Collects the many short parts of a message and writes them together, because each call of the sink is a dynamic one.
pub(crate) struct TextBuffer<'a> {
    out: &'a mut dyn Write,
    /// Buffered text, in whole UTF-8 characters; only the first `len` bytes count.
    text: [u8; BUFFER_BYTES],
    len: usize,
}

impl<'a> TextBuffer<'a> {
    /// An empty buffer in front of `out`.
    pub(crate) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, text: [0; BUFFER_BYTES], len: 0 }
    }

    /// Writes what is still buffered to the sink.
    pub(crate) fn finish(mut self) -> fmt::Result {
        self.flush()
    }

    /// Writes whole characters of UTF-8.
    #[inline(always)] // Most parts are literals, which the compiler then copies without a call.
    pub(crate) fn bytes(&mut self, bytes: &[u8]) -> fmt::Result {
        if let Some(room) = self.text.get_mut(self.len..self.len + bytes.len()) {
            room.copy_from_slice(bytes);
            self.len += bytes.len();
            return Ok(());
        }
        self.bypass(bytes)
    }

    #[cold]
    fn bypass(&mut self, bytes: &[u8]) -> fmt::Result {
        self.flush()?;
        self.out.write_str(core::str::from_utf8(bytes).map_err(|_| fmt::Error)?)
    }

    fn flush(&mut self) -> fmt::Result {
        let text = core::str::from_utf8(&self.text[..self.len]).map_err(|_| fmt::Error)?;
        self.len = 0;
        self.out.write_str(text)
    }
}

impl Write for TextBuffer<'_> {
    #[inline(always)] // As `TextBuffer::bytes`.
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.bytes(text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_longer_than_the_room_comes_whole_and_in_order() {
        let (mut out, mut expected) = (heapless::String::<2048>::new(), heapless::String::<2048>::new());
        let mut buffer = TextBuffer::new(&mut out);
        let long = "ü".repeat(200);
        for piece in ["a", "bü", &long[..398], "c", &long, "d", &long[..300], "e"] {
            buffer.write_str(piece).unwrap();
            expected.push_str(piece).unwrap();
        }
        buffer.finish().unwrap();
        assert_eq!(out, expected);
    }

    #[test]
    fn text_beyond_the_room_is_an_error() {
        let mut out = heapless::String::<4>::new();
        let mut buffer = TextBuffer::new(&mut out);
        buffer.write_str("12345").unwrap();
        assert!(buffer.finish().is_err());
    }
}

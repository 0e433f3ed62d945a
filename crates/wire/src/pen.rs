//! Text put together before it is handed on.

use core::fmt::{self, Write};

/// How much is put together, bytes: most messages as a whole.
const ROOM: usize = 320;

/// Collects the dozens of pieces of a message and hands them on as one: that costs far less than to hand on each.
pub(crate) struct Pen<'a> {
    out: &'a mut dyn Write,
    /// Whole characters.
    text: [u8; ROOM],
    len: usize,
}

impl<'a> Pen<'a> {
    /// A pen that writes to this.
    pub(crate) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, text: [0; ROOM], len: 0 }
    }

    /// Hands on what is left.
    pub(crate) fn finish(mut self) -> fmt::Result {
        self.hand_on()
    }

    /// Writes whole characters of UTF-8.
    #[inline(always)] // What is written is a word that the compiler knows, mostly: then it copies it without a call.
    pub(crate) fn bytes(&mut self, bytes: &[u8]) -> fmt::Result {
        if let Some(room) = self.text.get_mut(self.len..self.len + bytes.len()) {
            room.copy_from_slice(bytes);
            self.len += bytes.len();
            return Ok(());
        }
        self.apart(bytes)
    }

    #[cold]
    fn apart(&mut self, bytes: &[u8]) -> fmt::Result {
        self.hand_on()?;
        self.out.write_str(core::str::from_utf8(bytes).map_err(|_| fmt::Error)?)
    }

    fn hand_on(&mut self) -> fmt::Result {
        let text = core::str::from_utf8(&self.text[..self.len]).map_err(|_| fmt::Error)?;
        self.len = 0;
        self.out.write_str(text)
    }
}

impl Write for Pen<'_> {
    #[inline(always)] // As `Pen::bytes`.
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
        let mut pen = Pen::new(&mut out);
        let long = "ü".repeat(200);
        for piece in ["a", "bü", &long[..398], "c", &long, "d", &long[..300], "e"] {
            pen.write_str(piece).unwrap();
            expected.push_str(piece).unwrap();
        }
        pen.finish().unwrap();
        assert_eq!(out, expected);
    }

    #[test]
    fn who_has_no_room_says_so() {
        let mut out = heapless::String::<4>::new();
        let mut pen = Pen::new(&mut out);
        pen.write_str("12345").unwrap();
        assert!(pen.finish().is_err());
    }
}

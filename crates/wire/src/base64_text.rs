//! Bytes in base64 (RFC 4648), written without padding and read with or without it.

use core::fmt;

use base64::Engine;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use crate::text_buffer::TextBuffer;

/// Number of bytes that are encoded at once; a multiple of three, so that the pieces join without padding. With a
/// larger value, the writer needs more stack.
const ENCODED_AT_ONCE: usize = 48;

/// The alphabet of RFC 4648, section 4.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_encode_padding(false)
        .with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Encodes bytes one after the other and writes them as text.
pub(crate) struct Base64Writer<'a, 'b> {
    out: &'a mut TextBuffer<'b>,
    bytes: heapless::Vec<u8, ENCODED_AT_ONCE>,
    result: fmt::Result,
}

impl<'a, 'b> Base64Writer<'a, 'b> {
    pub(crate) fn new(out: &'a mut TextBuffer<'b>) -> Self {
        Self { out, bytes: heapless::Vec::new(), result: Ok(()) }
    }

    pub(crate) fn push(&mut self, byte: u8) {
        // Cannot fail: the vector is emptied when it is full.
        let _ = self.bytes.push(byte);
        if self.bytes.is_full() {
            self.write();
        }
    }

    /// Writes the rest of the text.
    pub(crate) fn finish(mut self) -> fmt::Result {
        self.write();
        self.result
    }

    fn write(&mut self) {
        let mut text = [0; ENCODED_AT_ONCE / 3 * 4];
        if self.result.is_ok() {
            let length = BASE64.encode_slice(&self.bytes, &mut text).map_err(|_| fmt::Error);
            self.result = length.and_then(|length| self.out.bytes(&text[..length]));
        }
        self.bytes.clear();
    }
}

/// Decodes text into the beginning of `bytes` and returns that part; `None` if the text is not base64 or its bytes do
/// not fit.
pub(crate) fn decode<'a>(text: &str, bytes: &'a mut [u8]) -> Option<&'a [u8]> {
    let length = BASE64.decode_slice(text, bytes).ok()?;
    bytes.get(..length)
}

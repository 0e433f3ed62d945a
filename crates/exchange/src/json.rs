//! A JSON reader that builds no tree, and the parts that JSON formats share (`frames`, `text`).
//!
//! Unlike common parsers this one reads `NaN` and `Infinity`, so that an error can name the pixel that has them.

pub(crate) mod frames;
pub(crate) mod text;

use std::borrow::Cow;

use lightbots_show::excerpt;

use crate::error::ReadError;

/// A position in a JSON text. Reading a value moves the position to the byte after the value. Errors have line and
/// column.
#[derive(Clone)]
pub(crate) struct Json<'a> {
    text: &'a str,
    at: usize,
}

/// A JSON value. For a list or an object, only the kind is kept and not the contents.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Scalar<'a> {
    Number(f64),
    Text(Cow<'a, str>),
    Bool(bool),
    Null,
    List,
    Object,
}

/// Deepest nesting of lists and objects in a value that is read by [`Json::scalar`] or skipped. RFC 8259, section 9,
/// allows a bound. The reader is recursive: with a much larger bound, a hostile file could overflow the stack.
const DEPTH_MAX: usize = 32;

type Read<T> = Result<T, ReadError>;

impl<'a> Json<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, at: 0 }
    }

    /// Number of the line in which the position is, counted from 1.
    pub fn line(&self) -> usize {
        self.text.as_bytes()[..self.at].iter().filter(|byte| **byte == b'\n').count() + 1
    }

    /// Returns an error at the present position, with its line and column.
    pub fn fail(&self, code: &'static str, what: impl Into<String>) -> ReadError {
        ReadError::at(code, self.text, self.at, what)
    }

    /// Returns the next byte that is not white space, and moves the position to that byte. Fails at the end of the
    /// text.
    pub fn peek(&mut self) -> Read<u8> {
        self.blank();
        self.text.as_bytes().get(self.at).copied().ok_or_else(|| self.cut_off())
    }

    /// Skips white space. Returns whether the text ends there.
    pub fn is_at_end(&mut self) -> bool {
        self.blank();
        self.at >= self.text.len()
    }

    /// Reads an object. Calls `field` with each key; `field` must read the value.
    pub fn object(&mut self, mut field: impl FnMut(&mut Self, &str) -> Read<()>) -> Read<()> {
        self.open(b'{', "an object in { }")?;
        if self.peek()? == b'}' {
            self.at += 1;
            return Ok(());
        }
        loop {
            if self.peek()? != b'"' {
                return Err(self.unexpected("the name of a field in double quotes"));
            }
            let key = self.string()?;
            if self.peek()? != b':' {
                return Err(self.unexpected("':'"));
            }
            self.at += 1;
            field(self, &key)?;
            if !self.another(b'}')? {
                return Ok(());
            }
        }
    }

    /// Reads a list. Calls `item` with the index of each value; `item` must read the value.
    pub fn list(&mut self, mut item: impl FnMut(&mut Self, usize) -> Read<()>) -> Read<()> {
        self.open(b'[', "a list in [ ]")?;
        if self.peek()? == b']' {
            self.at += 1;
            return Ok(());
        }
        for index in 0.. {
            item(self, index)?;
            if !self.another(b']')? {
                break;
            }
        }
        Ok(())
    }

    /// Reads any value. Of a list or an object, only the kind is returned. Fails if they nest more than [`DEPTH_MAX`]
    /// deep.
    pub fn scalar(&mut self) -> Read<Scalar<'a>> {
        self.value(DEPTH_MAX)
    }

    /// Skips a value.
    pub fn skip(&mut self) -> Read<()> {
        self.scalar().map(drop)
    }

    /// Reads a finite number. `name` names the number in messages.
    pub fn number(&mut self, name: &str) -> Read<f64> {
        self.blank();
        let before = self.clone();
        let problem = match self.scalar()? {
            Scalar::Number(number) if number.is_finite() => return Ok(number),
            Scalar::Number(number) if number.is_nan() => "NaN, not a number".into(),
            Scalar::Number(_) => "infinite".into(),
            other => format!("{}, not a number", other.kind()),
        };
        Err(before.fail("not-a-number", format!("{name} is {problem}; give it a number")))
    }

    /// Reads a whole number from 0 to 4294967295.
    pub fn whole(&mut self, name: &str) -> Read<u32> {
        self.blank();
        let before = self.clone();
        let number = self.number(name)?;
        if number.fract() == 0.0 && (0.0..=u32::MAX as f64).contains(&number) {
            return Ok(number as u32);
        }
        Err(before.fail(
            "not-a-whole-number",
            format!("{name} is {}; give it a whole number from 0 to 4294967295", text::exact(number)),
        ))
    }

    /// Reads a text.
    pub fn text(&mut self, name: &str) -> Read<Cow<'a, str>> {
        self.blank();
        let before = self.clone();
        match self.scalar()? {
            Scalar::Text(text) => Ok(text),
            other => {
                let what = format!("{name} is {}, not a text; put it in double quotes", other.kind());
                Err(before.fail("not-a-text", what))
            }
        }
    }

    /// Returns the value of `key` in the object that follows, without moving the position. `None` if no object follows,
    /// the object lacks the key, or an error comes before it. If the key is there several times, the last value before
    /// an error counts.
    pub fn ahead(&self, key: &str) -> Option<Scalar<'a>> {
        let mut found = None;
        // An error after the key does not matter: the caller uses the value to say where its own error is.
        let _ = self.clone().object(|json, name| {
            let value = json.scalar()?;
            if name == key {
                found = Some(value);
            }
            Ok(())
        });
        found
    }

    /// Returns the error that something other than `wanted` follows, or that the text ends here.
    pub fn unexpected(&self, wanted: &str) -> ReadError {
        match self.text[self.at..].chars().next() {
            None => self.cut_off(),
            Some(char) => {
                let found = excerpt(char.encode_utf8(&mut [0; 4]));
                self.fail("not-json", format!("expected {wanted}, found '{found}'; is this a show file?"))
            }
        }
    }

    fn cut_off(&self) -> ReadError {
        self.fail("cut-off", "the file ends here, in the middle of the show; save or copy it again")
    }

    fn blank(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        let blank = |byte: &u8| matches!(byte, b' ' | b'\n' | b'\r' | b'\t');
        self.at += rest.iter().position(|byte| !blank(byte)).unwrap_or(rest.len());
    }

    fn open(&mut self, bracket: u8, wanted: &str) -> Read<()> {
        if self.peek()? != bracket {
            return Err(self.unexpected(wanted));
        }
        self.at += 1;
        Ok(())
    }

    fn another(&mut self, bracket: u8) -> Read<bool> {
        match self.peek()? {
            b',' => {
                self.at += 1;
                Ok(true)
            }
            byte if byte == bracket => {
                self.at += 1;
                Ok(false)
            }
            _ => Err(self.unexpected(&format!("',' or '{}'", bracket as char))),
        }
    }

    fn value(&mut self, depth: usize) -> Read<Scalar<'a>> {
        match self.peek()? {
            b'{' | b'[' if depth == 0 => {
                Err(self
                    .fail("too-deep", format!("lists nest more than {DEPTH_MAX} deep; this is not a show")))
            }
            b'{' => {
                self.object(|json, _| json.value(depth - 1).map(drop))?;
                Ok(Scalar::Object)
            }
            b'[' => {
                self.list(|json, _| json.value(depth - 1).map(drop))?;
                Ok(Scalar::List)
            }
            b'"' => self.string().map(Scalar::Text),
            b'-' | b'+' | b'.' | b'0'..=b'9' | b'a'..=b'z' | b'A'..=b'Z' => self.word(),
            _ => Err(self.unexpected("a value")),
        }
    }

    /// Reads a number, or `true`, `false` or `null`. Numbers may be NaN or infinite.
    fn word(&mut self) -> Read<Scalar<'a>> {
        let rest = &self.text[self.at..];
        let part = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'+' | b'.');
        let end = rest.bytes().position(|byte| !part(&byte)).unwrap_or(rest.len());
        let word = &rest[..end];
        let scalar = match word {
            "true" => Scalar::Bool(true),
            "false" => Scalar::Bool(false),
            "null" => Scalar::Null,
            // `parse` also reads NaN, inf and infinity, in any case and with any sign.
            _ => match word.parse() {
                Ok(number) => Scalar::Number(number),
                Err(_) if end == rest.len() => return Err(Self { at: self.text.len(), ..*self }.cut_off()),
                Err(_) => {
                    let what = format!("'{}' is neither a number nor true, false or null", excerpt(word));
                    return Err(self.fail("not-json", what));
                }
            },
        };
        self.at += end;
        Ok(scalar)
    }

    /// Reads a text in double quotes. The position is at the opening quote.
    fn string(&mut self) -> Read<Cow<'a, str>> {
        self.at += 1;
        let start = self.at;
        let mut copy: Option<String> = None;
        let mut kept = start;
        loop {
            let Some(byte) = self.text.as_bytes().get(self.at) else { return Err(self.cut_off()) };
            match byte {
                b'"' => {
                    let tail = &self.text[kept..self.at];
                    self.at += 1;
                    return Ok(match copy {
                        None => Cow::Borrowed(tail),
                        Some(copy) => Cow::Owned(copy + tail),
                    });
                }
                b'\\' => {
                    let copy = copy.get_or_insert_default();
                    copy.push_str(&self.text[kept..self.at]);
                    copy.push(self.escape()?);
                    kept = self.at;
                }
                0..=0x1f => {
                    return Err(self.fail("not-json", "the text in double quotes does not end on its line"));
                }
                _ => self.at += 1,
            }
        }
    }

    /// Reads an escape sequence that begins with a backslash, and returns its character.
    fn escape(&mut self) -> Read<char> {
        let escaped = self.text.as_bytes().get(self.at + 1).copied().ok_or_else(|| self.cut_off())?;
        let char = match escaped {
            b'"' | b'\\' | b'/' => escaped as char,
            b'n' => '\n',
            b'r' => '\r',
            b't' => '\t',
            b'b' => '\u{8}',
            b'f' => '\u{c}',
            b'u' => return self.unicode_escape(),
            _ => return Err(self.fail("not-json", "a backslash that escapes nothing; write two of them")),
        };
        self.at += 2;
        Ok(char)
    }

    /// Reads `\uXXXX`, or a pair of surrogates. A surrogate without its pair becomes U+FFFD.
    fn unicode_escape(&mut self) -> Read<char> {
        let hex = |at: usize| {
            let digits = self.text.get(at..at + 6)?.strip_prefix("\\u")?;
            u32::from_str_radix(digits, 16).ok()
        };
        let first = hex(self.at)
            .ok_or_else(|| self.fail("not-json", "\\u must be followed by four hexadecimal digits"))?;
        let second = hex(self.at + 6).filter(|second| (0xdc00..0xe000).contains(second));
        let (code, taken) = match second {
            Some(second) if (0xd800..0xdc00).contains(&first) => {
                (0x1_0000 + ((first - 0xd800) << 10) + (second - 0xdc00), 12)
            }
            _ => (first, 6),
        };
        self.at += taken;
        Ok(char::from_u32(code).unwrap_or(char::REPLACEMENT_CHARACTER))
    }
}

/// The first byte that is neither white space nor a byte order mark.
pub(crate) fn first_byte(bytes: &[u8]) -> Option<u8> {
    without_mark(bytes).iter().copied().find(|byte| !byte.is_ascii_whitespace())
}

/// The bytes as text, without a byte order mark.
pub(crate) fn text(bytes: &[u8]) -> Result<&str, ReadError> {
    let bytes = without_mark(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let before = std::str::from_utf8(&bytes[..error.valid_up_to()]).unwrap_or("");
        ReadError::at("not-utf-8", before, before.len(), "this is not UTF-8 text")
    })
}

fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

impl Scalar<'_> {
    /// The value, described for messages.
    fn kind(&self) -> String {
        match self {
            Self::Number(number) if number.is_finite() => format!("the number {}", text::exact(*number)),
            Self::Number(number) => format!("the number {number}"),
            Self::Text(text) => format!("the text \"{}\"", excerpt(text)),
            Self::Bool(value) => value.to_string(),
            Self::Null => "null".into(),
            Self::List => "a list".into(),
            Self::Object => "an object".into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_for_what_they_are() {
        for (text, number) in
            [("-1.5e2", -150.0), ("0", 0.0), ("1E-4", 1e-4), ("-Infinity", f64::NEG_INFINITY)]
        {
            assert_eq!(Json::new(text).scalar().unwrap(), Scalar::Number(number), "{text}");
        }
        assert!(matches!(Json::new("NaN").scalar().unwrap(), Scalar::Number(number) if number.is_nan()));
    }

    #[test]
    fn texts_keep_every_character() {
        let text = Json::new(r#""a\"\u00e4\ud83d\ude00\ud83d \\ö""#).text("name").unwrap();
        assert_eq!(text, "a\"ä😀\u{fffd} \\ö");
    }

    #[test]
    fn deep_nesting_is_refused() {
        let text = "[".repeat(1_000_000);
        assert_eq!(Json::new(&text).skip().unwrap_err().code, "too-deep");
    }

    #[test]
    fn every_truncation_is_an_error() {
        let text = r#"{"a": [1.5, "x\n\u0041", {"b": null}], "c": false}"#;
        for end in 0..text.len() {
            assert!(Json::new(&text[..end]).skip().is_err(), "{end}");
        }
        assert!(Json::new(text).skip().is_ok());
    }
}

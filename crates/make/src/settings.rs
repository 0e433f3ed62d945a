//! Reads and writes typed values as the named settings of a source.

use lightbots_base::{Rgb, Vec2};
use lightbots_draw::DrawError;
use lightbots_show::{NamedSettings, Setting, setting};

/// Reads settings by their names. `Null` counts as not set. A value of another type than the one asked for is an error.
pub(crate) struct Reader<'a>(pub &'a NamedSettings);

impl Reader<'_> {
    /// Reads a text; `usual` if it is not set.
    pub fn text(&self, name: &str, usual: &str) -> Result<String, DrawError> {
        match setting(self.0, name) {
            None | Some(Setting::Null) => Ok(usual.to_owned()),
            Some(Setting::Text(text)) => Ok(text.clone()),
            Some(_) => Err(wrong(name, "a text")),
        }
    }

    /// Reads a truth value; `usual` if it is not set.
    pub fn flag(&self, name: &str, usual: bool) -> Result<bool, DrawError> {
        match setting(self.0, name) {
            None | Some(Setting::Null) => Ok(usual),
            Some(Setting::Bool(flag)) => Ok(*flag),
            Some(_) => Err(wrong(name, "true or false")),
        }
    }

    /// Reads a number; `None` if it is not set.
    pub fn number(&self, name: &str) -> Result<Option<f64>, DrawError> {
        match setting(self.0, name) {
            None | Some(Setting::Null) => Ok(None),
            Some(Setting::Number(number)) => Ok(Some(*number)),
            Some(_) => Err(wrong(name, "a number")),
        }
    }

    /// Reads a whole number from 0 to 1,000,000; `usual` if it is not set.
    pub fn whole(&self, name: &str, usual: usize) -> Result<usize, DrawError> {
        match self.number(name)? {
            None => Ok(usual),
            Some(number) if (0.0..=1e6).contains(&number) && number.fract() == 0.0 => Ok(number as usize),
            Some(_) => Err(wrong(name, "a whole number from 0 to 1000000")),
        }
    }

    /// Reads one colour such as `#ffa500`, or a list of colours; empty if it is not set.
    pub fn colors(&self, name: &str) -> Result<Vec<Rgb>, DrawError> {
        let color = |value: &Setting| match value {
            Setting::Text(text) => Rgb::from_hex(text).ok_or_else(|| wrong(name, "a colour such as #ffa500")),
            _ => Err(wrong(name, "a colour such as #ffa500")),
        };
        match setting(self.0, name) {
            None | Some(Setting::Null) => Ok(Vec::new()),
            Some(Setting::List(list)) => list.iter().map(color).collect(),
            Some(value) => Ok(vec![color(value)?]),
        }
    }

    /// Reads a list of points `[x, y]`; empty if it is not set.
    pub fn points(&self, name: &str) -> Result<Vec<Vec2>, DrawError> {
        let point = |value: &Setting| match value {
            Setting::List(pair) => match pair.as_slice() {
                [Setting::Number(x), Setting::Number(y)] => Ok(Vec2::new(*x, *y)),
                _ => Err(wrong(name, "a list of points [x, y]")),
            },
            _ => Err(wrong(name, "a list of points [x, y]")),
        };
        match setting(self.0, name) {
            None | Some(Setting::Null) => Ok(Vec::new()),
            Some(Setting::List(list)) => list.iter().map(point).collect(),
            Some(_) => Err(wrong(name, "a list of points [x, y]")),
        }
    }

    /// Reads a text that must be one of `words`, and returns the value beside the word. If the setting is missing, returns
    /// the value of the first word.
    pub fn word<T: Copy>(&self, name: &str, words: &[(&str, T)]) -> Result<T, DrawError> {
        let usual = words.first().map_or("", |(word, _)| word);
        let text = self.text(name, usual)?;
        let found = words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        found.ok_or_else(|| wrong(name, &known.join(" or ")))
    }
}

/// Collects named settings. Settings that have their usual value are left out.
#[derive(Default)]
pub(crate) struct Writer(pub NamedSettings);

impl Writer {
    /// Adds a value, even if it is the usual one.
    pub fn put(&mut self, name: &str, value: Setting) {
        self.0.push((name.to_owned(), value));
    }

    /// Adds a text, unless it is `usual`.
    pub fn text(&mut self, name: &str, text: &str, usual: &str) {
        if text != usual {
            self.put(name, Setting::Text(text.to_owned()));
        }
    }

    /// Adds a truth value, unless it is `usual`.
    pub fn flag(&mut self, name: &str, flag: bool, usual: bool) {
        if flag != usual {
            self.put(name, Setting::Bool(flag));
        }
    }

    /// Adds a number, unless it is `usual`.
    pub fn number(&mut self, name: &str, number: f64, usual: f64) {
        if number != usual {
            self.put(name, Setting::Number(number));
        }
    }

    /// Adds a list of colours, unless it is empty.
    pub fn colors(&mut self, name: &str, colors: &[Rgb]) {
        if !colors.is_empty() {
            let text = |color: &Rgb| Setting::Text(color.to_string());
            self.put(name, Setting::List(colors.iter().map(text).collect()));
        }
    }

    /// Adds a list of points, unless it is empty.
    pub fn points(&mut self, name: &str, points: &[Vec2]) {
        if !points.is_empty() {
            let point = |at: &Vec2| Setting::List(vec![Setting::Number(at.x), Setting::Number(at.y)]);
            self.put(name, Setting::List(points.iter().map(point).collect()));
        }
    }

    /// Adds the word that stands beside `value` in `words`. Adds nothing for the first word, which is the usual one.
    pub fn word<T: PartialEq>(&mut self, name: &str, value: &T, words: &[(&str, T)]) {
        let found = words.iter().skip(1).find(|(_, known)| known == value);
        if let Some((word, _)) = found {
            self.put(name, Setting::Text((*word).to_owned()));
        }
    }
}

fn wrong(name: &str, wanted: &str) -> DrawError {
    DrawError::new("bad-setting", format!("the setting \"{name}\" of a source must be {wanted}"))
}

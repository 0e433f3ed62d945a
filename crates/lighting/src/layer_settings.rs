//! Reads named settings, and notes as faults which of them are wrong or have no meaning.

use lightbots_base::{Rgb, Vec2};
use lightbots_light::LayerFault;
use lightbots_show::{NamedSettings, Setting, excerpt};

/// The settings of a layer, or of a part of it, while they are read.
pub(crate) struct LayerSettings<'a> {
    settings: &'a NamedSettings,
    number: usize,
    read: Vec<&'static str>,
    /// What is wrong with the settings that were read.
    pub faults: Vec<LayerFault>,
}

impl<'a> LayerSettings<'a> {
    pub fn new(settings: &'a NamedSettings, number: usize) -> Self {
        Self { settings, number, read: Vec::new(), faults: Vec::new() }
    }

    /// Returns a reader of the settings of a part of the layer, such as a mask. The part has its own list of faults.
    pub fn part<'b>(&self, settings: &'b NamedSettings) -> LayerSettings<'b> {
        LayerSettings::new(settings, self.number)
    }

    pub fn fault(&mut self, field: &'static str, value: impl Into<String>, remedy: impl Into<String>) {
        let fault =
            LayerFault { layer: Some(self.number), field, value: value.into(), remedy: remedy.into() };
        self.faults.push(fault);
    }

    pub fn get(&mut self, name: &'static str) -> Option<&'a Setting> {
        self.read.push(name);
        lightbots_show::setting(self.settings, name).filter(|setting| **setting != Setting::Null)
    }

    pub fn number(&mut self, name: &'static str, default: f64) -> f64 {
        match self.get(name) {
            None => default,
            Some(Setting::Number(number)) => *number,
            Some(other) => {
                self.fault(name, shown(other), "give a number");
                default
            }
        }
    }

    /// Reads a whole number of 0 or more. Returns `default` if the setting is missing. Returns `default` and adds a fault
    /// if it is anything else.
    pub fn whole(&mut self, name: &'static str, default: u64) -> u64 {
        let number = self.number(name, default as f64);
        // Whole numbers up to 2⁵³ are exact in a file.
        if (0.0..=9_007_199_254_740_992.0).contains(&number) && number.fract() == 0.0 {
            return number as u64;
        }
        self.fault(name, number.to_string(), "give a whole number of 0 or more");
        default
    }

    pub fn truth(&mut self, name: &'static str) -> bool {
        match self.get(name) {
            None => false,
            Some(Setting::Bool(truth)) => *truth,
            Some(other) => {
                self.fault(name, shown(other), "give true or false");
                false
            }
        }
    }

    /// Reads one of `words` and returns the value beside it. Returns the default of `T` if the setting is missing. Returns
    /// the default and adds a fault if it is anything else.
    pub fn word<T: Copy + Default>(&mut self, name: &'static str, words: &[(&str, T)]) -> T {
        let Some(setting) = self.get(name) else { return T::default() };
        if let Setting::Text(text) = setting
            && let Some((_, value)) = words.iter().find(|(word, _)| word == text)
        {
            return *value;
        }
        let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        self.fault(name, shown(setting), format!("choose one of {}", known.join(", ")));
        T::default()
    }

    pub fn place(&mut self, name: &'static str, default: Vec2) -> Vec2 {
        let Some(setting) = self.get(name) else { return default };
        point(setting).unwrap_or_else(|| {
            self.fault(name, shown(setting), "give two numbers: [x, y]");
            default
        })
    }

    pub fn points(&mut self, name: &'static str) -> Vec<Vec2> {
        let points = self.list(name, "give a list of places: [[x, y], …]", point);
        points.unwrap_or_default()
    }

    /// Reads a list, each item with `read`. Returns `None` if the setting is missing. Returns `None` and adds a fault with
    /// `remedy` if it is no list, or `read` returns `None` for an item.
    pub fn list<T>(
        &mut self,
        name: &'static str,
        remedy: &str,
        read: impl Fn(&Setting) -> Option<T>,
    ) -> Option<Vec<T>> {
        let setting = self.get(name)?;
        let items: Option<Vec<T>> = match setting {
            Setting::List(items) => items.iter().map(read).collect(),
            _ => None,
        };
        if items.is_none() {
            self.fault(name, shown(setting), remedy);
        }
        items
    }

    /// Adds a fault for each setting that was not read, because its name may be mistyped. Returns all faults.
    pub fn end(mut self) -> Vec<LayerFault> {
        let known = |name: &str| self.read.contains(&name);
        let unknown: Vec<String> =
            self.settings.iter().filter(|(name, _)| !known(name)).map(|(name, _)| excerpt(name)).collect();
        for name in unknown {
            self.fault("settings", name, "has no meaning for this layer; take it out");
        }
        self.faults
    }
}

/// Reads a place, `[x, y]`. `None` if the setting is no list of two numbers.
pub(crate) fn point(setting: &Setting) -> Option<Vec2> {
    match setting {
        Setting::List(items) => match items.as_slice() {
            [Setting::Number(x), Setting::Number(y)] => Some(Vec2::new(*x, *y)),
            _ => None,
        },
        _ => None,
    }
}

/// Reads a colour such as `#ff8800`. `None` if the setting is not a text of this form.
pub(crate) fn colour(setting: &Setting) -> Option<Rgb> {
    match setting {
        Setting::Text(text) => Rgb::from_hex(text),
        _ => None,
    }
}

/// Describes the value of a setting in a fault: the value itself, the start of a long text, or the kind of a larger value.
pub(crate) fn shown(setting: &Setting) -> String {
    match setting {
        Setting::Null => "nothing".into(),
        Setting::Bool(truth) => truth.to_string(),
        Setting::Number(number) => number.to_string(),
        Setting::Text(text) => format!("\"{}\"", excerpt(text)),
        Setting::List(items) => format!("a list of {}", items.len()),
        Setting::Object(_) => "a group of settings".into(),
    }
}

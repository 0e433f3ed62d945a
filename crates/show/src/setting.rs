//! Settings of sources and layers.

/// A value of a setting: any JSON value with finite numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    /// No value.
    Null,
    /// A truth value.
    Bool(bool),
    /// A finite number.
    Number(f64),
    /// A text.
    Text(String),
    /// Values in order.
    List(Vec<Setting>),
    /// Named values.
    Object(NamedSettings),
}

/// Named values in the order of the file. Names are unique.
pub type NamedSettings = Vec<(String, Setting)>;

/// Returns the value of the setting called `name`; `None` if there is no such setting.
pub fn setting<'a>(settings: &'a NamedSettings, name: &str) -> Option<&'a Setting> {
    settings.iter().find(|(key, _)| key == name).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setting_is_found_by_its_name() {
        let settings =
            vec![("text".to_owned(), Setting::Text("HI".into())), ("bold".to_owned(), Setting::Bool(true))];
        assert_eq!(setting(&settings, "bold"), Some(&Setting::Bool(true)));
        assert_eq!(setting(&settings, "font"), None);
    }
}

//! Settings of sources and layers: any JSON value within bounds, kept exactly.

use lightbots_show::{
    MAX_SETTING_DEPTH, MAX_SETTING_VALUES, MAX_SETTINGS_OF_SHOW, NamedSettings, Setting, excerpt,
};

use crate::error::ReadError;
use crate::json::frames::Notes;
use crate::json::text::{exact, quoted};
use crate::json::{Json, Scalar};

/// Reads an object of settings.
pub(super) fn read(json: &mut Json<'_>, notes: &mut Notes) -> Result<NamedSettings, ReadError> {
    let mut room = MAX_SETTING_VALUES;
    let settings = object(json, &mut room, MAX_SETTING_DEPTH)?;
    notes.settings += MAX_SETTING_VALUES - room;
    if notes.settings > MAX_SETTINGS_OF_SHOW {
        let what = format!("the show has more than {MAX_SETTINGS_OF_SHOW} values in settings; split it");
        return Err(json.fail("too-many-settings", what));
    }
    Ok(settings)
}

fn object(json: &mut Json<'_>, room: &mut usize, depth: usize) -> Result<NamedSettings, ReadError> {
    let mut settings = NamedSettings::new();
    let mut names = std::collections::BTreeSet::new();
    json.object(|json, key| {
        if !names.insert(key.to_owned()) {
            let what = format!("the setting \"{}\" stands twice; take one away", excerpt(key));
            return Err(json.fail("duplicate-field", what));
        }
        settings.push((key.to_owned(), value(json, key, room, depth)?));
        Ok(())
    })?;
    Ok(settings)
}

/// Reads the value of the setting `name`, or a value within it. `room` is the number of values that may still be read
/// in this group of settings. `depth` is the number of levels by which lists and objects may still nest.
fn value(json: &mut Json<'_>, name: &str, room: &mut usize, depth: usize) -> Result<Setting, ReadError> {
    *room = room.checked_sub(1).ok_or_else(|| {
        let what = format!(
            "more than {MAX_SETTING_VALUES} values in one group of settings; simplify the setting \"{}\"",
            excerpt(name)
        );
        json.fail("too-many-settings", what)
    })?;
    let is_nested = matches!(json.peek()?, b'{' | b'[');
    if is_nested && depth == 0 {
        let what = format!("settings nest more than {MAX_SETTING_DEPTH} deep; simplify them");
        return Err(json.fail("too-deep", what));
    }
    match json.peek()? {
        b'{' => Ok(Setting::Object(object(json, room, depth - 1)?)),
        b'[' => {
            let mut items = Vec::new();
            json.list(|json, _| {
                items.push(value(json, name, room, depth - 1)?);
                Ok(())
            })?;
            Ok(Setting::List(items))
        }
        _ => scalar(json, name),
    }
}

fn scalar(json: &mut Json<'_>, name: &str) -> Result<Setting, ReadError> {
    let before = json.clone();
    Ok(match json.scalar()? {
        Scalar::Null => Setting::Null,
        Scalar::Bool(value) => Setting::Bool(value),
        Scalar::Text(text) => Setting::Text(text.into_owned()),
        _ => Setting::Number(before.clone().number(&format!("the setting \"{}\"", excerpt(name)))?),
    })
}

/// Writes the settings as JSON on one line.
pub(super) fn text(settings: &NamedSettings) -> String {
    let fields = settings.iter().map(|(name, value)| format!("{}: {}", quoted(name), value_text(value)));
    let fields: Vec<String> = fields.collect();
    if fields.is_empty() { "{}".into() } else { format!("{{ {} }}", fields.join(", ")) }
}

fn value_text(value: &Setting) -> String {
    match value {
        Setting::Null => "null".into(),
        Setting::Bool(value) => value.to_string(),
        Setting::Number(number) => exact(*number),
        Setting::Text(text) => quoted(text),
        Setting::List(items) => {
            format!("[{}]", items.iter().map(value_text).collect::<Vec<_>>().join(", "))
        }
        Setting::Object(settings) => text(settings),
    }
}

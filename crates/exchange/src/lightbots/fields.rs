//! Fields that several objects of our format have: places, words, short texts, bounded lists.

use lightbots_base::Vec2;
use lightbots_show::{MAX_LABEL_CHARS, excerpt};

use crate::error::ReadError;
use crate::json::Json;

/// Reads a place `[x, y]` in stage metres.
pub(super) fn place(json: &mut Json<'_>, name: &str) -> Result<Vec2, ReadError> {
    let mut at = [None; 2];
    json.list(|json, index| {
        let axis = if index == 0 { "x" } else { "y" };
        let number = json.number(&format!("{axis} of the {name}"))?;
        if let Some(slot) = at.get_mut(index) {
            *slot = Some(number);
            return Ok(());
        }
        Err(json
            .fail("bad-place", format!("the {name} has more than two numbers; give it x and y in metres")))
    })?;
    match at {
        [Some(x), Some(y)] => Ok(Vec2::new(x, y)),
        _ => {
            Err(json.fail("bad-place", format!("the {name} has too few numbers; give it x and y in metres")))
        }
    }
}

/// Reads a text that must be one of `words`. Returns the value that stands beside the word. `name` names the field in
/// messages.
pub(super) fn one_of<T: Copy>(json: &mut Json<'_>, name: &str, words: &[(&str, T)]) -> Result<T, ReadError> {
    json.peek()?;
    let before = json.clone();
    let text = json.text(name)?;
    words.iter().find(|(word, _)| *word == text).map(|(_, value)| *value).ok_or_else(|| {
        let known: Vec<String> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
        let what = format!("{name} is \"{}\"; it can be {}", excerpt(&text), known.join(" or "));
        before.fail("unknown-word", what)
    })
}

/// Reads a text: a name, an id or a word. More than [`MAX_LABEL_CHARS`] characters are an error. `name` names the field
/// in messages.
pub(super) fn label(json: &mut Json<'_>, name: &str) -> Result<String, ReadError> {
    json.peek()?;
    let before = json.clone();
    let text = json.text(name)?;
    if text.chars().count() > MAX_LABEL_CHARS {
        let what = format!("{name} is longer than {MAX_LABEL_CHARS} characters; shorten it");
        return Err(before.fail("too-long", what));
    }
    Ok(text.into_owned())
}

/// Reads a list of at most `most` items; a longer list is an error. `name` names the items in messages, such as "layers".
pub(super) fn bounded<T>(
    json: &mut Json<'_>,
    name: &str,
    most: usize,
    mut item: impl FnMut(&mut Json<'_>) -> Result<T, ReadError>,
) -> Result<Vec<T>, ReadError> {
    let mut items = Vec::new();
    json.list(|json, index| {
        if index >= most {
            return Err(json.fail("too-many-items", format!("more than {most} {name}; take some away")));
        }
        items.push(item(json)?);
        Ok(())
    })?;
    Ok(items)
}

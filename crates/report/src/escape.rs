//! Escapes text of files, shows and robots for a page.

/// Returns a text with HTML's special characters escaped, for contents and attributes of elements. Control characters
/// become spaces.
pub(crate) fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            letter if letter.is_control() => safe.push(' '),
            letter => safe.push(letter),
        }
    }
    safe
}

/// Returns JSON with each `<` escaped, so that it cannot end the HTML element that it is in. `<` occurs only in strings of
/// JSON, where the escape has the same meaning.
pub(crate) fn json_in_html(json: &str) -> String {
    json.replace('<', "\\u003c")
}

//! Names of shows in the library.

use std::path::Path;

use lightbots_exchange::stem;

/// The longest name, in characters. It may also have at most 200 bytes in UTF-8.
const NAME_MAX: usize = 80;

fn may_hold(letter: char) -> bool {
    letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_' | '.' | ',' | '(' | ')' | '!' | '\'' | '+')
}

/// Returns the name if the library allows it: 1 to `NAME_MAX` characters that file names may have on all systems. The
/// error says which characters are allowed.
pub(super) fn checked(name: &str) -> Result<&str, String> {
    let fits = (1..=NAME_MAX).contains(&name.chars().count())
        && name.len() <= 200
        && name.chars().all(may_hold)
        && !name.starts_with(['.', ' '])
        && !name.ends_with(['.', ' ']);
    if fits {
        return Ok(name);
    }
    Err(format!("a show's name has 1 to {NAME_MAX} letters, digits, spaces and . , - _ ( ) ! ' +"))
}

/// Returns an allowed name of at most 40 characters that is close to a text.
pub(super) fn tidy_name(text: &str) -> String {
    let letters: String = text.chars().map(|letter| if may_hold(letter) { letter } else { '-' }).collect();
    let short: String = letters.trim_matches(['.', ' ']).chars().take(40).collect();
    let short = short.trim_end_matches(['.', ' ']);
    if short.is_empty() { "show".into() } else { short.to_owned() }
}

/// Returns the name that a show gets in the library if it is read from the file at `path`.
pub fn name_of_file(path: &Path) -> String {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    tidy_name(stem(&name))
}

//! Splits a text into lines and words, each with its position in bytes.

/// Returns the lines of a text, each with its position in the text in bytes. Blank lines at the start and the end are
/// dropped.
pub(super) fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let filled = |line: &&str| !line.trim().is_empty();
    let mut end = 0;
    let placed = |line| {
        let from = end;
        end += str::len(line) + 1;
        (from, line)
    };
    let all: Vec<(usize, &str)> = text.split('\n').map(placed).collect();
    let first = all.iter().position(|(_, line)| filled(line)).unwrap_or(0);
    let last = all.iter().rposition(|(_, line)| filled(line)).map_or(0, |at| at + 1);
    all.into_iter().take(last).skip(first)
}

/// Returns the words of a line, each with its position in the line in bytes.
pub(super) fn words(line: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut from = 0;
    let all = line.split(char::is_whitespace).map(move |word| {
        let at = from;
        let blank = line.get(at + word.len()..).and_then(|rest| rest.chars().next());
        from = at + word.len() + blank.map_or(0, char::len_utf8);
        (at, word)
    });
    all.filter(|(_, word)| !word.is_empty())
}

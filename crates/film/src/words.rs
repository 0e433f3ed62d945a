//! Shortens texts for sheets.

/// Returns at most `most` characters of a text, without control characters. If the text is longer, an ellipsis is the last
/// of these characters.
pub(crate) fn short(text: &str, most: usize) -> String {
    let mut letters = text.chars().filter(|letter| !letter.is_control());
    let mut kept: String = letters.by_ref().take(most).collect();
    if letters.next().is_some() {
        kept.pop();
        kept.push('…');
    }
    kept
}

/// Returns number and name of a frame, such as `3 Heart`, or `3` if it has no name, in at most `most` characters.
pub(crate) fn numbered(index: usize, name: &str, most: usize) -> String {
    short(format!("{} {name}", index + 1).trim_end(), most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_bounded() {
        assert_eq!((short("héart", 5), short("héarts\n", 5)), ("héart".into(), "héar…".into()));
        assert_eq!((numbered(2, "", 9), numbered(2, "Heart", 9)), ("3".into(), "3 Heart".into()));
    }
}

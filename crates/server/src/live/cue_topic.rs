//! GO from other programs by MQTT (R54 of docs/protocol.md): a topic of its own, so that a desk needs no right to
//! command robots.

/// The topic on which GO is published. No robot subscribes to this topic, and no robot's name can result in it.
pub const CUE: &str = "T/LightBot/Controller/Cue";

/// Whether a message on [`CUE`] is GO.
pub fn is_go(payload: &[u8]) -> bool {
    payload.trim_ascii().eq_ignore_ascii_case(b"GO")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn go_is_the_word_alone() {
        assert!(is_go(b"GO") && is_go(b" go\n"));
        assert!(!is_go(b"") && !is_go(b"GO 1") && !is_go(b"|GO|") && !is_go(&[0xff; 90]));
    }
}

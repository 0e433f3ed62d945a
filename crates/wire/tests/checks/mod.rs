//! Properties of every message, for mutations here and for the fuzzers in `fuzz`.

use lightbots_wire::{Command, Report, TimeQuestion, Topic, commands, encode};

/// Reads the bytes with every decoder of the wire. Returns whether any of them accepted the bytes.
pub fn read(bytes: &[u8]) -> bool {
    let mut is_read = false;
    for command in commands(bytes).flatten() {
        is_read = true;
        // A robot refuses this target (R19), whose last decimals are finer than its `f64`.
        if matches!(command, Command::Target(to) if to.x.abs().max(to.y.abs()) > 1_000.0) {
            continue;
        }
        let mut text = String::new();
        encode(&command, &mut text).unwrap();
        let mut again = String::new();
        commands(text.as_bytes()).flatten().for_each(|command| encode(&command, &mut again).unwrap());
        assert_eq!(again, text);
    }
    if let Some(report) = Report::decode(bytes) {
        is_read = true;
        let mut text = String::new();
        report.encode(&mut text).unwrap();
        let mut again = String::new();
        let report = Report::decode(text.as_bytes()).unwrap_or_else(|| panic!("{text} is not read again"));
        report.encode(&mut again).unwrap();
        assert_eq!(again, text);
    }
    is_read |= TimeQuestion::decode(bytes).is_some();
    is_read | std::str::from_utf8(bytes).is_ok_and(|text| Topic::parse(text).is_some())
}

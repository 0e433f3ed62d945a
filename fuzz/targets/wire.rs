//! Everything that can come over the wire: what is read is the same after writing and reading it again.
#![no_main]

use libfuzzer_sys::fuzz_target;
use lightbots_wire::{Command, Report, TimeQuestion, Topic, commands, encode};

fuzz_target!(|bytes: &[u8]| {
    for command in commands(bytes).flatten() {
        // A robot refuses such a target (R19); its last decimals are beyond what a number holds.
        if matches!(command, Command::Target(to) if to.x.abs().max(to.y.abs()) > 1_000.0) {
            continue;
        }
        let (mut text, mut again) = (String::new(), String::new());
        encode(&command, &mut text).unwrap();
        commands(text.as_bytes()).flatten().for_each(|command| encode(&command, &mut again).unwrap());
        assert_eq!(again, text);
    }
    if let Some(report) = Report::decode(bytes) {
        let (mut text, mut again) = (String::new(), String::new());
        report.encode(&mut text).unwrap();
        Report::decode(text.as_bytes()).expect("what we write we read").encode(&mut again).unwrap();
        assert_eq!(again, text);
    }
    let _ = TimeQuestion::decode(bytes);
    if let Ok(text) = std::str::from_utf8(bytes) {
        let _ = Topic::parse(text);
    }
});

//! Checks the examples in docs/protocol.md.

use lightbots_wire::{Command, Report, TimeQuestion, Topic, Unknown, commands, encode};

const DOCUMENT: &str = include_str!("../../../docs/protocol.md");

/// The lines of all blocks that are fenced with this word. Fails if there are none.
fn examples(word: &str) -> Vec<&'static str> {
    let mut lines = Vec::new();
    let mut inside = false;
    for line in DOCUMENT.lines() {
        match line.strip_prefix("```") {
            Some(fence) => inside = fence == word,
            None if inside => lines.push(line),
            None => {}
        }
    }
    assert!(!lines.is_empty(), "no examples of {word}");
    lines
}

fn pairs(word: &str) -> Vec<(&'static str, &'static str)> {
    examples(word).into_iter().map(|line| line.split_once(" => ").expect(line)).collect()
}

fn decoded(payload: &str) -> Vec<Result<Command, Unknown>> {
    commands(payload.as_bytes()).collect()
}

#[test]
fn commands_are_written_exactly_so() {
    for payload in examples("commands") {
        let mut written = String::new();
        for command in decoded(payload) {
            encode(&command.expect(payload), &mut written).unwrap();
        }
        assert_eq!(written, payload);
    }
}

#[test]
fn every_command_has_an_example() {
    let named = |word: &str| examples("commands").iter().any(|line| line.contains(&format!("|{word}")));
    for row in DOCUMENT.lines().skip_while(|line| !line.starts_with("| command |")).skip(2) {
        let Some(word) = row.strip_prefix("| `").and_then(|row| row.split([' ', '`']).next()) else {
            break;
        };
        assert!(named(word), "{word}");
    }
}

#[test]
fn what_others_write_means_the_same() {
    for (theirs, ours) in pairs("read-as") {
        assert_eq!(decoded(theirs), decoded(ours), "{theirs}");
        assert!(decoded(theirs).iter().all(Result::is_ok), "{theirs}");
    }
    for payload in examples("unknown") {
        let read = decoded(payload);
        assert!(read.len() == 1 && read[0].is_err(), "{payload}");
    }
}

#[test]
fn reports_are_written_and_read_so() {
    for payload in examples("reports") {
        let mut written = String::new();
        Report::decode(payload.as_bytes()).expect(payload).encode(&mut written).unwrap();
        assert_eq!(written, payload);
    }
    for (theirs, ours) in pairs("reports-read-as") {
        let read = Report::decode(theirs.as_bytes());
        assert!(read.is_some() && read == Report::decode(ours.as_bytes()), "{theirs}");
    }
    for payload in examples("no-reports") {
        assert_eq!(Report::decode(payload.as_bytes()), None, "{payload}");
    }
}

#[test]
fn topics_and_questions_are_written_so() {
    for text in examples("topics") {
        assert_eq!(Topic::parse(text).expect(text).write().as_str(), text);
    }
    for payload in examples("questions") {
        let mut written = String::new();
        TimeQuestion::decode(payload.as_bytes()).expect(payload).encode(&mut written).unwrap();
        assert_eq!(written, payload);
    }
}

#[test]
fn rules_are_numbered_in_order() {
    let numbers =
        DOCUMENT.lines().filter_map(|line| line.strip_prefix("- **R")?.split("**").next()?.parse().ok());
    let numbers: Vec<usize> = numbers.collect();
    assert!(numbers.len() > 40);
    assert!(numbers.iter().enumerate().all(|(place, &number)| number == place + 1), "{numbers:?}");
}

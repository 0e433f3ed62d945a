//! JSON Schemas (draft 2020-12) of `lightbots report --json` and of the lines of `lightbots replay --lines`.

use schemars::{Schema, schema_for};

use crate::lines::RunLine;
use crate::model::ShowReport;

/// The schemas with the names of their files.
pub fn schemas() -> [(&'static str, Schema); 2] {
    [("report.schema.json", schema_for!(ShowReport)), ("run-log.schema.json", schema_for!(RunLine))]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use lightbots_base::{Instant, Vec2};
    use lightbots_control::{Config, Controller, Operation, RecordedController};
    use lightbots_show::{Frame, Pixel, Show};

    use super::*;
    use crate::lines::run_lines;

    fn validator(nth: usize) -> jsonschema::Validator {
        jsonschema::validator_for(schemas()[nth].1.as_value()).unwrap()
    }

    #[test]
    fn the_schemas_in_the_docs_are_those_of_the_types() {
        for (name, schema) in schemas() {
            let file = format!("{}/../../docs/schemas/{name}", env!("CARGO_MANIFEST_DIR"));
            // As values: the order of fields depends on what else a build asks of `serde_json`.
            let kept: serde_json::Value =
                serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
            assert!(
                kept == *schema.as_value(),
                "{name}: `cargo run -p lightbots-report --example schema` writes it"
            );
        }
    }

    #[test]
    fn a_report_is_valid() {
        let report = serde_json::to_value(ShowReport::default()).unwrap();
        assert!(validator(0).is_valid(&report));
        assert!(!validator(0).is_valid(&serde_json::json!({ "ok": true })));
    }

    /// A robot reports, a show is opened, and the broker goes.
    fn log() -> Vec<u8> {
        let mut controller = RecordedController::new(Controller::new(Config::default()));
        assert!(controller.begin_log(Instant(1_000), vec![("command".into(), "test".into())]));
        controller.connected(Instant(2_000));
        controller.message(Instant(3_000), "T/LightBot/UUID", b"a 0.5 1.3");
        controller.message(Instant(4_000), "elsewhere", b"\xff");
        let pixels = vec![Pixel { at: Vec2::new(0.5, 0.5), ..Pixel::default() }];
        let show = Show { frames: vec![Frame { pixels, ..Frame::default() }], ..Show::default() };
        controller.operate(Instant(5_000), Operation::Open(Arc::new(show))).unwrap();
        controller.wake(Instant(2_000_000));
        while controller.next_send().is_some() {}
        while controller.next_event().is_some() {}
        while controller.next_plan_request().is_some() {}
        controller.disconnected(Instant(3_000_000));
        let mut log = controller.take_log();
        log.extend(controller.end_log());
        log
    }

    #[test]
    fn every_line_of_a_run_is_valid() {
        let (validator, mut lines) = (validator(1), Vec::new());
        run_lines(&log(), &mut |_| {}, &mut |line| lines.push(line.clone())).unwrap();
        for line in &lines {
            let value = serde_json::to_value(line).unwrap();
            assert!(validator.is_valid(&value), "{value}");
        }
        let came = |at: usize| matches!(&lines[at], RunLine::Message(message) if !message.payload.is_empty());
        assert!(matches!(&lines[0], RunLine::Input(note) if note.at_s == 0.002), "{lines:?}");
        assert!(came(1) && came(2), "{lines:?}");
        assert!(lines.iter().any(|line| matches!(line, RunLine::Sent(_))), "{lines:?}");
        assert!(lines.iter().any(|line| matches!(line, RunLine::Event(_))), "{lines:?}");
        assert!(matches!(lines.last(), Some(RunLine::End { is_same: true, .. })), "{lines:?}");
        assert!(!validator.is_valid(&serde_json::json!({ "of": "message", "at_s": 1 })));
    }
}

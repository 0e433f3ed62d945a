//! Checks that the TypeScript file is current, and that JSON messages fit its types.

use lightbots_api::{Answer, FromScreen, Missing, Operation, Request, RobotStatus, ToScreen, typescript};

#[test]
fn the_typescript_file_is_current() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../ui/src/api/types.gen.ts");
    let kept = std::fs::read_to_string(file).expect("ui/src/api/types.gen.ts is missing");
    assert!(kept == typescript(), "run `cargo run -p lightbots-api --example types`");
}

#[test]
fn no_number_becomes_a_bigint() {
    assert!(!typescript().contains("bigint"));
}

#[test]
fn requests_read_as_screens_write_them() {
    let text = r#"{"type":"operate","id":3,"operation":{"do":"play","from":1,"missing":"leave_out"}}"#;
    let operation = Operation::Play { from: 1, missing: Missing::LeaveOut };
    assert_eq!(
        serde_json::from_str::<FromScreen>(text).unwrap(),
        FromScreen::Operate(Request { id: 3, operation })
    );
    let without_user = r#"{"do":"connect","address":"embedded"}"#;
    assert!(serde_json::from_str::<Operation>(without_user).is_ok());
}

#[test]
fn answers_carry_their_type() {
    let answer = ToScreen::Answer(Answer { id: 9, ok: true, error: None, choice: None });
    assert_eq!(
        serde_json::to_string(&answer).unwrap(),
        r#"{"type":"answer","id":9,"ok":true,"error":null,"choice":null}"#
    );
}

#[test]
fn every_status_is_counted_once() {
    for (index, status) in RobotStatus::ALL.into_iter().enumerate() {
        assert_eq!(status as usize, index);
    }
}

//! Invalid payloads: R4, R15, R48.

use lightbots_base::Span;
use lightbots_wire::Topic;

use super::pilot::{ONCE, Pilot};
use super::step::Step;
use crate::session::Addressee;

/// Length of a payload that is one byte longer than a robot must read (R4).
const TOO_LONG: usize = 16 * 1024 + 1;

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.rule_if_silent.set(48);
    let alive = "a report when asked for one afterwards";
    for (what, payload) in payloads() {
        pilot.session.send_bytes(Addressee::Robot, payload);
        pilot.session.pause(Span::from_millis(200)).await;
        pilot.ask().await?;
        pilot.session.record(48, true, what, alive, "a report");
    }
    if pilot.can.route {
        dropped(pilot, "|UUID| and bytes that are no UTF-8", b"|UUID|\xff\xfe|".to_vec()).await;
        let mut long = b"|UUID|".to_vec();
        long.resize(TOO_LONG, b' ');
        dropped(pilot, "|UUID| in 16,385 bytes", long).await;
    }
    let received = pilot.ask().await?;
    pilot.session.record(15, true, "|UUID| in the end", "the name it had at first", received.name());
    Ok(())
}

fn payloads() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("an empty payload", Vec::new()),
        ("bars only", b"||||||||".to_vec()),
        ("bytes that are no UTF-8", vec![0xff, 0xfe, 0x00, b'|', 0xc3]),
        (
            "numbers out of all range",
            b"|TARGET||COLOR -1||COLOR 99999999999999999999||TARGET 1e999 x|".to_vec(),
        ),
        ("commands cut short", b"|TARG|COL|FADE|PATH 1|START|TIME 1|HOLD".to_vec()),
        ("a thousand unknown commands", b"|JUNK 1 2 3|".repeat(1000)),
        ("20,000 letters", vec![b'A'; 20_000]),
    ]
}

/// Tests that the robot ignores a payload as a whole although it holds a valid command.
async fn dropped(pilot: &Pilot, what: &str, payload: Vec<u8>) {
    let mark = pilot.session.mark();
    pilot.session.send_bytes(Addressee::Robot, payload);
    let answer =
        pilot.session.wait_for(mark, ONCE, |received| (received.topic == Topic::Uuid).then_some(())).await;
    let came = if answer.is_some() { "it executed UUID" } else { "nothing" };
    pilot.session.record(4, answer.is_none(), what, "nothing: it is dropped whole", came);
}

//! Live light: R59 by reports, R60 to R62 if a person watches the light.

use lightbots_base::{Rgb, Span};
use lightbots_wire::{Command, LiveColours, LiveRelease, Topic, encode};

use super::light::{LOOK_UP, ask, can_be_seen};
use super::pilot::{ANSWER, Pilot};
use crate::received::Received;
use crate::session::Addressee;
use crate::sight::Sight;

/// Red alone.
const RED: Rgb = Rgb::new(255, 0, 0);
/// Green alone.
const GREEN: Rgb = Rgb::new(0, 255, 0);
/// Blue alone.
const BLUE: Rgb = Rgb::new(0, 0, 255);
/// Slots that the robot is given one after the other: first the largest possible slot, then slot 100, which it keeps.
const SLOTS: [u16; 2] = [65_535, 100];
/// Base of the numbers of live-light messages. Each test adds a small number to it; messages that must count as old get
/// a smaller sum than messages before them.
const NUMBER: u32 = 1_000;
/// Time between two equal messages. A controller repeats messages in the same way (R63).
const AGAIN: Span = Span::from_millis(500);

/// Tests live light.
pub(super) async fn run(pilot: &Pilot) {
    if !pilot.can.live {
        return;
    }
    for slot in SLOTS {
        keeps(pilot, slot).await;
    }
    if pilot.session.is_broken(59) {
        return pilot.session.mark_untried(&[60, 61, 62], "it does not keep its slot");
    }
    if !can_be_seen(pilot) {
        return;
    }
    shows(pilot).await;
    if pilot.session.is_broken(60) {
        return pilot.session.mark_untried(&[61, 62], "it does not show live light");
    }
    is_released(pilot).await;
    falls_back(pilot).await;
    goes_on_beneath(pilot).await;
}

/// Tests that the robot reports its slot at once.
async fn keeps(pilot: &Pilot, slot: u16) {
    let sent = written(Command::Slot(slot));
    let expected = format!("slot={slot} on T/LightBot/Status");
    let mut is_kept = false;
    // Twice, because one message may be lost.
    for _ in 0..2 {
        let mark = pilot.send(&sent);
        let names = |received: &Received| {
            let named = received.whole("slot") == Some(u64::from(slot));
            (received.topic == Topic::Status && named).then_some(())
        };
        is_kept = is_kept || pilot.session.wait_for(mark, ANSWER, names).await.is_some();
    }
    pilot.session.record(59, is_kept, &sent, &expected, if is_kept { "it" } else { "no such report" });
}

/// Tests that the robot shows the newest colour of its slot. Colours of other slots and messages with lower numbers
/// must change nothing.
async fn shows(pilot: &Pilot) {
    pilot.send(format!("|COLOR {}|", BLUE.number()));
    pilot.session.pause(LOOK_UP).await;
    let [_, slot] = SLOTS;
    let begin = pilot.session.now();
    let sent = live(NUMBER + 10, slot - 1, &[GREEN, RED, GREEN]);
    let others = live(NUMBER + 20, slot + 1, &[GREEN; 69]) + &live(NUMBER + 20, 0, &[GREEN; 100]);
    let old = live(NUMBER, slot, &[GREEN]);
    repeat(pilot, &sent, 2).await;
    repeat(pilot, &(others + &old), 2).await;
    let until = pilot.session.now();
    repeat(pilot, &live(NUMBER + 11, slot - 100, &[GREEN; 170]), 2).await;
    let sights = vec![
        Sight::Colour { at: begin + AGAIN, colour: RED },
        Sight::Colour { at: until, colour: RED },
        Sight::Colour { at: pilot.session.now(), colour: GREEN },
    ];
    let text = "Was the light red for about two seconds, and is it green now?";
    ask(pilot, 60, &sent, text, "red for two seconds, then green", sights).await;
}

/// Tests that `RELEASE` of the robot's slot ends live light, and that `RELEASE` of other slots does not.
async fn is_released(pilot: &Pilot) {
    let [_, slot] = SLOTS;
    pilot.session.pause(LOOK_UP).await;
    let begin = pilot.session.now();
    repeat(pilot, &live(NUMBER + 30, slot, &[RED]), 2).await;
    let release = |number: u32, first: u16, count: u16| {
        written(Command::Release(LiveRelease { number: NUMBER + number, first, count }))
    };
    repeat(pilot, &(release(31, 0, slot) + &release(31, slot + 1, 65_535) + &release(29, slot, 1)), 2).await;
    let until = pilot.session.now();
    let sent = release(32, slot - 1, 2);
    repeat(pilot, &sent, 1).await;
    let sights = vec![
        Sight::Colour { at: begin + AGAIN, colour: RED },
        Sight::Colour { at: until, colour: RED },
        Sight::Colour { at: pilot.session.now(), colour: BLUE },
    ];
    let text = "Was the light red for about two seconds, and is it blue now?";
    ask(pilot, 61, &sent, text, "red for two seconds, then blue", sights).await;
}

/// Tests that live light ends 2.5 s after the last message.
async fn falls_back(pilot: &Pilot) {
    let [_, slot] = SLOTS;
    pilot.session.pause(LOOK_UP).await;
    let sent = live(NUMBER + 40, slot, &[RED]);
    repeat(pilot, &sent, 2).await;
    pilot.session.pause(Span::from_millis(1_700)).await;
    let until = pilot.session.now();
    pilot.session.pause(Span::from_millis(600)).await;
    let sights = vec![
        Sight::Colour { at: until, colour: RED },
        Sight::Colour { at: pilot.session.now(), colour: BLUE },
    ];
    let text = "Was the light red for about three seconds, and is it blue now?";
    ask(pilot, 61, &sent, text, "red for three seconds, then blue", sights).await;
}

/// Tests that the robot shows a `COLOR` that it received during live light after live light has ended.
async fn goes_on_beneath(pilot: &Pilot) {
    let [_, slot] = SLOTS;
    pilot.session.pause(LOOK_UP).await;
    let sent = live(NUMBER + 50, slot, &[RED]);
    repeat(pilot, &sent, 2).await;
    let sent = format!("{sent}|COLOR {}|", GREEN.number());
    repeat(pilot, &sent, 2).await;
    let until = pilot.session.now();
    repeat(pilot, &written(Command::Release(LiveRelease { number: NUMBER + 51, first: slot, count: 1 })), 1)
        .await;
    let sights = vec![
        Sight::Colour { at: until, colour: RED },
        Sight::Colour { at: pilot.session.now(), colour: GREEN },
    ];
    let text = "Was the light red for about two seconds, and is it green now?";
    ask(pilot, 62, &sent, text, "red for two seconds, then green", sights).await;
}

/// Sends a payload to all robots `times` times, once every `AGAIN`, because one message may be lost.
async fn repeat(pilot: &Pilot, payload: &str, times: u32) {
    for _ in 0..times {
        pilot.session.send(Addressee::AllRobots, payload);
        pilot.session.pause(AGAIN).await;
    }
}

fn live(number: u32, first: u16, colours: &[Rgb]) -> String {
    written(Command::Live(LiveColours { number, first, colours: colours.iter().copied().collect() }))
}

fn written(command: Command) -> String {
    let mut text = String::new();
    // Writing to a text cannot fail.
    let _ = encode(&command, &mut text);
    text
}

//! Stretches of light, which are sent ahead of time: R55 by reports, R56 to R58 if a person watches the light.

use lightbots_base::{Instant, LightRecord, Rgb, Span};
use lightbots_wire::{Command, LightAnchor, LightRecords, LightStretch, Topic, encode};

use super::light::{LOOK_UP, ask, before, can_be_seen};
use super::pilot::{ANSWER, Pilot};
use crate::received::Received;
use crate::sight::Sight;

/// Red alone.
const RED: Rgb = Rgb::new(255, 0, 0);
/// Green alone.
const GREEN: Rgb = Rgb::new(0, 255, 0);
/// Blue alone.
const BLUE: Rgb = Rgb::new(0, 0, 255);
/// A stretch that begins this long after it was sent never plays, because the exam is over before.
const NEVER: Span = Span::from_millis(3_000_000);

/// Tests stretches of light. The robot must be synchronised with the show clock.
pub(super) async fn run(pilot: &Pilot) {
    if !pilot.can.light {
        return;
    }
    let known = pilot.ask().await.ok().and_then(|report| report.whole("light")).unwrap_or(0) as u32;
    let number = known.wrapping_add(1000).max(1000);
    keeps(pilot, number).await;
    if !can_be_seen(pilot) || pilot.session.is_broken(55) {
        return;
    }
    plays(pilot, number + 100).await;
    stands_in_a_hold(pilot, number + 200).await;
    forgets(pilot, number + 300).await;
}

fn stretch(number: u32, at: Instant, records: &[LightRecord]) -> String {
    let records = LightRecords::from_slice(records).unwrap_or_default();
    let anchor = LightAnchor::Moment(at);
    let light = LightStretch { number, anchor, skip: Span::ZERO, over: Span::ZERO, start: RED, records };
    let mut text = String::new();
    // Writing to a text cannot fail.
    let _ = encode(&Command::Light(light), &mut text);
    text
}

/// Tests that the robot reports the number of a stretch at once. After a stretch with a lower number it must still
/// report the highest number.
async fn keeps(pilot: &Pilot, number: u32) {
    let at = pilot.session.show() + NEVER;
    for sent_number in [number, number - 5] {
        let sent = stretch(sent_number, at, &[LightRecord::Step { ticks: 1, to: BLUE }]);
        let expected = format!("light={number} on T/LightBot/Status");
        let mut is_kept = false;
        // Twice, because one message may be lost.
        for _ in 0..2 {
            let mark = pilot.send(&sent);
            let kept = |received: &Received| {
                let named = received.whole("light") == Some(u64::from(number));
                (received.topic == Topic::Status && named).then_some(())
            };
            is_kept = is_kept || pilot.session.wait_for(mark, ANSWER, kept).await.is_some();
        }
        let came = if is_kept { "it" } else { "no such report" };
        pilot.session.record(55, is_kept, &sent, &expected, came);
    }
    pilot.send("|STOP|");
}

/// Tests that the robot plays a step, a line and a repeat of a stretch from the stretch's moment on.
async fn plays(pilot: &Pilot, number: u32) {
    let begin = pilot.session.now() + LOOK_UP;
    let records = [
        LightRecord::Step { ticks: 100, to: GREEN },
        LightRecord::Line { ticks: 200, to: BLUE },
        LightRecord::Repeat { records: 2, times: 1 },
    ];
    let sent = stretch(number, begin + pilot.session.shift(), &records);
    pilot.send(format!("|COLOR {}|{sent}", BLUE.number()));
    pilot.session.pause(LOOK_UP + Span::from_millis(6_500)).await;
    let at = |ms: i64| begin + Span::from_millis(ms);
    let sights = vec![
        Sight::Colour { at: before(begin, 300), colour: BLUE },
        Sight::Colour { at: at(500), colour: RED },
        Sight::Colour { at: at(2_000), colour: GREEN.mixed(BLUE, 0.5) },
        Sight::Colour { at: at(3_500), colour: BLUE },
        Sight::Colour { at: at(5_000), colour: GREEN.mixed(BLUE, 0.5) },
        Sight::Colour { at: pilot.session.now(), colour: BLUE },
    ];
    let text = "Was the light blue, then red, then green and evenly blue, and the last two once more?";
    ask(pilot, 57, &sent, text, "red, green to blue, green to blue", sights).await;
}

/// Tests that the time of a stretch stands still while routes are held.
async fn stands_in_a_hold(pilot: &Pilot, number: u32) {
    let begin = pilot.session.now() + LOOK_UP;
    let shift = pilot.session.shift();
    let sent = stretch(number, begin + shift, &[LightRecord::Step { ticks: 200, to: GREEN }]);
    let hold = (begin + Span::from_millis(1_000) + shift).0;
    let resume = (begin + Span::from_millis(5_000) + shift).0;
    pilot.send(format!("{sent}|HOLD {hold}||RESUME {resume}|"));
    pilot.session.pause(LOOK_UP + Span::from_millis(7_000)).await;
    let sights = vec![
        Sight::Colour { at: begin + Span::from_millis(4_500), colour: RED },
        Sight::Colour { at: pilot.session.now(), colour: GREEN },
    ];
    let text = "Was the light red for about six seconds, and is it green now?";
    ask(pilot, 56, &sent, text, "red for six seconds, then green", sights).await;
}

/// Tests that `STOP` deletes a stretch that has not begun.
async fn forgets(pilot: &Pilot, number: u32) {
    let at = pilot.session.show() + LOOK_UP;
    let sent = stretch(number, at, &[LightRecord::Step { ticks: 10, to: GREEN }]);
    let sent = format!("|COLOR {}|{sent}|STOP|", BLUE.number());
    pilot.send(&sent);
    pilot.session.pause(LOOK_UP + Span::from_millis(700)).await;
    let sights = vec![Sight::Colour { at: pilot.session.now(), colour: BLUE }];
    ask(pilot, 58, &sent, "Has the light stayed blue?", "blue", sights).await;
}

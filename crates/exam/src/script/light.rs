//! What the light shows, where somebody looks: R21 to R24.

use lightbots_base::{Instant, Rgb, Span};

use super::pilot::Pilot;
use crate::sight::{Question, Sight};

const UNSEEN: &str = "nobody looked at its light: --look asks you";
const RED: Rgb = Rgb::new(255, 0, 0);
const GREEN: Rgb = Rgb::new(0, 255, 0);
const BLUE: Rgb = Rgb::new(0, 0, 255);
/// People need this long to look up.
const LOOK_UP: Span = Span::from_millis(3_000);

/// Plain colours.
pub(super) async fn colours(pilot: &Pilot) {
    if !pilot.desk.options.looks {
        return pilot.desk.excuse(&[21, 22, 23, 24], UNSEEN);
    }
    for (colour, name) in [(RED, "red"), (GREEN, "green"), (BLUE, "blue")] {
        let sent = format!("|COLOR {}|", colour.number());
        pilot.say(&sent);
        pilot.desk.pause(Span::from_millis(500)).await;
        let sights = vec![Sight::Colour { at: pilot.desk.now(), colour }];
        ask(pilot, 21, &sent, &format!("Is the light {name}?"), name, sights).await;
    }
    if pilot.desk.is_broken(21) {
        pilot.desk.excuse(&[22, 23, 24], "its colours are wrong");
    }
}

/// Fades, once the clock is known.
pub(super) async fn fades(pilot: &Pilot) {
    if !can_be_seen(pilot) || !pilot.can.fade {
        return;
    }
    let begin = pilot.desk.now() + LOOK_UP;
    let at = (begin + pilot.desk.shift()).0;
    let sent = format!("|COLOR {}||FADE {} {at} 2000000|", RED.number(), BLUE.number());
    pilot.say(&sent);
    pilot.desk.pause(LOOK_UP + Span::from_millis(2_500)).await;
    let sights = vec![
        Sight::Colour { at: before(begin, 300), colour: RED },
        Sight::Colour { at: begin + Span::from_millis(1_000), colour: RED.mixed(BLUE, 0.5) },
        Sight::Colour { at: pilot.desk.now(), colour: BLUE },
    ];
    let text = "Was the light red, and did it then change evenly to blue within two seconds?";
    ask(pilot, 22, &sent, text, "red, then evenly to blue", sights).await;
    forgotten(pilot).await;
}

/// A fade that waits is forgotten at STOP.
async fn forgotten(pilot: &Pilot) {
    let at = (pilot.desk.show() + LOOK_UP).0;
    let sent = format!("|COLOR {}||FADE {} {at} 0||STOP|", BLUE.number(), GREEN.number());
    pilot.say(&sent);
    pilot.desk.pause(LOOK_UP + Span::from_millis(700)).await;
    let sights = vec![Sight::Colour { at: pilot.desk.now(), colour: BLUE }];
    ask(pilot, 23, &sent, "Has the light stayed blue?", "blue", sights).await;
}

/// Flashing to be found.
pub(super) async fn blink(pilot: &Pilot) {
    if !can_be_seen(pilot) || !pilot.can.blink {
        return;
    }
    let sent = format!("|COLOR {}||BLINK 4000000|", BLUE.number());
    pilot.say(&sent);
    let from = pilot.desk.now() + Span::from_millis(300);
    pilot.desk.pause(Span::from_millis(5_000)).await;
    let to = from + Span::from_millis(3_000);
    let sights = vec![Sight::Flashing { from, to }, Sight::Colour { at: pilot.desk.now(), colour: BLUE }];
    let text = "Did the light flash white for four seconds, and is it blue now?";
    ask(pilot, 24, &sent, text, "white flashes, then blue", sights).await;
}

/// Whether somebody looks, and colours are what they should be.
fn can_be_seen(pilot: &Pilot) -> bool {
    pilot.desk.options.looks && !pilot.desk.is_broken(21)
}

async fn ask(pilot: &Pilot, rule: u8, sent: &str, text: &str, expected: &str, sights: Vec<Sight>) {
    match pilot.desk.look(Question { text: text.into(), sights }).await {
        Some(yes) => {
            let came = if yes { expected.to_owned() } else { format!("not {expected}") };
            pilot.desk.judge(rule, yes, sent, expected, came);
        }
        None => pilot.desk.excuse(&[rule], "nobody could tell what its light showed"),
    }
}

fn before(at: Instant, millis: u64) -> Instant {
    Instant(at.0.saturating_sub(millis * 1000))
}

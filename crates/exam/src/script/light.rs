//! The light, if a person watches it: R21 to R24.

use lightbots_base::{Instant, Rgb, Span};

use super::pilot::Pilot;
use crate::sight::{Question, Sight};

/// Why rules about the light were not tried.
const UNSEEN: &str = "the light was not watched; --look asks you about it";
/// Red alone. The tests use one channel at a time, because swapped channels then show.
const RED: Rgb = Rgb::new(255, 0, 0);
/// Green alone, as in `RED`.
const GREEN: Rgb = Rgb::new(0, 255, 0);
/// Blue alone, as in `RED`.
const BLUE: Rgb = Rgb::new(0, 0, 255);
/// Time that a person has to look up before a test begins. With less, the person would miss the beginning. Chosen, not
/// measured.
pub(super) const LOOK_UP: Span = Span::from_millis(3_000);

/// Tests plain colours: red, green and blue.
pub(super) async fn colours(pilot: &Pilot) {
    if !pilot.session.options.looks {
        return pilot.session.mark_untried(&[21, 22, 23, 24, 56, 57, 58, 60, 61, 62], UNSEEN);
    }
    for (colour, name) in [(RED, "red"), (GREEN, "green"), (BLUE, "blue")] {
        let sent = format!("|COLOR {}|", colour.number());
        pilot.send(&sent);
        pilot.session.pause(Span::from_millis(500)).await;
        let sights = vec![Sight::Colour { at: pilot.session.now(), colour }];
        ask(pilot, 21, &sent, &format!("Is the light {name}?"), name, sights).await;
    }
    if pilot.session.is_broken(21) {
        pilot.session.mark_untried(&[22, 23, 24, 56, 57, 58, 60, 61, 62], "its colours are wrong");
    }
}

/// Tests fades. The robot must be synchronised with the show clock.
pub(super) async fn fades(pilot: &Pilot) {
    if !can_be_seen(pilot) || !pilot.can.fade {
        return;
    }
    let begin = pilot.session.now() + LOOK_UP;
    let at = (begin + pilot.session.shift()).0;
    let sent = format!("|COLOR {}||FADE {} {at} 2000000|", RED.number(), BLUE.number());
    pilot.send(&sent);
    pilot.session.pause(LOOK_UP + Span::from_millis(2_500)).await;
    let sights = vec![
        Sight::Colour { at: before(begin, 300), colour: RED },
        Sight::Colour { at: begin + Span::from_millis(1_000), colour: RED.mixed(BLUE, 0.5) },
        Sight::Colour { at: pilot.session.now(), colour: BLUE },
    ];
    let text = "Was the light red, and did it then change evenly to blue within two seconds?";
    ask(pilot, 22, &sent, text, "red, then evenly to blue", sights).await;
    forgotten(pilot).await;
}

/// Tests that `STOP` deletes a waiting fade.
async fn forgotten(pilot: &Pilot) {
    let at = (pilot.session.show() + LOOK_UP).0;
    let sent = format!("|COLOR {}||FADE {} {at} 0||STOP|", BLUE.number(), GREEN.number());
    pilot.send(&sent);
    pilot.session.pause(LOOK_UP + Span::from_millis(700)).await;
    let sights = vec![Sight::Colour { at: pilot.session.now(), colour: BLUE }];
    ask(pilot, 23, &sent, "Has the light stayed blue?", "blue", sights).await;
}

/// Tests `BLINK`.
pub(super) async fn blink(pilot: &Pilot) {
    if !can_be_seen(pilot) || !pilot.can.blink {
        return;
    }
    let sent = format!("|COLOR {}||BLINK 4000000|", BLUE.number());
    pilot.send(&sent);
    let from = pilot.session.now() + Span::from_millis(300);
    pilot.session.pause(Span::from_millis(5_000)).await;
    let to = from + Span::from_millis(3_000);
    let sights = vec![Sight::Flashing { from, to }, Sight::Colour { at: pilot.session.now(), colour: BLUE }];
    let text = "Did the light flash white for four seconds, and is it blue now?";
    ask(pilot, 24, &sent, text, "white flashes, then blue", sights).await;
}

/// Whether a person watches the light, and the robot shows plain colours correctly.
pub(super) fn can_be_seen(pilot: &Pilot) -> bool {
    pilot.session.options.looks && !pilot.session.is_broken(21)
}

pub(super) async fn ask(pilot: &Pilot, rule: u8, sent: &str, text: &str, expected: &str, sights: Vec<Sight>) {
    match pilot.session.ask_person(Question { text: text.into(), sights }).await {
        Some(yes) => {
            let came = if yes { expected.to_owned() } else { format!("not {expected}") };
            pilot.session.record(rule, yes, sent, expected, came);
        }
        None => pilot.session.mark_untried(&[rule], "nobody could tell what the light showed"),
    }
}

pub(super) fn before(at: Instant, millis: u64) -> Instant {
    Instant(at.0.saturating_sub(millis * 1000))
}

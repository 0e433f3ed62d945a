//! How payloads are split and read: R4, R6, R7.

use lightbots_base::Span;
use lightbots_wire::Topic;

use super::Step;
use super::pilot::{ANSWER, ONCE, Pilot};

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.blame.set(6);
    answers(pilot, 6, "|| UUID |||", true).await?;
    answers(pilot, 6, "UUID", true).await?;
    answers(pilot, 6, "|uuid|", false).await?;
    pilot.blame.set(7);
    answers(pilot, 7, "|JUMP 1||UUID and more|", true).await?;
    counts_unknown(pilot).await?;
    reports_are_text(pilot);
    Ok(())
}

/// Whether `UUID` within a payload is answered as it should be.
pub(super) async fn answers(pilot: &Pilot, rule: u8, sent: &str, wanted: bool) -> Step {
    let mark = pilot.say(sent);
    let patience = if wanted { ANSWER } else { ONCE };
    let got = pilot.desk.wait_for(mark, patience, |heard| (heard.topic == Topic::Uuid).then_some(())).await;
    let words = |answer: bool| if answer { "a report on T/LightBot/UUID" } else { "nothing" };
    if got.is_some() != wanted && pilot.desk.is_broken(13) {
        return Ok(());
    }
    pilot.desk.judge(rule, got.is_some() == wanted, sent, words(wanted), words(got.is_some()));
    pilot.ask().await.map(|_| ())
}

/// Senseless commands are counted, and nothing else happens.
async fn counts_unknown(pilot: &Pilot) -> Step {
    let sent = "|TARGET 1||TARGET left right||COLOR 16777216||COLOR red|";
    let before = pilot.ask().await?;
    pilot.say(sent);
    pilot.desk.pause(Span::from_millis(700)).await;
    let after = pilot.ask().await?;
    if let (Some(from), Some(to)) = (before.place(), after.place()) {
        let moved_m = from.distance(to);
        let came = format!("it moved by {moved_m:.3} m");
        pilot.desk.judge(7, moved_m <= super::pilot::STILL_M, sent, "it stays where it is", came);
    }
    if pilot.can.route {
        let count = |heard: &crate::heard::Heard| heard.whole("unknown").unwrap_or(0);
        let grown = count(&after).saturating_sub(count(&before));
        pilot.desk.judge(7, grown == 4, sent, "unknown= grows by 4", format!("it grew by {grown}"));
    }
    Ok(())
}

/// Everything it has said so far.
fn reports_are_text(pilot: &Pilot) {
    let wrong = pilot
        .desk
        .since(0, |heard| heard.iter().find(|heard| !heard.is_proper).map(|heard| heard.text.clone()));
    let came = wrong.clone().unwrap_or_else(|| "nothing else".into());
    pilot.desk.judge(4, wrong.is_none(), "all of the above", "UTF-8 of at most 1,024 bytes", came);
}

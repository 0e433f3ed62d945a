//! How the robot splits and reads payloads: R4, R6, R7.

use lightbots_base::Span;
use lightbots_wire::Topic;

use super::pilot::{ANSWER, ONCE, Pilot};
use super::step::Step;

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.rule_if_silent.set(6);
    answers(pilot, 6, "|| UUID |||", true).await?;
    answers(pilot, 6, "UUID", true).await?;
    answers(pilot, 6, "|uuid|", false).await?;
    pilot.rule_if_silent.set(7);
    answers(pilot, 7, "|JUMP 1||UUID and more|", true).await?;
    counts_unknown(pilot).await?;
    reports_are_text(pilot);
    Ok(())
}

/// Tests whether the robot finds the command `UUID` in the payload `sent`. `wanted`: whether it must answer.
pub(super) async fn answers(pilot: &Pilot, rule: u8, sent: &str, wanted: bool) -> Step {
    let mark = pilot.send(sent);
    let patience = if wanted { ANSWER } else { ONCE };
    let got = pilot
        .session
        .wait_for(mark, patience, |received| (received.topic == Topic::Uuid).then_some(()))
        .await;
    let words = |answer: bool| if answer { "a report on T/LightBot/UUID" } else { "nothing" };
    if got.is_some() != wanted && pilot.session.is_broken(13) {
        return Ok(());
    }
    pilot.session.record(rule, got.is_some() == wanted, sent, words(wanted), words(got.is_some()));
    pilot.ask().await.map(|_| ())
}

/// Tests that invalid commands do not move the robot. For a robot with routes, also tests that it counts them in
/// `unknown=`.
async fn counts_unknown(pilot: &Pilot) -> Step {
    let sent = "|TARGET 1||TARGET left right||COLOR 16777216||COLOR red|";
    let before = pilot.ask().await?;
    pilot.send(sent);
    pilot.session.pause(Span::from_millis(700)).await;
    let after = pilot.ask().await?;
    if let (Some(from), Some(to)) = (before.place(), after.place()) {
        let moved_m = from.distance(to);
        let came = format!("it moved by {moved_m:.3} m");
        pilot.session.record(7, moved_m <= super::pilot::STILL_M, sent, "it stays where it is", came);
    }
    if pilot.can.route {
        let count = |received: &crate::received::Received| received.whole("unknown").unwrap_or(0);
        let grown = count(&after).saturating_sub(count(&before));
        pilot.session.record(7, grown == 4, sent, "unknown= grows by 4", format!("it grew by {grown}"));
    }
    Ok(())
}

/// Tests that all messages from the robot are UTF-8 of allowed length.
fn reports_are_text(pilot: &Pilot) {
    let wrong = pilot.session.since(0, |received| {
        received.iter().find(|received| !received.is_proper).map(|received| received.text.clone())
    });
    let came = wrong.clone().unwrap_or_else(|| "nothing else".into());
    pilot.session.record(4, wrong.is_none(), "all of the above", "UTF-8 of at most 1,024 bytes", came);
}

//! A controller that falls silent during a route: R43, R45.

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use super::pilot::{Pilot, STILL_M};
use super::routes::{LEAD, keep, next_seq, start};
use super::step::Step;
use super::timed_route::straight;
use crate::received::Received;
use crate::session::{Addressee, TimeAnswers};

/// Speed of the route, m/s. 0.3 m then take 7.5 s, longer than the silence.
const SLOW_MPS: f64 = 0.04;

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.rule_if_silent.set(43);
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SLOW_MPS);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let starts = pilot.session.show() + LEAD;
    start(pilot, Addressee::Robot, route.seq, starts).await;
    pilot.session.pause(starts - pilot.session.show() + Span::from_millis(1_500)).await;
    pilot.ask().await?;
    pilot.session.set_time_answers(TimeAnswers::None);
    let (mark, began) = (pilot.session.mark(), pilot.session.now());
    pilot.session.pause(Span::from_millis(3_500)).await;
    asks_in_silence(pilot, mark, began);
    let cut = pilot.session.since(mark, |received| {
        received.iter().find(|received| is_cut(received)).map(|received| received.at)
    });
    pilot.session.set_time_answers(TimeAnswers::All);
    let first = pilot.place().await?;
    pilot.session.pause(Span::from_millis(800)).await;
    let second = pilot.ask().await?;
    // A driving robot would have moved 32 mm meanwhile.
    let stands = second.place().is_some_and(|at| at.distance(first) <= STILL_M);
    record_cut(pilot, cut.map(|at| at - began), stands);
    let state = second.field("state").unwrap_or("").to_owned();
    pilot.send("|STOP|");
    pilot.rule_if_silent.set(45);
    let trip = pilot.drive_to(pilot.home).await?;
    if cut.is_some() {
        record_free(pilot, &state, trip.reached);
    }
    Ok(())
}

/// Records R43. `cut_after`: time from the beginning of the silence to `state=cut`; `None`: it was not reported.
/// `stands`: whether the robot stands afterwards.
fn record_cut(pilot: &Pilot, cut_after: Option<Span>, stands: bool) {
    let in_time = cut_after.is_some_and(|after| (1.0..=3.2).contains(&after.as_secs()));
    let cut = cut_after.map_or_else(
        || "no state=cut within 3.5 s".into(),
        |after| format!("state=cut after {:.1} s", after.as_secs()),
    );
    let came = format!("{cut}; {}", if stands { "it stands" } else { "it drives on" });
    let sent = "a route, then nothing for 3.5 s";
    pilot.session.record(43, in_time && stands, sent, "state=cut within 2.2 s, and it stands", came);
}

/// Records R45. `state`: the robot's state after the first message that follows the silence. `drives`: whether it then
/// reached a target.
fn record_free(pilot: &Pilot, state: &str, drives: bool) {
    let came = format!("state={state}, and it {}", if drives { "drives" } else { "does not drive" });
    let sent = "a message after the silence, then TARGET";
    pilot.session.record(45, state != "cut" && drives, sent, "it is free and drives", came);
}

fn is_cut(received: &Received) -> bool {
    received.topic == Topic::Status && received.field("state") == Some("cut")
}

/// Tests that the robot asks for the time while no message comes: at least three times from 0.9 to 2.2 s after `began`,
/// the moment when the silence began.
fn asks_in_silence(pilot: &Pilot, mark: usize, began: Instant) {
    let count = pilot.session.since(mark, |received| {
        let asked = received
            .iter()
            .filter(|received| received.question.is_some())
            .map(|received| (received.at - began).as_secs());
        asked.filter(|after| (0.9..=2.2).contains(after)).count()
    });
    let came = format!("{count} questions in the second second");
    pilot.session.record(
        43,
        count >= 3,
        "a route, then nothing",
        "time questions each 0.15 s after 1 s",
        came,
    );
}

//! A controller that falls silent during a route: R43, R45.

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use super::pilot::{Pilot, STILL_M};
use super::routes::{LEAD, keep, next_seq, start};
use super::step::Step;
use super::timed_route::straight;
use crate::received::Received;
use crate::session::{Addressee, TimeAnswers};

/// Speed of the route, m/s: 0.3 m then take 7.5 s, longer than the silence.
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
    // At 0.04 m/s it would have driven 32 mm meanwhile.
    let stands = second.place().is_some_and(|at| at.distance(first) <= STILL_M);
    let came = match cut {
        Some(at) => format!("state=cut after {:.1} s", (at - began).as_secs()),
        None => "no state=cut within 3.5 s".into(),
    };
    let in_time = cut.is_some_and(|at| (1.0..=3.2).contains(&(at - began).as_secs()));
    let came = format!("{came}; {}", if stands { "it stands" } else { "it drives on" });
    pilot.session.record(
        43,
        in_time && stands,
        "a route, then nothing for 3.5 s",
        "state=cut after 2 s, and it stands",
        came,
    );
    let state = second.field("state").unwrap_or("").to_owned();
    pilot.send("|STOP|");
    pilot.rule_if_silent.set(45);
    let trip = pilot.drive_to(pilot.home).await?;
    if cut.is_some() {
        let free = state != "cut" && trip.reached;
        let came = format!(
            "state={state}, {}",
            if trip.reached { "and it drives" } else { "and it does not drive" }
        );
        pilot.session.record(
            45,
            free,
            "a message after the silence, then TARGET",
            "it is free and drives",
            came,
        );
    }
    Ok(())
}

fn is_cut(received: &Received) -> bool {
    received.topic == Topic::Status && received.field("state") == Some("cut")
}

/// Tests that the robot asks for the time during silence.
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

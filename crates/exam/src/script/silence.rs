//! A controller that falls silent on the way: R43, R45.

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use super::Step;
use super::course::straight;
use super::pilot::{Pilot, STILL_M};
use super::routes::{LEAD, keep, next_seq, start};
use crate::desk::{Duty, To};
use crate::heard::Heard;

/// So slow that the route outlasts the silence.
const SLOW_MPS: f64 = 0.04;

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.blame.set(43);
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SLOW_MPS);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let starts = pilot.desk.show() + LEAD;
    start(pilot, To::Robot, route.seq, starts).await;
    pilot.desk.pause(starts - pilot.desk.show() + Span::from_millis(1_500)).await;
    pilot.ask().await?;
    pilot.desk.set_duty(Duty::Silent);
    let (mark, began) = (pilot.desk.mark(), pilot.desk.now());
    pilot.desk.pause(Span::from_millis(3_500)).await;
    asks_in_silence(pilot, mark, began);
    let cut = pilot.desk.since(mark, |heard| heard.iter().find(|heard| is_cut(heard)).map(|heard| heard.at));
    pilot.desk.set_duty(Duty::Answer);
    let first = pilot.place().await?;
    pilot.desk.pause(Span::from_millis(800)).await;
    let second = pilot.ask().await?;
    // At 0.04 m/s it would have driven 32 mm meanwhile.
    let stands = second.place().is_some_and(|at| at.distance(first) <= STILL_M);
    let came = match cut {
        Some(at) => format!("state=cut after {:.1} s", (at - began).as_secs()),
        None => "no state=cut within 3.5 s".into(),
    };
    let in_time = cut.is_some_and(|at| (1.0..=3.2).contains(&(at - began).as_secs()));
    let came = format!("{came}; {}", if stands { "it stands" } else { "it drives on" });
    pilot.desk.judge(
        43,
        in_time && stands,
        "a route, then nothing for 3.5 s",
        "state=cut after 2 s, and it stands",
        came,
    );
    let state = second.field("state").unwrap_or("").to_owned();
    pilot.say("|STOP|");
    pilot.blame.set(45);
    let trip = pilot.bring(pilot.home).await?;
    if cut.is_some() {
        let free = state != "cut" && trip.reached;
        let came = format!(
            "state={state}, {}",
            if trip.reached { "and it drives" } else { "and it does not drive" }
        );
        pilot.desk.judge(45, free, "a message after the silence, then TARGET", "it is free and drives", came);
    }
    Ok(())
}

fn is_cut(heard: &Heard) -> bool {
    heard.topic == Topic::Status && heard.field("state") == Some("cut")
}

/// It breaks the silence with time questions.
fn asks_in_silence(pilot: &Pilot, mark: usize, began: Instant) {
    let count = pilot.desk.since(mark, |heard| {
        let asked =
            heard.iter().filter(|heard| heard.question.is_some()).map(|heard| (heard.at - began).as_secs());
        asked.filter(|after| (0.9..=2.2).contains(after)).count()
    });
    let came = format!("{count} questions in the second second");
    pilot.desk.judge(43, count >= 3, "a route, then nothing", "time questions each 0.15 s after 1 s", came);
}

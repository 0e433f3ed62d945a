//! Drives to targets: R8, R16 to R20.

use lightbots_base::{Span, Vec2};
use lightbots_wire::Topic;

use super::greeting::seconds;
use super::pilot::{ANSWER, ONCE, Pilot, THERE_M, Trip, shown, target, within};
use super::step::Step;
use crate::received::Received;

/// Highest allowed measured speed, m/s: the limit of R20 and 5 % for unequal wheels.
const SPEED_MPS: f64 = 0.27 * 1.05;
/// Longest time for a drive of 0.3 m with a turn. Chosen so that slow robots pass: 0.02 m/s is enough.
const DRIVE: Span = Span::from_millis(15_000);

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.rule_if_silent.set(16);
    reach(pilot).await?;
    again(pilot).await?;
    decimals(pilot).await?;
    replaced(pilot).await?;
    no_place(pilot).await?;
    pilot.drive_to(pilot.home).await?;
    Ok(())
}

/// The reports of arrival since a mark.
pub(super) fn arrivals(pilot: &Pilot, mark: usize) -> Vec<Received> {
    pilot.session.since(mark, |received| {
        received.iter().filter(|received| received.topic == Topic::Arrival).cloned().collect()
    })
}

async fn await_arrival(pilot: &Pilot, mark: usize) -> Option<Received> {
    pilot
        .session
        .wait_for(mark, ANSWER, |received| (received.topic == Topic::Arrival).then(|| received.clone()))
        .await
}

/// Tests one drive to a target.
async fn reach(pilot: &Pilot) -> Step {
    let (goal, sent) = (pilot.away, target(pilot.away));
    let began = pilot.session.now();
    let mark = pilot.send(&sent);
    let trip = pilot.watch(goal, DRIVE).await?;
    stands_there(pilot, &trip, goal, &sent);
    let arrival = await_arrival(pilot, mark).await;
    pilot.session.pause(ONCE).await;
    let count = arrivals(pilot, mark).len();
    pilot.session.record(18, count == 1, &sent, "one report on T/LightBot/Arrival", format!("{count}"));
    if let Some(arrival) = arrival {
        let at = arrival.place();
        let fits = at.is_some_and(|at| within(at, goal, THERE_M));
        let place = at.map_or_else(|| "no place".into(), shown);
        let came = format!("an Arrival at {place} after {:.2} s", seconds(began, arrival.at));
        pilot.session.record(17, fits, &sent, &format!("an Arrival within 0.02 m of {}", shown(goal)), came);
    }
    let fastest = trip.fastest_mps();
    let came = format!("{fastest:.2} m/s over 0.4 s");
    pilot.session.record(20, fastest <= SPEED_MPS, &sent, "at most 0.27 m/s", came);
    Ok(())
}

fn stands_there(pilot: &Pilot, trip: &Trip, goal: Vec2, sent: &str) {
    let last = trip.places.last().map_or_else(|| "nowhere".into(), |(_, at)| shown(*at));
    let came =
        if trip.reached { format!("it stands at {last}") } else { format!("after 15 s it is at {last}") };
    pilot.session.record(
        17,
        trip.reached,
        sent,
        &format!("it stands within 0.02 m of {}", shown(goal)),
        came,
    );
}

/// Tests that the robot reports an arrival again if it is sent to the target where it stands.
async fn again(pilot: &Pilot) -> Step {
    let sent = target(pilot.away);
    let mark = pilot.send(&sent);
    // If an arrival is already missing, this test shows nothing new.
    if !pilot.session.is_broken(18) {
        let came = await_arrival(pilot, mark).await.is_some();
        let words = if came { "an Arrival" } else { "none" };
        pilot.session.record(18, came, &format!("{sent}, where it stands"), "an Arrival again", words);
    }
    pilot.watch(pilot.away, DRIVE).await?;
    Ok(())
}

/// Tests that the robot reads targets with decimal commas and with exponents.
async fn decimals(pilot: &Pilot) -> Step {
    let home = pilot.home;
    let comma = target(home).replace('.', ",");
    let exponent = format!("|TARGET {:E} {:E}|", pilot.away.x, pilot.away.y);
    for (sent, goal) in [(comma, home), (exponent, pilot.away)] {
        pilot.send(&sent);
        let trip = pilot.watch(goal, Span::from_millis(8_000)).await?;
        let came = if trip.reached { "it is there" } else { "it is not there after 8 s" };
        // A robot that reaches no target at all breaks another rule.
        if trip.reached || !pilot.session.is_broken(17) {
            pilot.session.record(8, trip.reached, &sent, &format!("it drives to {}", shown(goal)), came);
        }
        if !trip.reached {
            pilot.drive_to(goal).await?;
        }
    }
    Ok(())
}

/// Tests that a new target, sent on the way to another target, replaces it.
async fn replaced(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.home).await?;
    pilot.session.pause(ONCE).await;
    let mark = pilot.send(target(pilot.away));
    pilot.session.pause(Span::from_millis(900)).await;
    let sent = format!("{}, 0.9 s later {}", target(pilot.away), target(pilot.home));
    pilot.send(target(pilot.home));
    let trip = pilot.watch(pilot.home, DRIVE).await?;
    pilot.session.pause(ONCE).await;
    let first = arrivals(pilot, mark)
        .iter()
        .any(|received| received.place().is_some_and(|at| within(at, pilot.away, 0.05)));
    let came = match (trip.reached, first) {
        (true, false) => "it turned back",
        (_, true) => "it drove to the first target to the end",
        (false, false) => "it is at neither",
    };
    pilot.session.record(16, trip.reached && !first, &sent, "it turns back at once", came);
    Ok(())
}

/// Tests that an invalid target stops the robot. A robot without routes that drives on does not break the rule: it
/// lacks this ability.
async fn no_place(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.home).await?;
    pilot.send(target(pilot.away));
    pilot.session.pause(Span::from_millis(700)).await;
    let mark = pilot.send("|TARGET NaN NaN|");
    pilot.session.pause(Span::from_millis(600)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let arrived = !arrivals(pilot, mark).is_empty();
    let fits = stands && !arrived;
    let sent = "|TARGET NaN NaN| on the way to a target";
    if fits || pilot.can.route {
        let came = if fits { "it stands" } else { "it drives on" };
        pilot.session.record(19, fits, sent, "it stands and deletes the target", came);
    } else {
        pilot.session.mark_unsupported(19, "it ignores an invalid target and drives on");
    }
    Ok(())
}

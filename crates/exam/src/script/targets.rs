//! Driving to targets: R8, R16 to R20.

use lightbots_base::{Span, Vec2};
use lightbots_wire::Topic;

use super::Step;
use super::greeting::seconds;
use super::pilot::{ANSWER, ONCE, Pilot, THERE_M, Trip, shown, target, within};
use crate::heard::Heard;

/// As fast as a robot may drive, m/s, and a little for wheels that are not all alike.
const SPEED_MPS: f64 = 0.27 * 1.05;
/// How long 0.3 m may take, with turning.
const DRIVE: Span = Span::from_millis(15_000);

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.blame.set(16);
    reach(pilot).await?;
    again(pilot).await?;
    decimals(pilot).await?;
    replaced(pilot).await?;
    no_place(pilot).await?;
    pilot.bring(pilot.home).await?;
    Ok(())
}

/// Arrivals since a mark: when and where.
pub(super) fn arrivals(pilot: &Pilot, mark: usize) -> Vec<Heard> {
    pilot
        .desk
        .since(mark, |heard| heard.iter().filter(|heard| heard.topic == Topic::Arrival).cloned().collect())
}

async fn await_arrival(pilot: &Pilot, mark: usize) -> Option<Heard> {
    pilot.desk.wait_for(mark, ANSWER, |heard| (heard.topic == Topic::Arrival).then(|| heard.clone())).await
}

/// A target, plain and simple.
async fn reach(pilot: &Pilot) -> Step {
    let (goal, sent) = (pilot.away, target(pilot.away));
    let began = pilot.desk.now();
    let mark = pilot.say(&sent);
    let trip = pilot.watch(goal, DRIVE).await?;
    stands_there(pilot, &trip, goal, &sent);
    let arrival = await_arrival(pilot, mark).await;
    pilot.desk.pause(ONCE).await;
    let count = arrivals(pilot, mark).len();
    pilot.desk.judge(18, count == 1, &sent, "one report on T/LightBot/Arrival", format!("{count}"));
    if let Some(arrival) = arrival {
        let at = arrival.place();
        let fits = at.is_some_and(|at| within(at, goal, THERE_M));
        let place = at.map_or_else(|| "no place".into(), shown);
        let came = format!("an Arrival at {place} after {:.2} s", seconds(began, arrival.at));
        pilot.desk.judge(17, fits, &sent, &format!("an Arrival within 0.02 m of {}", shown(goal)), came);
    }
    let fastest = trip.fastest_mps();
    let came = format!("{fastest:.2} m/s over 0.4 s");
    pilot.desk.judge(20, fastest <= SPEED_MPS, &sent, "at most 0.27 m/s", came);
    Ok(())
}

fn stands_there(pilot: &Pilot, trip: &Trip, goal: Vec2, sent: &str) {
    let last = trip.places.last().map_or_else(|| "nowhere".into(), |(_, at)| shown(*at));
    let came =
        if trip.reached { format!("it stands at {last}") } else { format!("after 15 s it is at {last}") };
    pilot.desk.judge(17, trip.reached, sent, &format!("it stands within 0.02 m of {}", shown(goal)), came);
}

/// The same target once more is a new one.
async fn again(pilot: &Pilot) -> Step {
    let sent = target(pilot.away);
    let mark = pilot.say(&sent);
    // Where one arrival did not come, this one tells nothing new.
    if !pilot.desk.is_broken(18) {
        let came = await_arrival(pilot, mark).await.is_some();
        let words = if came { "an Arrival" } else { "none" };
        pilot.desk.judge(18, came, &format!("{sent}, where it stands"), "an Arrival again", words);
    }
    pilot.watch(pilot.away, DRIVE).await?;
    Ok(())
}

/// A controller on a machine with a decimal comma, and one that writes exponents.
async fn decimals(pilot: &Pilot) -> Step {
    let home = pilot.home;
    let comma = target(home).replace('.', ",");
    let exponent = format!("|TARGET {:E} {:E}|", pilot.away.x, pilot.away.y);
    for (sent, goal) in [(comma, home), (exponent, pilot.away)] {
        pilot.say(&sent);
        let trip = pilot.watch(goal, Span::from_millis(8_000)).await?;
        let came = if trip.reached { "it is there" } else { "it is not there after 8 s" };
        // One that reaches no target at all breaks another rule.
        if trip.reached || !pilot.desk.is_broken(17) {
            pilot.desk.judge(8, trip.reached, &sent, &format!("it drives to {}", shown(goal)), came);
        }
        if !trip.reached {
            pilot.bring(goal).await?;
        }
    }
    Ok(())
}

/// A new target on the way to another one.
async fn replaced(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    pilot.desk.pause(ONCE).await;
    let mark = pilot.say(target(pilot.away));
    pilot.desk.pause(Span::from_millis(900)).await;
    let sent = format!("{}, 0.9 s later {}", target(pilot.away), target(pilot.home));
    pilot.say(target(pilot.home));
    let trip = pilot.watch(pilot.home, DRIVE).await?;
    pilot.desk.pause(ONCE).await;
    let first = arrivals(pilot, mark)
        .iter()
        .any(|heard| heard.place().is_some_and(|at| within(at, pilot.away, 0.05)));
    let came = match (trip.reached, first) {
        (true, false) => "it turned back",
        (_, true) => "it drove to the first target to the end",
        (false, false) => "it is at neither",
    };
    pilot.desk.judge(16, trip.reached && !first, &sent, "it turns back at once", came);
    Ok(())
}

/// A target that is nowhere stops it.
async fn no_place(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    pilot.say(target(pilot.away));
    pilot.desk.pause(Span::from_millis(700)).await;
    let mark = pilot.say("|TARGET NaN NaN|");
    pilot.desk.pause(Span::from_millis(600)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let arrived = !arrivals(pilot, mark).is_empty();
    let fits = stands && !arrived;
    let sent = "|TARGET NaN NaN| on the way to a target";
    if fits || pilot.can.route {
        let came = if fits { "it stands" } else { "it drives on" };
        pilot.desk.judge(19, fits, sent, "it stands and forgets the target", came);
    } else {
        pilot.desk.lacks(19, "it ignores a target that is no place and drives on");
    }
    Ok(())
}

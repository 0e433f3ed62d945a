//! Tests of routes, which are timed paths: R12, R27, R31 to R36, R41, R42.

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Route, Topic};

use super::pilot::{ANSWER, ONCE, Pilot, STILL_M, THERE_M, shown, within};
use super::route_checks::{arrives, judge_fit, record_beside, statuses};
use super::step::Step;
use super::timed_route::{TimedRoute, curve, rest, straight, text};
use crate::received::Received;
use crate::session::Addressee;

/// Cruising speed of the routes, m/s: three quarters of the limit of R20. An error of 5 mm along the path is then 25
/// ms.
pub(super) const SPEED_MPS: f64 = 0.2;
/// Time from sending a `START` to its moment: several round trips of slow networks.
pub(super) const LEAD: Span = Span::from_millis(1_500);

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.rule_if_silent.set(31);
    pilot.drive_to(pilot.home).await?;
    number_them(pilot).await?;
    forth(pilot).await?;
    if pilot.session.is_broken(32) {
        pilot.send("|STOP|");
        pilot.drive_to(pilot.home).await?;
        return Ok(());
    }
    back_on_a_curve(pilot).await?;
    chained(pilot).await?;
    one_report(pilot).await
}

/// Chooses route numbers far from the number that the robot reports, so that no route of the exam counts as old (R32).
async fn number_them(pilot: &Pilot) -> Step {
    let known = pilot.ask().await?.whole("route").unwrap_or(0) as u32;
    pilot.seq.set(known.wrapping_add(1000).max(1000));
    Ok(())
}

/// Returns a new route number.
pub(super) fn next_seq(pilot: &Pilot) -> u32 {
    pilot.seq.set(pilot.seq.get().wrapping_add(1).max(1));
    pilot.seq.get()
}

fn status(received: &Received) -> Option<Received> {
    (received.topic == Topic::Status).then(|| received.clone())
}

/// Sends a route. Returns whether the robot reports that it keeps the route, and records this for R32. A refusal of a
/// route with several kinds of pieces is recorded for R31 instead, if R31 is broken already.
pub(super) async fn keep(pilot: &Pilot, route: &Route) -> bool {
    let sent = text(route);
    let wanted = u64::from(route.seq);
    let mut last = "nothing on T/LightBot/Status".to_owned();
    // Twice, because one message may be lost.
    for _ in 0..2 {
        let mark = pilot.send(&sent);
        let kept = |received: &Received| {
            (received.topic == Topic::Status && received.whole("route") == Some(wanted)).then_some(())
        };
        if pilot.session.wait_for(mark, ANSWER, kept).await.is_some() {
            pilot.session.record(32, true, &sent, &format!("route={wanted} on T/LightBot/Status"), "it");
            return true;
        }
        last = pilot
            .session
            .since(mark, |received| received.iter().rev().find_map(status))
            .map_or(last, |received| received.text);
    }
    let kinds = ["R ", "L ", "C "].iter().filter(|kind| sent.contains(*kind)).count();
    // If R31 is already broken, a route with several kinds of pieces may be refused because of its pieces.
    let rule = if kinds > 1 && pilot.session.is_broken(31) { 31 } else { 32 };
    pilot.session.record(rule, false, &sent, &format!("route={wanted} on T/LightBot/Status at once"), last);
    false
}

/// Sends `START` for route `seq` with the moment `at`. Returns the start moment that the robot reports, microseconds on
/// the show clock; `None` if it reports none.
pub(super) async fn start(pilot: &Pilot, to: Addressee, seq: u32, at: Instant) -> Option<u64> {
    let mark = pilot.session.mark();
    pilot.session.send(to, format!("|START {seq} {}|", at.0));
    let said =
        |received: &Received| (received.topic == Topic::Status).then(|| received.whole("starts")).flatten();
    pilot.session.wait_for(mark, ONCE, said).await
}

/// Tests a straight route to `away`, and what the robot does before it starts: R31 to R33, R35, R36, R12, R27.
async fn forth(pilot: &Pilot) -> Step {
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS);
    // No target is under way, because it would end the route.
    if !keep(pilot, &route).await {
        return Ok(());
    }
    waits(pilot, &route).await?;
    if pilot.session.is_broken(32) {
        return Ok(());
    }
    refuses(pilot, &route).await;
    let timed_route = TimedRoute::new(route, moved_start(pilot).await);
    towards_the_way(pilot, timed_route.route.start, pilot.away).await?;
    not_before(pilot, &timed_route).await?;
    let mark = follow(pilot, &timed_route).await?;
    judge_fit(pilot, &timed_route, mark);
    arrives(pilot, &timed_route, mark).await;
    let driving = pilot
        .session
        .since(mark, |received| received.iter().any(|received| received.field("state") == Some("driving")));
    let came = if driving { "state=driving" } else { "other states only" };
    pilot.session.record(12, driving, "STATUS on its route", "state=driving", came);
    Ok(())
}

/// Tests that the robot keeps a route and waits where the route starts.
async fn waits(pilot: &Pilot, route: &Route) -> Step {
    // A robot updates its state once per step.
    pilot.session.pause(Span::from_millis(200)).await;
    let state = pilot.ask().await?.field("state").map(str::to_owned).unwrap_or_default();
    pilot.session.pause(Span::from_millis(1_500)).await;
    let at = pilot.place().await?;
    let came = format!("it is {:.3} m from there", at.distance(route.start));
    pilot.session.record(
        32,
        at.distance(route.start) <= STILL_M,
        "a PATH without START",
        "it stays where the route starts",
        came,
    );
    if !pilot.session.is_broken(32) {
        pilot.session.record(
            12,
            state == "ready",
            "a PATH without START",
            "state=ready",
            format!("state={state}"),
        );
    }
    Ok(())
}

/// Tests that invalid routes and a route with an old number change nothing.
async fn refuses(pilot: &Pilot, route: &Route) {
    let seq = route.seq;
    for (rule, sent) in [
        (31, format!("|PATH {} 0 0 L 0 1 1||STATUS|", seq.wrapping_add(1))),
        (31, format!("|PATH {} 0 0 Q 5 1 1||STATUS|", seq.wrapping_add(1))),
        (32, format!("|PATH {} 0 0 R 1000000|", seq.wrapping_sub(5))),
    ] {
        let mark = pilot.send(&sent);
        let got = pilot.session.wait_for(mark, ANSWER, status).await;
        let named = got.as_ref().and_then(|received| received.whole("route"));
        let came = got
            .as_ref()
            .map_or_else(|| "no report on T/LightBot/Status".into(), |received| received.text.clone());
        pilot.session.record(
            rule,
            named == Some(u64::from(seq)),
            &sent,
            &format!("route={seq} on T/LightBot/Status"),
            came,
        );
    }
}

/// Sends four `START` commands: a first one, a later one, an earlier one, and one for another route. Stops at the first
/// wrong answer. Returns the start moment that the robot reported last, on the show clock; without a report, that of
/// the first `START`.
async fn moved_start(pilot: &Pilot) -> Instant {
    let seq = pilot.seq.get();
    let first = pilot.session.show() + LEAD;
    let later = first + LEAD;
    let mut goes_by = first.0;
    for (to, number, at, wanted, what) in [
        (Addressee::AllRobots, seq, first, first, "START on Broadcast"),
        (Addressee::AllRobots, seq, later, later, "START with a later moment"),
        (Addressee::Robot, seq, first, later, "START with an earlier moment"),
        (Addressee::Robot, seq.wrapping_add(7), first + LEAD + LEAD, later, "START of another route"),
    ] {
        let said = start(pilot, to, number, at).await;
        goes_by = said.unwrap_or(goes_by);
        let came = said.map_or_else(|| "no starts= on T/LightBot/Status".into(), |at| format!("starts={at}"));
        let expected = format!("starts={}", wanted.0);
        let fits = said == Some(wanted.0);
        pilot.session.record(33, fits, &format!("{what}: |START {number} {}|", at.0), &expected, came);
        if !fits {
            break;
        }
    }
    Instant(goes_by)
}

/// Tests that the robot, before it leaves, has turned so that it faces along its path or the opposite way. Does nothing
/// if the robot reports no heading.
async fn towards_the_way(pilot: &Pilot, from: Vec2, to: Vec2) -> Step {
    let heading = pilot.ask().await?.field("h").and_then(|text| text.parse::<f64>().ok());
    if let Some(heading) = heading {
        let across = Vec2::unit(heading).cross((to - from).normalized().unwrap_or_default()).abs();
        let came = format!("h={heading:.2}, {:.0} degrees off", across.min(1.0).asin().to_degrees());
        pilot.session.record(
            35,
            across < 0.4,
            "a PATH, then seconds of rest",
            "it turns along its way",
            came,
        );
    }
    Ok(())
}

/// Tests that the robot does not leave before the start moment.
async fn not_before(pilot: &Pilot, timed_route: &TimedRoute) -> Step {
    let left = timed_route.starts - pilot.session.show();
    pilot.session.pause(Span((left.0 - 250_000).max(0))).await;
    let gone_m = pilot.place().await?.distance(timed_route.route.start);
    let came = format!("it is {gone_m:.3} m from the start of the route");
    pilot.session.record(
        33,
        gone_m <= STILL_M,
        "START with a later moment",
        "it waits for that moment",
        came,
    );
    Ok(())
}

/// Requests a status report every 0.1 s until the route is over. Returns the mark from which on these reports are
/// found.
pub(super) async fn follow(pilot: &Pilot, timed_route: &TimedRoute) -> Step<usize> {
    let mark = pilot.session.mark();
    let until = timed_route.over() + Span::from_millis(700);
    while pilot.session.show() < until {
        pilot.send("|STATUS|");
        pilot.session.pause(Span::from_millis(100)).await;
    }
    Ok(mark)
}

/// Tests a route with curves back to `home`.
async fn back_on_a_curve(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.away).await?;
    let route = curve(next_seq(pilot), pilot.away, pilot.home, Span::from_millis(5_000));
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let at = pilot.session.show() + LEAD;
    start(pilot, Addressee::AllRobots, route.seq, at).await;
    let timed_route = TimedRoute::new(route, at);
    let mark = follow(pilot, &timed_route).await?;
    let fit =
        pilot.session.since(mark, |received| timed_route.fit(received, pilot.session.shift(), pilot.delay()));
    let sent = format!("route {} with two C pieces", timed_route.route.seq);
    record_beside(pilot, 31, &fit, &sent, "within 20 mm of the curve");
    pilot.session.pause(ONCE).await;
    Ok(())
}

/// Tests a route that replaces another route under way. No status is requested meanwhile, to test periodic reports:
/// R34, R41.
async fn chained(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.home).await?;
    let resting = rest(next_seq(pilot), pilot.home, Span::from_millis(60_000));
    let at = pilot.session.show() + Span::from_millis(500);
    if !keep(pilot, &resting).await {
        return Ok(());
    }
    start(pilot, Addressee::Robot, resting.seq, at).await;
    pilot.session.pause(ONCE).await;
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS / 2.0);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let timed_route = TimedRoute::new(route, pilot.session.show() + LEAD);
    let mark = pilot.session.mark();
    start(pilot, Addressee::Robot, timed_route.route.seq, timed_route.starts).await;
    let left = timed_route.over() - pilot.session.show();
    pilot.session.pause(left + Span::from_millis(500)).await;
    statuses(pilot, mark, &timed_route);
    let at = pilot.place().await?;
    let taken = within(at, pilot.away, 2.0 * THERE_M);
    let came = format!("it is at {}", shown(at));
    pilot.session.record(
        34,
        taken,
        "START of a route while another is under way",
        &format!("it drives to {}", shown(pilot.away)),
        came,
    );
    if !taken {
        pilot.send("|STOP|");
    }
    Ok(())
}

/// Tests that six requests for a status in one payload get at least one report, and at most three. R42 demands one.
async fn one_report(pilot: &Pilot) -> Step {
    let mark = pilot.send("|STATUS||STATUS||STATUS||STATUS||STATUS||STATUS|");
    pilot.session.pause(ONCE).await;
    let count = pilot
        .session
        .since(mark, |received| received.iter().filter(|received| received.topic == Topic::Status).count());
    pilot.session.record(
        41,
        count > 0,
        "|STATUS|",
        "a report on T/LightBot/Status at once",
        format!("{count}"),
    );
    // One periodic report may come in between.
    pilot.session.record(
        42,
        count <= 3,
        "|STATUS| six times in one payload",
        "one report",
        format!("{count}"),
    );
    Ok(())
}

//! Holding, stopping and aborting: R12, R37 to R40.

use lightbots_base::{Instant, Span};
use lightbots_wire::{Route, Topic};

use super::pilot::{ANSWER, Pilot, STILL_M, shown};
use super::route_checks::judge_time;
use super::routes::{LEAD, SPEED_MPS, follow, keep, next_seq, start};
use super::step::Step;
use super::timed_route::{REST, TimedRoute, rest, straight};
use crate::session::Addressee;

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.rule_if_silent.set(38);
    held(pilot).await?;
    pilot.rule_if_silent.set(39);
    stopped(pilot).await?;
    pilot.rule_if_silent.set(37);
    far_off(pilot).await
}

/// Sends a straight route from `home` to `away` and its `START`. Returns the route and its start moment; `None` if the
/// robot does not keep the route.
async fn begin_route(pilot: &Pilot) -> Step<Option<(Route, Instant)>> {
    pilot.drive_to(pilot.home).await?;
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS);
    if !keep(pilot, &route).await {
        return Ok(None);
    }
    let starts = pilot.session.show() + LEAD;
    start(pilot, Addressee::AllRobots, route.seq, starts).await;
    Ok(Some((route, starts)))
}

/// Tests a hold in the middle of a route.
async fn held(pilot: &Pilot) -> Step {
    let Some((route, starts)) = begin_route(pilot).await? else { return Ok(()) };
    let hold = starts + REST + Span::from_millis(500);
    let resume = hold + Span::from_millis(2_500);
    let timed_route = TimedRoute { route, starts, hold: Some((hold, resume)) };
    let sent = format!("|HOLD {}|, |RESUME {}| on a route", hold.0, resume.0);
    pilot.session.pause(hold - pilot.session.show() + Span::from_millis(-400)).await;
    pilot.session.send(Addressee::AllRobots, format!("|HOLD {}|", hold.0));
    pilot.session.pause(hold - pilot.session.show() + Span::from_millis(700)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let came = if stands { "it stands" } else { "it drives on" };
    pilot.session.record(38, stands, &sent, "it stands from 0.3 s after HOLD on", came);
    let state = pilot.ask().await?.field("state").map(str::to_owned).unwrap_or_default();
    if stands {
        pilot.session.record(12, state == "held", "HOLD", "state=held", format!("state={state}"));
    }
    pilot.session.send(Addressee::AllRobots, format!("|RESUME {}|", resume.0));
    pilot.session.pause(resume - pilot.session.show() + Route::EASE).await;
    let mark = follow(pilot, &timed_route).await?;
    // With a wrong clock this test would not show anything about holds.
    if !pilot.session.is_broken(27) {
        let fit = pilot
            .session
            .since(mark, |received| timed_route.fit(received, pilot.session.shift(), pilot.delay()));
        judge_time(pilot, fit.late_s, 38, &sent);
    }
    Ok(())
}

/// Tests that a hold before the start of a route has no effect on the route (R39). Then tests `STOP` on a route, at
/// once and at a moment, and on the way to a target (R40).
async fn stopped(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.home).await?;
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let starts = pilot.session.show() + LEAD;
    let hold = starts + Span::from_millis(-600);
    pilot.session.send(Addressee::AllRobots, format!("|HOLD {}|", hold.0));
    start(pilot, Addressee::AllRobots, route.seq, starts).await;
    // A third of the path is driven by then.
    pilot.session.pause(starts - pilot.session.show() + REST + Span::from_millis(800)).await;
    let gone_m = pilot.place().await?.distance(pilot.home);
    let sent = format!("|HOLD {}||START {} {}|", hold.0, route.seq, starts.0);
    let came = format!("it has driven {gone_m:.3} m");
    pilot.session.record(39, gone_m > 0.03, &sent, "the new route begins without a hold", came);
    pilot.rule_if_silent.set(40);
    let mark = pilot.send("|STOP|");
    let idle = |received: &crate::received::Received| {
        (received.topic == Topic::Status && received.field("state") == Some("idle")).then_some(())
    };
    let said = pilot.session.wait_for(mark, ANSWER, idle).await.is_some();
    pilot.session.pause(Span::from_millis(300)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let came = match (stands, said) {
        (true, true) => "it stands and reports it",
        (true, false) => "it stands, but no report with state=idle came",
        (false, _) => "it drives on",
    };
    let expected = "it stands at once; a report on T/LightBot/Status with state=idle";
    pilot.session.record(40, stands && said, "|STOP| on a route", expected, came);
    stopped_at_a_moment(pilot).await?;
    stop_target(pilot).await
}

/// Tests `STOP` with a moment, which no `RESUME` revokes. A robot that ignores the moment stops at once and passes as
/// well.
async fn stopped_at_a_moment(pilot: &Pilot) -> Step {
    let Some((_, starts)) = begin_route(pilot).await? else { return Ok(()) };
    pilot.session.pause(starts - pilot.session.show() + REST + Span::from_millis(200)).await;
    let stop = pilot.session.show() + Span::from_millis(500);
    let resume = stop + Span::from_millis(100);
    let sent = format!("|STOP {}|, |RESUME {}| on a route", stop.0, resume.0);
    for command in [format!("|STOP {}|", stop.0), format!("|RESUME {}|", resume.0)] {
        pilot.session.send(Addressee::AllRobots, command);
    }
    pilot.session.pause(stop - pilot.session.show() + Route::EASE + Span::from_millis(200)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let state = pilot.ask().await?.field("state").map(str::to_owned).unwrap_or_default();
    let came = format!("{}, state={state}", if stands { "it stands" } else { "it drives on" });
    let expected = "it stands from 0.3 s after that moment on, state=idle";
    pilot.session.record(40, stands && state == "idle", &sent, expected, came);
    Ok(())
}

/// Tests `STOP` on the way to a target.
async fn stop_target(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.home).await?;
    pilot.send(super::pilot::target(pilot.away));
    pilot.session.pause(Span::from_millis(700)).await;
    pilot.send("|STOP|");
    pilot.session.pause(Span::from_millis(400)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let came = if stands { "it stands" } else { "it drives on" };
    pilot.session.record(
        40,
        stands,
        "|STOP| on the way to a target",
        "it stands and deletes the target",
        came,
    );
    Ok(())
}

/// Tests that the robot aborts a route that begins far from it.
async fn far_off(pilot: &Pilot) -> Step {
    pilot.drive_to(pilot.home).await?;
    let way = (pilot.away - pilot.home).normalized().unwrap_or_default();
    let there = pilot.home + way * 0.45;
    let route = rest(next_seq(pilot), there, Span::from_millis(5_000));
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let mark = pilot.session.mark();
    let starts = pilot.session.show() + Span::from_millis(700);
    start(pilot, Addressee::Robot, route.seq, starts).await;
    let faulty =
        |received: &crate::received::Received| (received.field("state") == Some("faulty")).then_some(());
    let said = pilot.session.wait_for(mark, ANSWER, faulty).await.is_some();
    let moved_m = pilot.place().await?.distance(pilot.home);
    let stays = moved_m <= 2.0 * STILL_M;
    let came =
        format!("{}; it moved by {moved_m:.3} m", if said { "state=faulty" } else { "no state=faulty" });
    let sent = format!("a route that begins at {}, 0.45 m from it", shown(there));
    pilot.session.record(37, said && stays, &sent, "it aborts the route and stands, state=faulty", came);
    pilot.send("|STOP|");
    pilot.session.pause(Span::from_millis(1_500)).await;
    pilot.drive_to(pilot.home).await?;
    Ok(())
}

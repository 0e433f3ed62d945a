//! Holding, stopping, giving up: R12, R37 to R40.

use lightbots_base::Span;
use lightbots_wire::{Route, Topic};

use super::Step;
use super::course::{Course, REST, rest, straight};
use super::pilot::{ANSWER, Pilot, STILL_M, shown};
use super::routes::{LEAD, SPEED_MPS, follow, judge_time, keep, next_seq, start};
use crate::desk::To;

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.blame.set(38);
    held(pilot).await?;
    pilot.blame.set(39);
    stopped(pilot).await?;
    pilot.blame.set(37);
    far_off(pilot).await
}

/// Rest in the middle of a route, all by moments.
async fn held(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let starts = pilot.desk.show() + LEAD;
    start(pilot, To::All, route.seq, starts).await;
    let hold = starts + REST + Span::from_millis(500);
    let resume = hold + Span::from_millis(2_500);
    let course = Course { route, starts, hold: Some((hold, resume)) };
    let sent = format!("|HOLD {}|, |RESUME {}| on a route", hold.0, resume.0);
    pilot.desk.pause(hold - pilot.desk.show() + Span::from_millis(-400)).await;
    pilot.desk.say(To::All, format!("|HOLD {}|", hold.0));
    pilot.desk.pause(hold - pilot.desk.show() + Span::from_millis(700)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let came = if stands { "it stands" } else { "it drives on" };
    pilot.desk.judge(38, stands, &sent, "it stands from 0.3 s after HOLD on", came);
    let state = pilot.ask().await?.field("state").map(str::to_owned).unwrap_or_default();
    if stands {
        pilot.desk.judge(12, state == "held", "HOLD", "state=held", format!("state={state}"));
    }
    pilot.desk.say(To::All, format!("|RESUME {}|", resume.0));
    pilot.desk.pause(resume - pilot.desk.show() + Route::EASE).await;
    let mark = follow(pilot, &course).await?;
    // A clock that is off says nothing about holding.
    if !pilot.desk.is_broken(27) {
        let fit = pilot.desk.since(mark, |heard| course.fit(heard, pilot.desk.shift(), pilot.delay()));
        judge_time(pilot, fit.late_s, 38, &sent);
    }
    Ok(())
}

/// A hold from before the route does not count; STOP on the way does.
async fn stopped(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let starts = pilot.desk.show() + LEAD;
    let hold = starts + Span::from_millis(-600);
    pilot.desk.say(To::All, format!("|HOLD {}|", hold.0));
    start(pilot, To::All, route.seq, starts).await;
    // A third of the way.
    pilot.desk.pause(starts - pilot.desk.show() + REST + Span::from_millis(800)).await;
    let gone_m = pilot.place().await?.distance(pilot.home);
    let sent = format!("|HOLD {}||START {} {}|", hold.0, route.seq, starts.0);
    let came = format!("it has driven {gone_m:.3} m");
    pilot.desk.judge(39, gone_m > 0.03, &sent, "the new route begins free", came);
    pilot.blame.set(40);
    let mark = pilot.say("|STOP|");
    let idle = |heard: &crate::heard::Heard| {
        (heard.topic == Topic::Status && heard.field("state") == Some("idle")).then_some(())
    };
    let said = pilot.desk.wait_for(mark, ANSWER, idle).await.is_some();
    pilot.desk.pause(Span::from_millis(300)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let came = match (stands, said) {
        (true, true) => "it stands and says so",
        (true, false) => "it stands, but no report with state=idle came",
        (false, _) => "it drives on",
    };
    let expected = "it stands at once; a report on T/LightBot/Status with state=idle";
    pilot.desk.judge(40, stands && said, "|STOP| on a route", expected, came);
    stop_target(pilot).await
}

/// STOP on the way to a target.
async fn stop_target(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    pilot.say(super::pilot::target(pilot.away));
    pilot.desk.pause(Span::from_millis(700)).await;
    pilot.say("|STOP|");
    pilot.desk.pause(Span::from_millis(400)).await;
    let stands = pilot.stands(Span::from_millis(900)).await?;
    let came = if stands { "it stands" } else { "it drives on" };
    pilot.desk.judge(40, stands, "|STOP| on the way to a target", "it stands and forgets the target", came);
    Ok(())
}

/// A route that is under way where the robot is not.
async fn far_off(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    let way = (pilot.away - pilot.home).normalized().unwrap_or_default();
    let there = pilot.home + way * 0.45;
    let route = rest(next_seq(pilot), there, Span::from_millis(5_000));
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let mark = pilot.desk.mark();
    let starts = pilot.desk.show() + Span::from_millis(700);
    start(pilot, To::Robot, route.seq, starts).await;
    let faulty = |heard: &crate::heard::Heard| (heard.field("state") == Some("faulty")).then_some(());
    let said = pilot.desk.wait_for(mark, ANSWER, faulty).await.is_some();
    let moved_m = pilot.place().await?.distance(pilot.home);
    let stays = moved_m <= 2.0 * STILL_M;
    let came =
        format!("{}; it moved by {moved_m:.3} m", if said { "state=faulty" } else { "no state=faulty" });
    let sent = format!("a route that begins at {}, 0.45 m from it", shown(there));
    pilot.desk.judge(37, said && stays, &sent, "it gives the route up, stands, state=faulty", came);
    pilot.say("|STOP|");
    pilot.desk.pause(Span::from_millis(1_500)).await;
    pilot.bring(pilot.home).await?;
    Ok(())
}

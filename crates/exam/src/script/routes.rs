//! Timed paths: R12, R27, R31 to R36, R41, R42.

use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Route, Topic};

use super::Step;
use super::course::{Course, bow, rest, straight, text};
use super::pilot::{ANSWER, ONCE, Pilot, STILL_M, THERE_M, shown, within};
use super::targets::arrivals;
use crate::desk::To;
use crate::heard::Heard;

/// Cruising speed of the routes, m/s: a place off by 5 mm is then 25 ms.
pub(super) const SPEED_MPS: f64 = 0.2;
/// How far beside its route a robot may be, metres; 5 mm are typical.
const BESIDE_M: f64 = 0.02;
/// How much later or earlier than its route, less what the network may hide.
const LATE: Span = Span::from_millis(50);
/// From a START to its moment.
pub(super) const LEAD: Span = Span::from_millis(1_500);

pub(super) async fn run(pilot: &Pilot) -> Step {
    pilot.blame.set(31);
    pilot.bring(pilot.home).await?;
    number_them(pilot).await?;
    forth(pilot).await?;
    if pilot.desk.is_broken(32) {
        pilot.say("|STOP|");
        pilot.bring(pilot.home).await?;
        return Ok(());
    }
    back_in_a_bow(pilot).await?;
    chained(pilot).await?;
    one_report(pilot).await
}

/// Numbers far from those it knows.
async fn number_them(pilot: &Pilot) -> Step {
    let known = pilot.ask().await?.whole("route").unwrap_or(0) as u32;
    pilot.seq.set(known.wrapping_add(1000).max(1000));
    Ok(())
}

/// The next route's number.
pub(super) fn next_seq(pilot: &Pilot) -> u32 {
    pilot.seq.set(pilot.seq.get().wrapping_add(1).max(1));
    pilot.seq.get()
}

fn status(heard: &Heard) -> Option<Heard> {
    (heard.topic == Topic::Status).then(|| heard.clone())
}

/// Gives it a route; whether it says that it keeps it.
pub(super) async fn keep(pilot: &Pilot, route: &Route) -> bool {
    let sent = text(route);
    let wanted = u64::from(route.seq);
    let mut last = "nothing on T/LightBot/Status".to_owned();
    // Once more, in case it was lost.
    for _ in 0..2 {
        let mark = pilot.say(&sent);
        let kept = |heard: &Heard| {
            (heard.topic == Topic::Status && heard.whole("route") == Some(wanted)).then_some(())
        };
        if pilot.desk.wait_for(mark, ANSWER, kept).await.is_some() {
            pilot.desk.judge(32, true, &sent, &format!("route={wanted} on T/LightBot/Status"), "it");
            return true;
        }
        last = pilot
            .desk
            .since(mark, |heard| heard.iter().rev().find_map(status))
            .map_or(last, |heard| heard.text);
    }
    let kinds = ["R ", "L ", "C "].iter().filter(|kind| sent.contains(*kind)).count();
    // A rest alone is kept by whoever keeps anything.
    let rule = if kinds > 1 && pilot.desk.is_broken(31) { 31 } else { 32 };
    pilot.desk.judge(rule, false, &sent, &format!("route={wanted} on T/LightBot/Status at once"), last);
    false
}

/// Lets the kept route begin at `at`; the moment it says it begins, if it says one.
pub(super) async fn start(pilot: &Pilot, to: To, seq: u32, at: Instant) -> Option<u64> {
    let mark = pilot.desk.mark();
    pilot.desk.say(to, format!("|START {seq} {}|", at.0));
    let said = |heard: &Heard| (heard.topic == Topic::Status).then(|| heard.whole("starts")).flatten();
    pilot.desk.wait_for(mark, ONCE, said).await
}

/// There straight, with everything that may come before: R31 to R33, R35, R36, R12, R27.
async fn forth(pilot: &Pilot) -> Step {
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS);
    // An original target would end the route: none is under way.
    if !keep(pilot, &route).await {
        return Ok(());
    }
    waits(pilot, &route).await?;
    if pilot.desk.is_broken(32) {
        return Ok(());
    }
    refuses(pilot, &route).await;
    let course = Course::new(route, moved_start(pilot).await);
    towards_the_way(pilot, course.route.start, pilot.away).await?;
    not_before(pilot, &course).await?;
    let mark = follow(pilot, &course).await?;
    judge_fit(pilot, &course, mark, true);
    arrives(pilot, &course, mark).await;
    let driving =
        pilot.desk.since(mark, |heard| heard.iter().any(|heard| heard.field("state") == Some("driving")));
    let came = if driving { "state=driving" } else { "other states only" };
    pilot.desk.judge(12, driving, "STATUS on its route", "state=driving", came);
    Ok(())
}

/// It keeps the route and stays.
async fn waits(pilot: &Pilot, route: &Route) -> Step {
    // A robot looks at itself once a step.
    pilot.desk.pause(Span::from_millis(200)).await;
    let state = pilot.ask().await?.field("state").map(str::to_owned).unwrap_or_default();
    pilot.desk.pause(Span::from_millis(1_500)).await;
    let at = pilot.place().await?;
    let came = format!("it is {:.3} m from there", at.distance(route.start));
    pilot.desk.judge(
        32,
        at.distance(route.start) <= STILL_M,
        "a PATH without START",
        "it stays where the route starts",
        came,
    );
    if !pilot.desk.is_broken(32) {
        pilot.desk.judge(
            12,
            state == "ready",
            "a PATH without START",
            "state=ready",
            format!("state={state}"),
        );
    }
    Ok(())
}

/// Senseless and old routes change nothing.
async fn refuses(pilot: &Pilot, route: &Route) {
    let seq = route.seq;
    for (rule, sent) in [
        (31, format!("|PATH {} 0 0 L 0 1 1||STATUS|", seq.wrapping_add(1))),
        (31, format!("|PATH {} 0 0 Q 5 1 1||STATUS|", seq.wrapping_add(1))),
        (32, format!("|PATH {} 0 0 R 1000000|", seq.wrapping_sub(5))),
    ] {
        let mark = pilot.say(&sent);
        let got = pilot.desk.wait_for(mark, ANSWER, status).await;
        let named = got.as_ref().and_then(|heard| heard.whole("route"));
        let came =
            got.as_ref().map_or_else(|| "no report on T/LightBot/Status".into(), |heard| heard.text.clone());
        pilot.desk.judge(
            rule,
            named == Some(u64::from(seq)),
            &sent,
            &format!("route={seq} on T/LightBot/Status"),
            came,
        );
    }
}

/// A START, a later one, an earlier one, and one for another route; the moment the robot goes by.
async fn moved_start(pilot: &Pilot) -> Instant {
    let seq = pilot.seq.get();
    let first = pilot.desk.show() + LEAD;
    let later = first + LEAD;
    let mut goes_by = first.0;
    for (to, number, at, wanted, what) in [
        (To::All, seq, first, first, "START on Broadcast"),
        (To::All, seq, later, later, "START with a later moment"),
        (To::Robot, seq, first, later, "START with an earlier moment"),
        (To::Robot, seq.wrapping_add(7), first + LEAD + LEAD, later, "START of another route"),
    ] {
        let said = start(pilot, to, number, at).await;
        goes_by = said.unwrap_or(goes_by);
        let came = said.map_or_else(|| "no starts= on T/LightBot/Status".into(), |at| format!("starts={at}"));
        let expected = format!("starts={}", wanted.0);
        let fits = said == Some(wanted.0);
        pilot.desk.judge(33, fits, &format!("{what}: |START {number} {}|", at.0), &expected, came);
        if !fits {
            break;
        }
    }
    Instant(goes_by)
}

/// Before it leaves it turns towards its way, or away from it.
async fn towards_the_way(pilot: &Pilot, from: Vec2, to: Vec2) -> Step {
    let heading = pilot.ask().await?.field("h").and_then(|text| text.parse::<f64>().ok());
    if let Some(heading) = heading {
        let across = Vec2::unit(heading).cross((to - from).normalized().unwrap_or_default()).abs();
        let came = format!("h={heading:.2}, {:.0} degrees off", across.min(1.0).asin().to_degrees());
        pilot.desk.judge(35, across < 0.4, "a PATH, then seconds of rest", "it turns along its way", came);
    }
    Ok(())
}

/// It does not leave before its moment.
async fn not_before(pilot: &Pilot, course: &Course) -> Step {
    let left = course.starts - pilot.desk.show();
    pilot.desk.pause(Span((left.0 - 250_000).max(0))).await;
    let gone_m = pilot.place().await?.distance(course.route.start);
    let came = format!("it is {gone_m:.3} m from the start of the route");
    pilot.desk.judge(33, gone_m <= STILL_M, "START with a later moment", "it waits for that moment", came);
    Ok(())
}

/// Asks for status all along the route; the mark behind which the drive stands.
pub(super) async fn follow(pilot: &Pilot, course: &Course) -> Step<usize> {
    let mark = pilot.desk.mark();
    let until = course.over() + Span::from_millis(700);
    while pilot.desk.show() < until {
        pilot.say("|STATUS|");
        pilot.desk.pause(Span::from_millis(100)).await;
    }
    Ok(mark)
}

/// R35 beside the path, R27 along it; `rule_of_time` says whether lateness is the clock's.
pub(super) fn judge_fit(pilot: &Pilot, course: &Course, mark: usize, judges_time: bool) {
    let fit = pilot.desk.since(mark, |heard| course.fit(heard, pilot.desk.shift(), pilot.delay()));
    let sent = format!("route {} with STATUS each 0.1 s", course.route.seq);
    if fit.reports == 0 {
        return pilot.desk.judge(
            41,
            false,
            &sent,
            "a report on T/LightBot/Status for each",
            "none with a place",
        );
    }
    let came = format!("up to {:.0} mm beside it in {} reports", fit.beside_m * 1e3, fit.reports);
    pilot.desk.judge(35, fit.beside_m <= BESIDE_M, &sent, "within 20 mm of the path (5 are typical)", came);
    if judges_time {
        judge_time(pilot, fit.late_s, 27, &sent);
    }
}

/// Whether it is where the show clock says, along its path.
pub(super) fn judge_time(pilot: &Pilot, late_s: Option<f64>, rule: u8, sent: &str) {
    let bound_s = (LATE + pilot.delay()).as_secs();
    let expected = format!("along the path within {:.0} ms of the show clock", bound_s * 1e3);
    let came = late_s.map_or_else(
        || "no report from the middle of the path".into(),
        |late_s| format!("{:.0} ms {}", late_s.abs() * 1e3, if late_s < 0.0 { "early" } else { "late" }),
    );
    pilot.desk.judge(rule, late_s.is_some_and(|late_s| late_s.abs() <= bound_s), sent, &expected, came);
}

/// One arrival, at the end, with the number of the route.
pub(super) async fn arrives(pilot: &Pilot, course: &Course, mark: usize) {
    let seq = u64::from(course.route.seq);
    let end = course.path().end();
    let left = (course.over() - pilot.desk.show()).0.max(0);
    let named = |heard: &Heard| (heard.topic == Topic::Arrival).then_some(());
    pilot.desk.wait_for(mark, Span(left + 3_000_000), named).await;
    pilot.desk.pause(ONCE).await;
    let came = arrivals(pilot, mark);
    let sent = format!("the end of route {seq}");
    let expected = format!("one Arrival with route={seq} at {}", shown(end));
    let words = match came.as_slice() {
        [] => "none".to_owned(),
        [one] => one.text.clone(),
        more => format!("{} of them", more.len()),
    };
    let [arrival] = came.as_slice() else {
        return pilot.desk.judge(36, false, &sent, &expected, words);
    };
    let there =
        arrival.place().is_some_and(|at| within(at, end, THERE_M)) && arrival.whole("route") == Some(seq);
    let early_s = (course.over() - (arrival.at + pilot.desk.shift())).as_secs();
    let in_time =
        early_s < (LATE + pilot.delay()).as_secs() || pilot.desk.is_broken(27) || course.hold.is_some();
    let words = if in_time { words } else { format!("{words}, {early_s:.2} s before the route was over") };
    pilot.desk.judge(36, there && in_time, &sent, &expected, words);
}

/// A curve back.
async fn back_in_a_bow(pilot: &Pilot) -> Step {
    pilot.bring(pilot.away).await?;
    let route = bow(next_seq(pilot), pilot.away, pilot.home, Span::from_millis(5_000));
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let at = pilot.desk.show() + LEAD;
    start(pilot, To::All, route.seq, at).await;
    let course = Course::new(route, at);
    let mark = follow(pilot, &course).await?;
    let fit = pilot.desk.since(mark, |heard| course.fit(heard, pilot.desk.shift(), pilot.delay()));
    let sent = format!("route {} with two C pieces", course.route.seq);
    let came = format!("up to {:.0} mm beside it in {} reports", fit.beside_m * 1e3, fit.reports);
    pilot.desk.judge(
        31,
        fit.reports > 0 && fit.beside_m <= BESIDE_M,
        &sent,
        "within 20 mm of the curve",
        came,
    );
    pilot.desk.pause(ONCE).await;
    Ok(())
}

/// A route that takes over from one under way, without asking for status: R34, R41.
async fn chained(pilot: &Pilot) -> Step {
    pilot.bring(pilot.home).await?;
    let resting = rest(next_seq(pilot), pilot.home, Span::from_millis(60_000));
    let at = pilot.desk.show() + Span::from_millis(500);
    if !keep(pilot, &resting).await {
        return Ok(());
    }
    start(pilot, To::Robot, resting.seq, at).await;
    pilot.desk.pause(ONCE).await;
    let route = straight(next_seq(pilot), pilot.home, pilot.away, SPEED_MPS / 2.0);
    if !keep(pilot, &route).await {
        return Ok(());
    }
    let course = Course::new(route, pilot.desk.show() + LEAD);
    let mark = pilot.desk.mark();
    start(pilot, To::Robot, course.route.seq, course.starts).await;
    let left = course.over() - pilot.desk.show();
    pilot.desk.pause(left + Span::from_millis(500)).await;
    statuses(pilot, mark, &course);
    let at = pilot.place().await?;
    let taken = within(at, pilot.away, 2.0 * THERE_M);
    let came = format!("it is at {}", shown(at));
    pilot.desk.judge(
        34,
        taken,
        "START of a route while another is under way",
        &format!("it drives to {}", shown(pilot.away)),
        came,
    );
    if !taken {
        pilot.say("|STOP|");
    }
    Ok(())
}

/// Reports while it drives come each half second.
fn statuses(pilot: &Pilot, mark: usize, course: &Course) {
    let shift = pilot.desk.shift();
    let moments: Vec<Instant> = pilot.desk.since(mark, |heard| {
        let all = heard.iter().filter(|heard| heard.topic == Topic::Status).map(|heard| heard.at + shift);
        all.filter(|at| (course.starts..=course.over()).contains(at)).collect()
    });
    let ends = [course.starts, course.over()];
    let all: Vec<Instant> = ends[..1].iter().chain(&moments).chain(&ends[1..]).copied().collect();
    let longest = all.windows(2).map(|pair| (pair[1] - pair[0]).as_secs()).fold(0.0, f64::max);
    let came = format!("{} reports, {longest:.2} s between two at most", moments.len());
    pilot.desk.judge(
        41,
        longest <= 1.0,
        "a route, and no commands on the way",
        "a report on Status each 0.5 s",
        came,
    );
}

/// Many questions at once have one answer.
async fn one_report(pilot: &Pilot) -> Step {
    let mark = pilot.say("|STATUS||STATUS||STATUS||STATUS||STATUS||STATUS|");
    pilot.desk.pause(ONCE).await;
    let count =
        pilot.desk.since(mark, |heard| heard.iter().filter(|heard| heard.topic == Topic::Status).count());
    pilot.desk.judge(41, count > 0, "|STATUS|", "a report on T/LightBot/Status at once", format!("{count}"));
    // One of its own accord may come in between.
    pilot.desk.judge(42, count <= 3, "|STATUS| six times in one payload", "one report", format!("{count}"));
    Ok(())
}

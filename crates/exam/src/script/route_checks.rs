//! Checks how a robot follows a timed path: R27, R35, R36, R41.

use lightbots_base::{Instant, Span};
use lightbots_wire::Topic;

use super::pilot::{ONCE, Pilot, THERE_M, shown, within};
use super::targets::arrivals;
use super::timed_route::{Fit, TimedRoute};
use crate::received::Received;

/// Largest allowed distance from the route, metres: four times the typical 5 mm of R35.
const BESIDE_M: f64 = 0.02;
/// Largest allowed delay along the route: ten times the 5 ms of R27. The age of reports is added to it.
const LATE: Span = Span::from_millis(50);

/// Records the robot's distance from the path (R35) and its delay along it (R27), from the reports since `mark`.
/// Without such reports, records instead that R41 is broken.
pub(super) fn judge_fit(pilot: &Pilot, timed_route: &TimedRoute, mark: usize) {
    let fit =
        pilot.session.since(mark, |received| timed_route.fit(received, pilot.session.shift(), pilot.delay()));
    let sent = format!("route {} with STATUS each 0.1 s", timed_route.route.seq);
    if fit.reports == 0 {
        return pilot.session.record(
            41,
            false,
            &sent,
            "a report on T/LightBot/Status for each",
            "none with a place",
        );
    }
    record_beside(pilot, 35, &fit, &sent, "within 20 mm of the path (5 are typical)");
    judge_time(pilot, fit.late_s, 27, &sent);
}

/// Records for `rule` whether the robot is as far along its path as the show clock demands. `late_s`: its delay,
/// seconds; `None`: no report from the middle of the path.
pub(super) fn judge_time(pilot: &Pilot, late_s: Option<f64>, rule: u8, sent: &str) {
    let bound_s = (LATE + pilot.delay()).as_secs();
    let expected = format!("along the path within {:.0} ms of the show clock", bound_s * 1e3);
    let came = late_s.map_or_else(
        || "no report from the middle of the path".into(),
        |late_s| format!("{:.0} ms {}", late_s.abs() * 1e3, if late_s < 0.0 { "early" } else { "late" }),
    );
    pilot.session.record(rule, late_s.is_some_and(|late_s| late_s.abs() <= bound_s), sent, &expected, came);
}

/// Records for `rule` whether the robot reports, and all reported places are at most [`BESIDE_M`] from the path.
pub(super) fn record_beside(pilot: &Pilot, rule: u8, fit: &Fit, sent: &str, expected: &str) {
    let came = format!("up to {:.0} mm beside it in {} reports", fit.beside_m * 1e3, fit.reports);
    pilot.session.record(rule, fit.reports > 0 && fit.beside_m <= BESIDE_M, sent, expected, came);
}

/// Tests that exactly one arrival is reported, at the end of the route, with the route's number. It must not be early,
/// unless the route was held or the robot's clock is known to be wrong (R27).
pub(super) async fn arrives(pilot: &Pilot, timed_route: &TimedRoute, mark: usize) {
    let seq = u64::from(timed_route.route.seq);
    let end = timed_route.path().end();
    let left = (timed_route.over() - pilot.session.show()).0.max(0);
    let named = |received: &Received| (received.topic == Topic::Arrival).then_some(());
    pilot.session.wait_for(mark, Span(left + 3_000_000), named).await;
    pilot.session.pause(ONCE).await;
    let came = arrivals(pilot, mark);
    let sent = format!("the end of route {seq}");
    let expected = format!("one Arrival with route={seq} at {}", shown(end));
    let words = match came.as_slice() {
        [] => "none".to_owned(),
        [one] => one.text.clone(),
        more => format!("{} of them", more.len()),
    };
    let [arrival] = came.as_slice() else {
        return pilot.session.record(36, false, &sent, &expected, words);
    };
    let there =
        arrival.place().is_some_and(|at| within(at, end, THERE_M)) && arrival.whole("route") == Some(seq);
    let early_s = (timed_route.over() - (arrival.at + pilot.session.shift())).as_secs();
    let in_time = early_s < (LATE + pilot.delay()).as_secs()
        || pilot.session.is_broken(27)
        || timed_route.hold.is_some();
    let words = if in_time { words } else { format!("{words}, {early_s:.2} s before the route was over") };
    pilot.session.record(36, there && in_time, &sent, &expected, words);
}

/// Tests that the robot reports while it drives, with gaps of at most 1 s; R41 demands a report every 0.5 s.
pub(super) fn statuses(pilot: &Pilot, mark: usize, timed_route: &TimedRoute) {
    let shift = pilot.session.shift();
    let moments: Vec<Instant> = pilot.session.since(mark, |received| {
        let all = received
            .iter()
            .filter(|received| received.topic == Topic::Status)
            .map(|received| received.at + shift);
        all.filter(|at| (timed_route.starts..=timed_route.over()).contains(at)).collect()
    });
    let ends = [timed_route.starts, timed_route.over()];
    let all: Vec<Instant> = ends[..1].iter().chain(&moments).chain(&ends[1..]).copied().collect();
    let longest = all.windows(2).map(|pair| (pair[1] - pair[0]).as_secs()).fold(0.0, f64::max);
    let came = format!("{} reports, {longest:.2} s between two at most", moments.len());
    pilot.session.record(
        41,
        longest <= 1.0,
        "a route, and no commands on the way",
        "a report on Status each 0.5 s",
        came,
    );
}

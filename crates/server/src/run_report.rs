//! Report of a run on live robots.

use lightbots_api::{self as api, rounded};
use lightbots_base::Instant;
use lightbots_control::{Event, EventKind, RunOutcome, Snapshot};
use lightbots_show::{Issue, Issues, Severity, Show};
use lightbots_sim::Spread;
use serde::Serialize;

use crate::failure::Failure;
use crate::numbers::rounded_spread;
use crate::{commands, say};

/// Number of issues from which on events and warnings of the run add no further issues, except for the run's end.
const ISSUES_MAX: usize = 500;

/// Report of a run, made from the run's events.
#[derive(Clone, Debug, Default)]
pub struct RunReport {
    frames: usize,
    robots: usize,
    began: Option<Instant>,
    duration_s: f64,
    frames_played: usize,
    /// Time between the first and the last arrival in a frame, seconds, one value for each frame.
    spreads_s: Vec<f64>,
    errors_m: Vec<f64>,
    dropouts: usize,
    rejoined: usize,
    outcome: Option<RunOutcome>,
    issues: Issues,
}

/// The JSON of `play`.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    ok: bool,
    robots: usize,
    frames: usize,
    frames_played: usize,
    duration_s: f64,
    arrival_spread_s: Spread,
    position_error_m: Spread,
    dropouts: usize,
    issues: &'a Issues,
}

impl RunReport {
    /// Returns the report of a run of this show that has not begun.
    pub fn new(show: &Show) -> Self {
        Self { frames: show.frames.len(), ..Self::default() }
    }

    /// Whether [`Self::add`] needs the places of robots for this event.
    pub fn wants_places(event: &Event) -> bool {
        matches!(event.kind, EventKind::FrameReached { .. })
    }

    /// Adds an event. `places` must be a snapshot if [`Self::wants_places`] returns `true` for the event, and may be `None`
    /// otherwise.
    pub fn add(&mut self, event: &Event, places: Option<&Snapshot>) {
        match &event.kind {
            EventKind::RunBegun { robots, .. } => self.robots = *robots,
            EventKind::TransitionStarted { starts, .. } => {
                self.began.get_or_insert(*starts);
            }
            EventKind::FrameReached { frame, spread, .. } => {
                self.spreads_s.push(spread.as_secs());
                self.frames_played += 1;
                // Without air time the next drive may have begun, whose goals are not those of this frame.
                let stands =
                    |snapshot: &&Snapshot| snapshot.run.as_ref().is_none_or(|run| run.frame == *frame);
                let robots = places.filter(stands).into_iter().flat_map(|snapshot| &snapshot.robots);
                let taking_part = robots.filter(|robot| robot.takes_part && robot.pixel.is_some());
                let error = |(at, goal): (lightbots_base::Vec2, _)| at.distance(goal);
                self.errors_m
                    .extend(taking_part.filter_map(|robot| robot.reported.at.zip(robot.goal)).map(error));
            }
            EventKind::Dropout { .. } => self.dropouts += 1,
            EventKind::Rejoined(_) => self.rejoined += 1,
            EventKind::RunEnded { outcome, frames_played, dropouts } => {
                self.outcome = Some(outcome.clone());
                self.frames_played = *frames_played;
                self.dropouts = *dropouts;
                self.duration_s = self.began.map_or(0.0, |began| (event.at - began).as_secs());
            }
            _ => {}
        }
        let counts = self.issues.len() < ISSUES_MAX || matches!(event.kind, EventKind::RunEnded { .. });
        if let (Some(issue), true) = (issue(&event.kind), counts) {
            self.issues.push(issue);
        }
    }

    /// Adds issues that are not events of the run, such as those of reading the show, in front of the others.
    pub fn add_issues(&mut self, issues: &Issues) {
        self.issues.splice(0..0, issues.iter().cloned());
    }

    /// Adds a warning of the conductor as an issue with the code `warning`, unless there are `ISSUES_MAX` issues
    /// already.
    pub fn warn(&mut self, line: String) {
        if self.issues.len() < ISSUES_MAX {
            self.issues.push(Issue::warning("warning", line));
        }
    }

    /// Whether the run has begun, with at least one robot.
    pub fn has_begun(&self) -> bool {
        self.robots > 0
    }

    /// Whether the run is over.
    pub fn is_over(&self) -> bool {
        self.outcome.is_some()
    }

    /// Whether the whole show was played, and at least as many robots came back as dropped out.
    pub fn ok(&self) -> bool {
        self.outcome == Some(RunOutcome::Finished)
            && self.frames_played >= self.frames
            && self.dropouts <= self.rejoined
    }

    /// Share of the frames that were played, 0 to 1.
    pub fn share(&self) -> f64 {
        (self.frames_played as f64 / self.frames.max(1) as f64).min(1.0)
    }
}

/// Returns the issue for an event; `None` if the event is no issue.
fn issue(kind: &EventKind) -> Option<Issue> {
    let (code, frame) = match kind {
        EventKind::Disconnected => ("broker-lost", None),
        EventKind::LinkLost { .. } => ("link-lost", None),
        EventKind::TakenUp { frame, .. } => ("taken-up", Some(*frame)),
        EventKind::Flooding(_) => ("flood", None),
        EventKind::LinkBack { .. } => ("link-back", None),
        EventKind::PlanFailed { frame, .. } => ("no-plan", Some(*frame)),
        EventKind::LeftOut { frame, .. } => ("left-out", Some(*frame)),
        EventKind::Dropout { .. } => ("dropout", None),
        EventKind::Misaligned { .. } => ("misaligned", None),
        EventKind::RunEnded { outcome: RunOutcome::Failed(_), .. } => ("run-failed", None),
        EventKind::RunEnded { outcome: RunOutcome::Aborted, .. } => ("aborted", None),
        _ => return None,
    };
    // A robot that drops out may come back, and `ok` counts whether it did.
    let severity = if code == "dropout" { Severity::Warning } else { kind.severity() };
    let issue = Issue { severity, ..Issue::error(code, kind.to_string()) };
    let issue = match kind {
        EventKind::LeftOut { pixels, .. } => issue.with_pixels(pixels.iter().copied()),
        _ => issue,
    };
    Some(frame.map_or(issue.clone(), |frame| issue.in_frame(frame)))
}

/// Prints the report on stdout, as JSON or as lines for people.
pub fn print(report: RunReport, json: bool) -> Result<(), Failure> {
    let spread = |values: &[f64], decimals: i32| rounded_spread(Spread::of(values), decimals);
    let summary = Summary {
        ok: report.ok(),
        robots: report.robots,
        frames: report.frames,
        frames_played: report.frames_played,
        duration_s: rounded(report.duration_s, 3),
        arrival_spread_s: spread(&report.spreads_s, 3),
        position_error_m: spread(&report.errors_m, 5),
        dropouts: report.dropouts,
        issues: &report.issues,
    };
    if json {
        return commands::print_json(&summary);
    }
    commands::print_issues(&summary.issues.iter().map(api::Issue::from).collect::<Vec<_>>());
    say::line(&format!(
        "{}: {} of {} frames by {} robots in {:.2} s; arrivals within {:.2} s, places within {:.1} mm (99 %); {} lost",
        if summary.ok { "fine" } else { "not played as it should be" },
        summary.frames_played,
        summary.frames,
        summary.robots,
        summary.duration_s,
        summary.arrival_spread_s.p99,
        summary.position_error_m.p99 * 1e3,
        summary.dropouts
    ));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Span;

    fn event(at_ms: u64, kind: EventKind) -> Event {
        Event { at: Instant(at_ms * 1000), kind }
    }

    #[test]
    fn a_whole_run_is_fine() {
        let mut report = RunReport { frames: 1, ..RunReport::default() };
        let starts = Instant(1_000_000);
        report.add(&event(900, EventKind::RunBegun { from: 0, robots: 3 }), None);
        let duration = Span::from_millis(2000);
        report.add(&event(950, EventKind::TransitionStarted { frame: 0, starts, duration }), None);
        let reached = EventKind::FrameReached { frame: 0, spread: Span::from_millis(80), wait: Span::ZERO };
        report.add(&event(3000, reached), None);
        assert!(!report.is_over() && !report.ok());
        let ended = EventKind::RunEnded { outcome: RunOutcome::Finished, frames_played: 1, dropouts: 0 };
        report.add(&event(4000, ended), None);
        assert!(report.is_over() && report.ok());
        assert_eq!((report.robots, report.duration_s, report.spreads_s.as_slice()), (3, 3.0, &[0.08][..]));
    }

    #[test]
    fn pixels_that_stay_dark_are_named_to_programs_too() {
        let mut report = RunReport { frames: 1, ..RunReport::default() };
        report.add(&event(1, EventKind::LeftOut { frame: 2, pixels: vec![4, 7], count: 2 }), None);
        let issue = &report.issues[0];
        assert_eq!((issue.frame, issue.pixels.as_slice()), (Some(2), &[4, 7][..]));
    }

    #[test]
    fn an_aborted_run_is_not_fine() {
        let mut report = RunReport { frames: 2, ..RunReport::default() };
        let ended = EventKind::RunEnded { outcome: RunOutcome::Aborted, frames_played: 1, dropouts: 0 };
        report.add(&event(1, ended), None);
        assert!(report.is_over() && !report.ok());
        assert_eq!(report.issues[0].code, "aborted");
    }
}

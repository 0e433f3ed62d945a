//! The sentences of a report.

use lightbots_control::{EventKind, RunOutcome};
use lightbots_show::Severity;

use crate::model::ShowReport;

/// Sums a report up in one sentence, such as "All 8 frames shown, no contacts, one robot lost." `outcome` is how the run
/// ended; `None`: the recording has no end. `frame` is the frame in which it ended, counted from 0.
pub fn verdict(report: &ShowReport, outcome: Option<&RunOutcome>, is_home: bool, frame: usize) -> String {
    let mut parts = vec![match outcome {
        _ if report.robots == 0 => return "Nothing was played.".into(),
        Some(RunOutcome::Finished) if is_home => "All robots drove home".to_owned(),
        Some(RunOutcome::Finished) => shown(report),
        Some(RunOutcome::Aborted) => format!("Stopped in frame {}; {}", frame + 1, lower(&shown(report))),
        Some(RunOutcome::Failed(why)) => why.clone(),
        None => format!("The recording ends in frame {}; {}", frame + 1, lower(&shown(report))),
    }];
    if let Some(contacts) = report.contacts {
        parts.push(some(contacts as usize, "contact"));
    }
    let lost = report.losses.iter().filter(|loss| loss.back_at_s.is_none()).count();
    parts.push(match lost {
        0 => "no robot lost".to_owned(),
        lost => format!("{} lost", some(lost, "robot")),
    });
    format!("{}.", parts.join(", "))
}

fn shown(report: &ShowReport) -> String {
    match (report.frames_played, report.frames) {
        (1, 1) => "The frame was shown".to_owned(),
        (played, wanted) if played >= wanted => format!("All {played} frames shown"),
        (played, wanted) => format!("{played} of {} shown", count(wanted, "frame")),
    }
}

fn lower(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// A number with its noun in words: `no contacts`, `one contact`, `2 contacts`.
pub(crate) fn some(number: usize, noun: &str) -> String {
    match number {
        0 => format!("no {noun}s"),
        1 => format!("one {noun}"),
        _ => count(number, noun),
    }
}

/// A number with its noun: `1 frame`, `2 frames`.
pub(crate) fn count(number: usize, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

/// A distance as text in millimetres, such as `14 mm`; below 10 mm with one decimal.
pub(crate) fn millimetres(metres: f64) -> String {
    let mm = metres * 1e3;
    if mm < 9.95 { format!("{mm:.1} mm") } else { format!("{mm:.0} mm") }
}

/// The sentence for an event, and the name of the robot that it is about, if any. `None` if reports do not list such events.
pub(crate) fn incident(kind: &EventKind) -> Option<(String, Option<String>)> {
    use EventKind::*;
    let of = |robot: &lightbots_base::RobotId| Some(robot.as_str().to_owned());
    match kind {
        Dropout { robot, why } => {
            Some((format!("Lost robot {robot}: it {why}. The show goes on without it."), of(robot)))
        }
        RunEnded { outcome: RunOutcome::Finished, .. } => Some(("Show finished.".into(), None)),
        RunEnded { outcome: RunOutcome::Aborted, .. } => Some(("The run was ended.".into(), None)),
        Rejoined(robot)
        | RobotRestarted(robot)
        | RobotStale(robot)
        | RobotGone(robot)
        | Flooding(robot)
        | UnexpectedArrival(robot) => Some((kind.to_string(), of(robot))),
        Waiting { robot, .. } | Misaligned { robot, .. } | NameShared { robot, .. } => {
            Some((kind.to_string(), of(robot)))
        }
        RunBegun { .. } | GoingHome { .. } | AtHome | WaitsForGo { .. } | LinkBack { .. } | Connected => {
            Some((kind.to_string(), None))
        }
        GoesTo { .. } | Skipped { .. } | LeftOutForMusic { .. } | LoopBegun { .. } | LeavesLoop { .. } => {
            Some((kind.to_string(), None))
        }
        _ if kind.severity() != Severity::Note => Some((kind.to_string(), None)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Loss;

    #[test]
    fn the_verdict_says_frames_contacts_and_losses() {
        let loss = |back_at_s| Loss { robot: "r7".into(), at_s: 1.0, frame: 2, why: "x".into(), back_at_s };
        let mut report = ShowReport { robots: 60, frames: 8, frames_played: 8, ..ShowReport::default() };
        report.contacts = Some(0);
        report.losses = vec![loss(None), loss(Some(3.0))];
        let say = |report: &ShowReport, outcome: RunOutcome| verdict(report, Some(&outcome), false, 2);
        let finished = say(&report, RunOutcome::Finished);
        assert_eq!(finished, "All 8 frames shown, no contacts, one robot lost.");
        (report.frames_played, report.contacts) = (2, None);
        let aborted = say(&report, RunOutcome::Aborted);
        assert_eq!(aborted, "Stopped in frame 3; 2 of 8 frames shown, one robot lost.");
        assert_eq!(verdict(&ShowReport::default(), None, false, 0), "Nothing was played.");
    }

    #[test]
    fn times_and_lengths_are_for_people() {
        assert_eq!((millimetres(0.0142), millimetres(0.0031)), ("14 mm".into(), "3.1 mm".into()));
    }
}

//! Facts of a recorded run, for lists of runs. They are kept in a small file beside the log, because the log of a long
//! run takes long to read.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use lightbots_api::RunEntryKind;
use lightbots_base::RobotId;
use lightbots_control::{Event, EventKind, Operation, RunOutcome};
use lightbots_report::{Loss, ShowReport, verdict};
use lightbots_show::Show;
use serde::{Deserialize, Serialize};

use super::clock::unix_ms;
use crate::disk::{self, Readers};

/// Longest file that is read, bytes. A longer one counts as missing.
const BYTES_MAX: u64 = 64 << 10;

/// Facts of a run: the content of the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunFacts {
    pub kind: RunEntryKind,
    /// Name that the author gave the show; may be empty.
    pub show: String,
    pub began_ms: u64,
    /// End of the run, milliseconds since 1970. `None` if the run is still going on, or if the program ended before the run.
    pub ended_ms: Option<u64>,
    pub ok: bool,
    /// How the run ended, in one sentence.
    pub outcome: Option<String>,
}

impl RunFacts {
    /// Reads the facts from a file; `None` if the file is missing or damaged.
    pub fn read(path: &Path) -> Option<Self> {
        serde_json::from_slice(&disk::read_regular(path, BYTES_MAX).ok()?).ok()
    }

    /// Writes the facts into a file, or replaces it.
    pub fn write(&self, path: &Path) -> std::io::Result<()> {
        disk::replace(path, &serde_json::to_vec(self)?, Readers::All)
    }
}

/// Collects the facts of a run while the run is going on.
#[derive(Clone, Debug, Default)]
pub struct RunNotes {
    facts: RunFacts,
    report: ShowReport,
    /// Number of frames of the show.
    frames: usize,
    frame: usize,
    /// Indices of the frames that were reached.
    shown: BTreeSet<usize>,
    /// Whether frames were played in another order than that of the show: after a jump, a skipped frame or a loop.
    is_order_changed: bool,
    /// Robots that were lost and have not come back.
    lost: BTreeMap<RobotId, Loss>,
}

impl RunNotes {
    /// Notes on a run that is about to begin.
    pub fn begin(show: Option<&Show>, kind: RunEntryKind) -> Self {
        let facts = RunFacts {
            kind,
            show: show.map_or(String::new(), |show| show.name.clone()),
            began_ms: unix_ms(),
            ..RunFacts::default()
        };
        Self { facts, frames: show.map_or(0, |show| show.frames.len()), ..Self::default() }
    }

    /// The kind of run that an operation begins; `None` if it begins none.
    pub fn kind(operation: &Operation) -> Option<RunEntryKind> {
        match operation {
            Operation::Play { .. } => Some(RunEntryKind::Show),
            Operation::Preview { .. } => Some(RunEntryKind::Frame),
            Operation::Home => Some(RunEntryKind::Home),
            _ => None,
        }
    }

    pub fn facts(&self) -> &RunFacts {
        &self.facts
    }

    /// Updates the notes by an event.
    pub fn add(&mut self, event: &Event) {
        match &event.kind {
            EventKind::RunBegun { from, robots } | EventKind::TakenUp { frame: from, robots, .. } => {
                self.report.robots = *robots;
                self.report.frames = match self.facts.kind {
                    RunEntryKind::Show => self.frames.saturating_sub(*from),
                    RunEntryKind::Frame | RunEntryKind::Home => 1,
                };
            }
            EventKind::GoingHome { robots } => (self.report.robots, self.report.frames) = (*robots, 1),
            EventKind::TransitionStarted { frame, .. } => self.frame = *frame,
            EventKind::FrameReached { frame, .. } => {
                self.frame = *frame;
                self.shown.insert(*frame);
            }
            EventKind::GoesTo { .. }
            | EventKind::Skipped { .. }
            | EventKind::LeftOutForMusic { .. }
            | EventKind::LoopBegun { .. } => {
                self.is_order_changed = true;
            }
            EventKind::Dropout { robot, why } => {
                let name = robot.as_str().to_owned();
                let loss =
                    Loss { robot: name, at_s: 0.0, frame: self.frame, why: why.to_string(), back_at_s: None };
                self.lost.insert(*robot, loss);
            }
            EventKind::Rejoined(robot) => {
                self.lost.remove(robot);
            }
            EventKind::RunEnded { outcome, frames_played, .. } => self.end(outcome, *frames_played),
            _ => {}
        }
    }

    fn end(&mut self, outcome: &RunOutcome, frames_played: usize) {
        // If the order was changed, a frame that was reached several times counts once.
        let frames_played = if self.is_order_changed { self.shown.len() } else { frames_played };
        self.report.frames_played = frames_played;
        self.report.losses = self.lost.values().cloned().collect();
        let is_home = self.facts.kind == RunEntryKind::Home;
        let is_whole = is_home || frames_played >= self.report.frames;
        self.facts.ok = *outcome == RunOutcome::Finished && is_whole && self.lost.is_empty();
        self.facts.outcome = Some(verdict(&self.report, Some(outcome), is_home, self.frame));
        self.facts.ended_ms = Some(unix_ms());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::{Instant, Span};
    use lightbots_show::Frame;

    fn after(kind: RunEntryKind, events: Vec<EventKind>) -> RunFacts {
        let show = Show { name: "Hello".into(), frames: vec![Frame::default(); 3], ..Show::default() };
        let mut notes = RunNotes::begin(Some(&show), kind);
        for kind in events {
            notes.add(&Event { at: Instant::ZERO, kind });
        }
        notes.facts().clone()
    }

    fn ended(outcome: RunOutcome, frames_played: usize) -> EventKind {
        EventKind::RunEnded { outcome, frames_played, dropouts: 0 }
    }

    #[test]
    fn the_outcome_is_what_the_report_says() {
        let begun = EventKind::RunBegun { from: 1, robots: 4 };
        let reached = EventKind::FrameReached { frame: 2, spread: Span::ZERO, wait: Span::ZERO };
        let whole = after(RunEntryKind::Show, vec![begun.clone(), ended(RunOutcome::Finished, 2)]);
        assert_eq!((whole.show.as_str(), whole.ok), ("Hello", true));
        assert_eq!(whole.outcome.as_deref(), Some("All 2 frames shown, no robot lost."));
        let stopped = after(RunEntryKind::Show, vec![begun, reached, ended(RunOutcome::Aborted, 1)]);
        assert!(!stopped.ok && stopped.ended_ms >= Some(stopped.began_ms));
        let line = "Stopped in frame 3; 1 of 2 frames shown, no robot lost.";
        assert_eq!(stopped.outcome.as_deref(), Some(line));
        let home = vec![EventKind::GoingHome { robots: 4 }, ended(RunOutcome::Finished, 0)];
        let home = after(RunEntryKind::Home, home);
        assert_eq!((home.ok, home.outcome.as_deref()), (true, Some("All robots drove home, no robot lost.")));
    }

    #[test]
    fn a_damaged_file_is_no_facts() {
        let path = std::env::temp_dir().join(format!("lightbots-facts-{}.json", std::process::id()));
        let facts = after(RunEntryKind::Show, vec![]);
        facts.write(&path).unwrap();
        assert_eq!(RunFacts::read(&path), Some(facts));
        std::fs::write(&path, b"{").unwrap();
        assert_eq!(RunFacts::read(&path), None);
        std::fs::remove_file(path).unwrap();
    }
}

//! Sums of equal events of many robots, so that a fleet of any size fills a bounded number of lines.

use std::mem::{Discriminant, discriminant};
use std::time::{Duration, Instant};

use lightbots_base::RobotId;
use lightbots_control::{EventKind, Trouble};
use lightbots_show::Severity;

/// Most robot names that a sum keeps, which bounds the message. The line counts all robots.
const NAMED: usize = 200;
/// A sum without a new event for this time is closed, and a later event begins a new line. Robots of one fleet are
/// switched on within seconds of each other.
const QUIET: Duration = Duration::from_secs(4);
/// A sum is closed after this time even if events go on, so that lines stay near the time of their events.
const LONGEST: Duration = Duration::from_secs(60);

/// Equal events of one or more robots, which make one line.
#[derive(Debug)]
pub struct Sum {
    /// Number of the sum's line in the log; `None` if the line is not written yet.
    pub line: Option<u32>,
    first: EventKind,
    robots: Vec<RobotId>,
    count: usize,
    grown: bool,
    began: Instant,
    last: Instant,
}

/// The sums that further events may still join.
#[derive(Debug, Default)]
pub struct Sums(Vec<Sum>);

impl Sums {
    /// Adds the event of a robot to its sum. `false` if events of this kind are not summed up.
    pub fn take(&mut self, now: Instant, kind: &EventKind) -> bool {
        let Some(robot) = robot_of(kind) else { return false };
        self.0.retain(|sum| sum.grown || now - sum.last < QUIET && now - sum.began < LONGEST);
        match self.0.iter_mut().find(|sum| key(&sum.first) == key(kind)) {
            Some(sum) => {
                sum.count += 1;
                (sum.grown, sum.last) = (true, now);
                if sum.robots.len() < NAMED {
                    sum.robots.push(robot);
                }
            }
            None => {
                let first = kind.clone();
                let (count, robots) = (1, vec![robot]);
                self.0.push(Sum { line: None, first, robots, count, grown: true, began: now, last: now });
            }
        }
        true
    }

    /// Calls `tell` with each sum that has grown since the last call.
    pub fn each_grown(&mut self, mut tell: impl FnMut(&mut Sum)) {
        for sum in self.0.iter_mut().filter(|sum| sum.grown) {
            sum.grown = false;
            tell(sum);
        }
    }

    /// Closes the sums of events of a run, because another event came between.
    pub fn close_run(&mut self) {
        self.0.retain(|sum| is_presence(&sum.first));
    }
}

impl Sum {
    /// Severity of the sum's events.
    pub fn severity(&self) -> Severity {
        self.first.severity()
    }

    /// Number of events, or 0 for a single one, whose robot the line names.
    pub fn count(&self) -> usize {
        if self.count > 1 { self.count } else { 0 }
    }

    /// Names of the robots, at most `NAMED`. Empty for a single one, which the line names.
    pub fn names(&self) -> Vec<String> {
        let named = if self.count > 1 { self.robots.as_slice() } else { &[] };
        named.iter().map(ToString::to_string).collect()
    }

    /// The line for people.
    pub fn text(&self) -> String {
        let count = self.count;
        if count == 1 {
            return self.first.to_string();
        }
        match &self.first {
            EventKind::RobotFound(_) => format!("{count} robots are here."),
            EventKind::RobotRestarted(_) => format!("{count} robots have restarted."),
            EventKind::RobotStale(_) => format!("{count} robots have not reported lately."),
            EventKind::RobotGone(_) => format!("{count} robots are gone."),
            EventKind::RobotBack(_) => format!("{count} robots are back."),
            EventKind::Waiting { why, .. } => {
                format!("Waiting for {count} robots. Of each: it {why}.")
            }
            EventKind::Dropout { why, .. } => format!("{count} robots drop out. Of each: it {why}."),
            EventKind::Rejoined(_) => format!("{count} robots take part from the next frame on."),
            EventKind::Misaligned { .. } => format!("{count} robots stand off their goals."),
            EventKind::UnexpectedArrival(_) => format!("{count} robots arrived unexpectedly."),
            _ => self.first.to_string(),
        }
    }
}

/// Returns the robot of an event that many robots may have at once; `None` for other events.
fn robot_of(kind: &EventKind) -> Option<RobotId> {
    use EventKind::*;
    match kind {
        RobotFound(id) | RobotRestarted(id) | RobotStale(id) | RobotGone(id) | RobotBack(id) => Some(*id),
        Rejoined(id) | UnexpectedArrival(id) => Some(*id),
        Waiting { robot, .. } | Dropout { robot, .. } | Misaligned { robot, .. } => Some(*robot),
        _ => None,
    }
}

/// Returns the key of an event: events with equal keys share a sum.
fn key(kind: &EventKind) -> (Discriminant<EventKind>, Option<Trouble>) {
    let why = match kind {
        EventKind::Waiting { why, .. } | EventKind::Dropout { why, .. } => Some(*why),
        _ => None,
    };
    (discriminant(kind), why)
}

/// Whether the event is about a robot's presence and not about a run.
fn is_presence(kind: &EventKind) -> bool {
    use EventKind::*;
    matches!(kind, RobotFound(_) | RobotRestarted(_) | RobotStale(_) | RobotGone(_) | RobotBack(_))
}

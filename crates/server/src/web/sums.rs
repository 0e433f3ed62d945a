//! What happens to many robots at once, summed up: bounded, however many they are.

use std::mem::{Discriminant, discriminant};
use std::time::{Duration, Instant};

use lightbots_base::RobotId;
use lightbots_control::{EventKind, Trouble};
use lightbots_show::Severity;

/// Names that are kept of each sum.
const NAMED: usize = 200;
/// A sum to which nothing was added for so long is closed, …
const QUIET: Duration = Duration::from_secs(4);
/// … and in any case after this.
const LONGEST: Duration = Duration::from_secs(60);

/// One thing that happened to robots, and to which.
#[derive(Debug)]
pub struct Sum {
    /// Its line in the log, once it has one.
    pub line: Option<u32>,
    first: EventKind,
    robots: Vec<RobotId>,
    count: usize,
    grown: bool,
    began: Instant,
    last: Instant,
}

/// The sums to which may be added.
#[derive(Debug, Default)]
pub struct Sums(Vec<Sum>);

impl Sums {
    /// Adds what happened to a robot; `false`: it is nothing to be summed up.
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

    /// Those that have grown since this was asked.
    pub fn each_grown(&mut self, mut tell: impl FnMut(&mut Sum)) {
        for sum in self.0.iter_mut().filter(|sum| sum.grown) {
            sum.grown = false;
            tell(sum);
        }
    }

    /// Something else happened in the run: what comes to pass with its robots now is another matter.
    pub fn close_run(&mut self) {
        self.0.retain(|sum| is_presence(&sum.first));
    }
}

impl Sum {
    /// How much it matters.
    pub fn severity(&self) -> Severity {
        self.first.severity()
    }

    /// How many robots, 0 for a single one: its line says which.
    pub fn count(&self) -> usize {
        if self.count > 1 { self.count } else { 0 }
    }

    /// Names of the first of several.
    pub fn names(&self) -> Vec<String> {
        let named = if self.count > 1 { self.robots.as_slice() } else { &[] };
        named.iter().map(ToString::to_string).collect()
    }

    /// One line for people.
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

/// Whom it happened to, where it may happen to many at once.
fn robot_of(kind: &EventKind) -> Option<RobotId> {
    use EventKind::*;
    match kind {
        RobotFound(id) | RobotRestarted(id) | RobotStale(id) | RobotGone(id) | RobotBack(id) => Some(*id),
        Rejoined(id) | UnexpectedArrival(id) => Some(*id),
        Waiting { robot, .. } | Dropout { robot, .. } | Misaligned { robot, .. } => Some(*robot),
        _ => None,
    }
}

/// What is summed up together.
fn key(kind: &EventKind) -> (Discriminant<EventKind>, Option<Trouble>) {
    let why = match kind {
        EventKind::Waiting { why, .. } | EventKind::Dropout { why, .. } => Some(*why),
        _ => None,
    };
    (discriminant(kind), why)
}

/// Whether it says who is there, rather than how a run goes.
fn is_presence(kind: &EventKind) -> bool {
    use EventKind::*;
    matches!(kind, RobotFound(_) | RobotRestarted(_) | RobotStale(_) | RobotGone(_) | RobotBack(_))
}

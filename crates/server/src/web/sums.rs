//! Sums of equal events of many robots, so that a fleet of any size fills a bounded number of lines.

use std::collections::BTreeSet;
use std::mem::{Discriminant, discriminant};
use std::time::{Duration, Instant};

use lightbots_base::RobotId;
use lightbots_control::{EventKind, Trouble};
use lightbots_show::Severity;

/// Most robot names that a sum keeps, which bounds the message. The line counts all robots.
const NAMED: usize = 200;
/// A sum without a new event for this time is closed. A later event then begins a new line. Robots of one fleet are switched
/// on within seconds of each other.
const QUIET: Duration = Duration::from_secs(4);
/// A sum is closed after this time even if events go on, so that lines stay near the time of their events.
const LONGEST: Duration = Duration::from_secs(60);

/// Equal events of one or more robots, which make one line.
#[derive(Debug)]
pub struct Sum {
    /// Number of the sum's line in the log; `None` if the line is not written yet.
    pub line: Option<u32>,
    first: EventKind,
    /// All robots with events of this sum. The controller bounds their number.
    robots: BTreeSet<RobotId>,
    /// The first robots of the sum, at most [`NAMED`], in the order of their events.
    named: Vec<RobotId>,
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
            Some(sum) => sum.add(now, robot),
            None => {
                let (first, robots, named) = (kind.clone(), [robot].into(), vec![robot]);
                self.0.push(Sum { line: None, first, robots, named, grown: true, began: now, last: now });
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

    /// Closes all sums that are about a run and not about the presence of robots, because another event came in between.
    pub fn close_run(&mut self) {
        self.0.retain(|sum| is_presence(&sum.first));
    }
}

impl Sum {
    /// Adds an event of a robot. A further event of the same robot changes nothing but the time of the last event.
    fn add(&mut self, now: Instant, robot: RobotId) {
        self.last = now;
        if self.robots.insert(robot) {
            self.grown = true;
            if self.named.len() < NAMED {
                self.named.push(robot);
            }
        }
    }

    /// Severity of the sum's events.
    pub fn severity(&self) -> Severity {
        self.first.severity()
    }

    /// Number of robots. A single robot counts as 0, because the line names it.
    pub fn count(&self) -> usize {
        if self.robots.len() > 1 { self.robots.len() } else { 0 }
    }

    /// Names of the robots, at most `NAMED`. Empty for a single robot, because the line names it.
    pub fn names(&self) -> Vec<String> {
        let named = if self.robots.len() > 1 { self.named.as_slice() } else { &[] };
        named.iter().map(ToString::to_string).collect()
    }

    /// The line for people.
    pub fn text(&self) -> String {
        let count = self.robots.len();
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

/// Returns the robot of an event of a kind that many robots may have at once. `None` for other events.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(number: usize) -> RobotId {
        RobotId::new(&format!("r{number}")).unwrap()
    }

    fn lines(sums: &mut Sums) -> Vec<(usize, usize, String)> {
        let mut lines = Vec::new();
        sums.each_grown(|sum| lines.push((sum.count(), sum.names().len(), sum.text())));
        lines
    }

    #[test]
    fn a_sum_counts_robots_and_not_their_events() {
        let (mut sums, now) = (Sums::default(), Instant::now());
        for _ in 0..3 {
            assert!(sums.take(now, &EventKind::RobotStale(robot(1))));
        }
        let one = EventKind::RobotStale(robot(1)).to_string();
        assert_eq!(lines(&mut sums), [(0, 0, one)]);
        sums.take(now, &EventKind::RobotStale(robot(1)));
        assert!(lines(&mut sums).is_empty(), "nothing new");
        for number in [2, 1, 2] {
            sums.take(now, &EventKind::RobotStale(robot(number)));
        }
        assert_eq!(lines(&mut sums), [(2, 2, "2 robots have not reported lately.".to_owned())]);
        for number in 0..500 {
            sums.take(now, &EventKind::RobotStale(robot(number)));
        }
        let line = "500 robots have not reported lately.".to_owned();
        assert_eq!(lines(&mut sums), [(500, NAMED, line)]);
    }
}

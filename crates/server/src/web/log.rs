//! The log that screens show. Equal events of many robots make one line, which is replaced while more robots join it.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use lightbots_api::{Level, LogLine};
use lightbots_show::Severity;
use tokio::sync::broadcast;
use tokio::time::Instant;

use super::sums::{Sum, Sums};
use crate::live::clock::unix_ms;
use crate::live::conductor::News;
use crate::sentences::sentence;

/// Most lines that a new screen gets: several screens full. Older lines are dropped, which bounds the memory.
const KEPT: usize = 300;
/// Longest delay after which a grown line that counts robots is sent again; other news sends it earlier. Five versions a
/// second look like one change. A shorter time could send one message for each robot of a large fleet.
const GROWS: Duration = Duration::from_millis(200);

/// The last lines, and a channel for later ones. Clones share the log.
#[derive(Clone, Debug)]
pub struct ScreenLog {
    kept: Arc<Mutex<Kept>>,
    lines: broadcast::Sender<LogLine>,
}

#[derive(Debug, Default)]
struct Kept {
    lines: VecDeque<LogLine>,
    last_id: u32,
}

impl ScreenLog {
    /// An empty log.
    pub fn new() -> Self {
        Self { kept: Arc::default(), lines: broadcast::channel(1024).0 }
    }

    /// Adds a line.
    pub fn say(&self, level: Level, text: impl Into<String>) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let id = kept.next_id();
        let line = LogLine { id, time_ms: unix_ms(), level, text: text.into(), count: 0, robots: Vec::new() };
        self.add(&mut kept, line);
    }

    /// Adds the line of a sum, which counts equal events. If the line was added before, replaces it.
    fn sum(&self, sum: &mut Sum) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let known = sum.line.and_then(|id| kept.lines.iter().rposition(|line| line.id == id));
        let (id, time_ms) = match known {
            Some(index) => (kept.lines[index].id, kept.lines[index].time_ms),
            None => (kept.next_id(), unix_ms()),
        };
        sum.line = Some(id);
        let level = level(sum.severity());
        let line = LogLine { id, time_ms, level, text: sum.text(), count: sum.count(), robots: sum.names() };
        match known {
            Some(index) => {
                kept.lines[index] = line.clone();
                // Without a screen there is no receiver, which is not an error.
                let _ = self.lines.send(line);
            }
            None => self.add(&mut kept, line),
        }
    }

    fn add(&self, kept: &mut Kept, line: LogLine) {
        if kept.lines.len() == KEPT {
            kept.lines.pop_front();
        }
        kept.lines.push_back(line.clone());
        // Without a screen there is no receiver, which is not an error.
        let _ = self.lines.send(line);
    }

    /// The last lines, oldest first, and a receiver of all later ones.
    pub fn read(&self) -> (Vec<LogLine>, broadcast::Receiver<LogLine>) {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        (kept.lines.iter().cloned().collect(), self.lines.subscribe())
    }

    /// Adds the conductor's events, its warnings and the reasons of a missing link to the log until the conductor ends.
    pub async fn follow(self, mut news: broadcast::Receiver<News>) {
        let mut sums = Sums::default();
        let mut due: Option<Instant> = None;
        loop {
            let heard = tokio::select! {
                heard = news.recv() => heard,
                () = sleep_until(due) => {
                    due = None;
                    sums.each_grown(|sum| self.sum(sum));
                    continue;
                }
            };
            match heard {
                Ok(News::Event(event)) if sums.take(std::time::Instant::now(), &event.kind) => {
                    due.get_or_insert(Instant::now() + GROWS);
                }
                Ok(news) => {
                    // Sums are written first, because their events came before this one.
                    sums.each_grown(|sum| self.sum(sum));
                    sums.close_run();
                    self.write(news);
                }
                Err(broadcast::error::RecvError::Lagged(missed)) => {
                    self.say(Level::Warn, format!("{missed} lines were too many to show."));
                }
                Err(broadcast::error::RecvError::Closed) => {
                    sums.each_grown(|sum| self.sum(sum));
                    return;
                }
            }
        }
    }

    fn write(&self, news: News) {
        match news {
            News::Event(event) => self.say(level(event.kind.severity()), event.kind.to_string()),
            News::Link(link) => {
                if let Some(reason) = link.reason.clone().filter(|_| !link.is_connected()) {
                    self.say(Level::Warn, sentence(&reason));
                }
            }
            News::Warning(line) => self.say(Level::Warn, line),
        }
    }
}

impl Kept {
    fn next_id(&mut self) -> u32 {
        self.last_id = self.last_id.wrapping_add(1);
        self.last_id
    }
}

async fn sleep_until(due: Option<Instant>) {
    match due {
        Some(due) => tokio::time::sleep_until(due).await,
        None => std::future::pending().await,
    }
}

fn level(severity: Severity) -> Level {
    match severity {
        Severity::Note => Level::Info,
        Severity::Warning => Level::Warn,
        Severity::Error => Level::Error,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::{Instant, RobotId};
    use lightbots_control::{Event, EventKind};

    fn robot(kind: fn(RobotId) -> EventKind, number: usize) -> News {
        let id = RobotId::new(&format!("r{number}")).unwrap();
        News::Event(Event { at: Instant::ZERO, kind: kind(id) })
    }

    async fn lines_of(news: Vec<News>) -> Vec<LogLine> {
        let (teller, told) = broadcast::channel(32_768);
        for news in news {
            teller.send(news).unwrap();
        }
        drop(teller);
        let log = ScreenLog::new();
        log.clone().follow(told).await;
        log.read().0
    }

    #[tokio::test]
    async fn ten_thousand_robots_are_one_line_that_names_the_first() {
        let opened = News::Warning("A show is open.".into());
        let mut news: Vec<News> = (0..10_000).map(|number| robot(EventKind::RobotFound, number)).collect();
        news.insert(5_000, opened.clone());
        news.push(opened);
        let lines = lines_of(news).await;
        assert_eq!(lines.len(), 3, "{lines:?}");
        assert_eq!((lines[0].text.as_str(), lines[0].count), ("10000 robots are here.", 10_000));
        assert!(lines[0].robots.len() < 1_000 && lines[0].robots[..2] == ["r0", "r1"]);
    }

    #[tokio::test]
    async fn one_robot_is_named_and_waits_are_told_apart() {
        let wait = |number| {
            robot(|robot| EventKind::Waiting { robot, why: lightbots_control::Trouble::Late }, number)
        };
        let on = News::Event(Event { at: Instant::ZERO, kind: EventKind::Resumed });
        let lines = lines_of(vec![wait(1), on.clone(), wait(2), wait(3), on]).await;
        let texts: Vec<&str> = lines.iter().map(|line| line.text.as_str()).collect();
        let first = "Waiting for robot r1: it is behind its path.";
        let then = "Waiting for 2 robots. Of each: it is behind its path.";
        assert_eq!(texts, [first, "Resumed.", then, "Resumed."]);
    }
}

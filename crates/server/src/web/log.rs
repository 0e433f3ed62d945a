//! The log that screens show.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};

use lightbots_api::{Level, LogLine};
use lightbots_show::Severity;
use tokio::sync::broadcast;

use crate::live::clock::unix_ms;
use crate::live::conductor::News;

/// Lines a new screen is shown.
const KEPT: usize = 300;

/// The last lines, and those to come. Clones share it.
#[derive(Clone, Debug)]
pub struct Log {
    kept: Arc<Mutex<VecDeque<LogLine>>>,
    lines: broadcast::Sender<LogLine>,
}

impl Log {
    /// An empty log.
    pub fn new() -> Self {
        Self { kept: Arc::default(), lines: broadcast::channel(1024).0 }
    }

    /// Adds a line.
    pub fn say(&self, level: Level, text: impl Into<String>) {
        let line = LogLine { time_ms: unix_ms(), level, text: text.into() };
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.len() == KEPT {
            kept.pop_front();
        }
        kept.push_back(line.clone());
        // No screen is no error.
        let _ = self.lines.send(line);
    }

    /// The last lines, oldest first, and all that follow.
    pub fn read(&self) -> (Vec<LogLine>, broadcast::Receiver<LogLine>) {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        (kept.iter().cloned().collect(), self.lines.subscribe())
    }

    /// Writes down what happens, until the conductor ends.
    pub async fn follow(self, mut news: broadcast::Receiver<News>) {
        loop {
            match news.recv().await {
                Ok(News::Event(event)) => self.say(level(event.kind.severity()), event.kind.to_string()),
                Ok(News::Link(link)) => {
                    if let Some(reason) = link.reason.clone().filter(|_| !link.is_connected()) {
                        self.say(Level::Warn, capitalised(&reason));
                    }
                }
                Ok(News::Warning(line)) => self.say(Level::Warn, line),
                Err(broadcast::error::RecvError::Lagged(missed)) => {
                    self.say(Level::Warn, format!("{missed} lines were too many to show."));
                }
                Err(broadcast::error::RecvError::Closed) => return,
            }
        }
    }
}

fn level(severity: Severity) -> Level {
    match severity {
        Severity::Note => Level::Info,
        Severity::Warning => Level::Warn,
        Severity::Error => Level::Error,
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}

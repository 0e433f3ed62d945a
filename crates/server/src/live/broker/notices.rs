//! What the embedded broker refused, for log and screen: each client is heard of now and then, not all the time.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use tokio::sync::mpsc;

/// A client that goes on is named again after `EVERY`.
const EVERY: Duration = Duration::from_secs(5);
/// Clients remembered at most; of more of them nothing is said until the first are forgotten.
const CLIENTS: usize = 1000;
/// Lines that wait at most; more are only logged.
const WAITING: usize = 64;

/// Takes lines about clients.
#[derive(Debug)]
pub struct Notices {
    sender: mpsc::Sender<String>,
    said: Mutex<BTreeMap<String, Said>>,
}

#[derive(Debug)]
struct Said {
    at: Instant,
    /// Lines kept back since.
    more: u64,
}

impl Notices {
    /// Notices, and where they come out.
    pub fn new() -> (Self, mpsc::Receiver<String>) {
        let (sender, lines) = mpsc::channel(WAITING);
        (Self { sender, said: Mutex::default() }, lines)
    }

    /// Says a line about a client, unless one was said about it a moment ago.
    pub fn say(&self, client: &str, line: &str) {
        let Some(kept_back) = self.due(client, Instant::now()) else { return };
        let more = if kept_back > 0 { format!(" ({kept_back} more like this)") } else { String::new() };
        let line = format!("{line}{more}");
        tracing::warn!("{line}");
        // Nobody listening is no error.
        let _ = self.sender.try_send(line);
    }

    /// How many lines about it were kept back; `None` where this one is, too.
    fn due(&self, client: &str, now: Instant) -> Option<u64> {
        let mut said = self.said.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(last) = said.get_mut(client) {
            if now.duration_since(last.at) < EVERY {
                last.more += 1;
                return None;
            }
            last.at = now;
            return Some(std::mem::take(&mut last.more));
        }
        if said.len() >= CLIENTS {
            said.retain(|_, last| now.duration_since(last.at) < EVERY);
        }
        if said.len() >= CLIENTS {
            return None;
        }
        said.insert(client.to_owned(), Said { at: now, more: 0 });
        Some(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_noisy_client_is_named_now_and_then() {
        let (notices, _lines) = Notices::new();
        let now = Instant::now();
        assert_eq!(notices.due("a", now), Some(0));
        assert_eq!(notices.due("a", now), None);
        assert_eq!(notices.due("b", now), Some(0));
        assert_eq!(notices.due("a", now + EVERY), Some(1));
        for number in 0..2 * CLIENTS {
            notices.due(&number.to_string(), now + EVERY);
        }
        assert_eq!(notices.said.lock().unwrap().len(), CLIENTS);
    }
}

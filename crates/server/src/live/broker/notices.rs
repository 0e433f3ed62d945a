//! Lines about what the embedded broker refused, for log and screen. Each client gets a bounded number of lines.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use tokio::sync::mpsc;

/// Shortest time between two lines about a client.
const EVERY: Duration = Duration::from_secs(5);
/// Most clients that are remembered. Lines about further clients are dropped until earlier clients are forgotten.
const CLIENTS: usize = 1000;
/// Most lines that wait for the screen; further ones are only logged.
const WAITING: usize = 64;

/// Passes lines about clients to log and screen: for each client at most one line per `EVERY`.
#[derive(Debug)]
pub struct Notices {
    sender: mpsc::Sender<String>,
    said: Mutex<BTreeMap<String, Said>>,
}

#[derive(Debug)]
struct Said {
    at: Instant,
    /// Number of lines about the client that were kept back since `at`.
    more: u64,
}

impl Notices {
    /// Returns notices and the receiver of their lines.
    pub fn new() -> (Self, mpsc::Receiver<String>) {
        let (sender, lines) = mpsc::channel(WAITING);
        (Self { sender, said: Mutex::default() }, lines)
    }

    /// Logs and sends a line about a client. Keeps it back if the last line about this client was sent less than
    /// `EVERY` ago. Drops it if `CLIENTS` other clients had their last line less than `EVERY` ago.
    pub fn say(&self, client: &str, line: &str) {
        let Some(kept_back) = self.due(client, Instant::now()) else { return };
        let more = if kept_back > 0 { format!(" ({kept_back} more like this)") } else { String::new() };
        let line = format!("{line}{more}");
        tracing::warn!("{line}");
        // A line without a listener is only logged.
        let _ = self.sender.try_send(line);
    }

    /// Returns how many lines about a client were kept back since its last line. `None` if the present line must not be
    /// sent.
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

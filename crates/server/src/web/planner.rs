//! Runs plan requests of clients: one at a time for each client, for a bounded time, and only while the client waits.
//!
//! A newer request of a client cancels the older one, because an editor's older document is of no use. No client can
//! make others wait. A client is an IP address.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::sync::watch;

/// Time beyond the budget to end the work and to send the answer.
const ANSWER: Duration = Duration::from_secs(10);

/// Why the work on a request gave no result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutOff {
    /// The work took longer than the budget.
    TimeUp,
    /// The client sent a newer request.
    Superseded,
    /// The work panicked.
    Failed,
}

/// Cancels work on another thread when [`GiveUp::now`] is called, or when the value is dropped.
#[derive(Debug, Default)]
pub struct GiveUp(Arc<AtomicBool>);

/// Tells the working thread whether [`GiveUp`] has cancelled its work.
#[derive(Clone, Debug)]
pub struct IsGivenUp(Arc<AtomicBool>);

/// Runs the plan requests of all clients.
#[derive(Debug)]
pub struct Planner {
    budget: Duration,
    clients: Mutex<BTreeMap<IpAddr, Arc<Client>>>,
}

/// The requests of one client.
#[derive(Debug, Default)]
struct Client {
    /// Number of the client's newest request.
    newest: watch::Sender<u64>,
    /// Locked while a thread works on a request of the client.
    slot: Arc<tokio::sync::Mutex<()>>,
}

impl GiveUp {
    /// Returns the flag for the working thread.
    pub fn asked(&self) -> IsGivenUp {
        IsGivenUp(self.0.clone())
    }

    /// Cancels the work now.
    pub fn now(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

impl Drop for GiveUp {
    fn drop(&mut self) {
        self.now();
    }
}

impl IsGivenUp {
    /// Whether the work is cancelled.
    pub fn get(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Planner {
    /// A planner that cancels each request after `budget`.
    pub fn new(budget: Duration) -> Self {
        Self { budget, clients: Mutex::default() }
    }

    /// Returns the longest time of a request.
    pub fn budget(&self) -> Duration {
        self.budget
    }

    /// Returns the longest time for which a client waits for the answer to a request without sending.
    pub fn longest_wait(&self) -> Duration {
        self.budget + ANSWER
    }

    /// Runs `work` for a client on a separate thread. `work` gets a function that returns whether the work is cancelled. It
    /// must call that function often, and end soon once the function returns `true`. The work is cancelled when the budget
    /// is used up, when the client sends a newer request, or when this future is dropped. The client's next request begins
    /// when `work` has ended.
    pub async fn work<T: Send + 'static>(
        &self,
        client: IpAddr,
        work: impl FnOnce(&dyn Fn() -> bool) -> T + Send + 'static,
    ) -> Result<T, CutOff> {
        let client = self.client(client);
        let mut newest = client.newest.subscribe();
        let mut number = 0;
        client.newest.send_modify(|newest| {
            *newest += 1;
            number = *newest;
        });
        let is_superseded = async {
            // The sender lives as long as the client's entry.
            let _ = newest.wait_for(|newest| *newest != number).await;
        };
        let give_up = GiveUp::default();
        let is_given_up = give_up.asked();
        let worked = async {
            let turn = client.slot.clone().lock_owned().await;
            let thread = tokio::task::spawn_blocking(move || {
                let _turn = turn;
                work(&|| is_given_up.get())
            });
            thread.await.map_err(|_| CutOff::Failed)
        };
        tokio::select! {
            biased;
            () = is_superseded => Err(CutOff::Superseded),
            done = tokio::time::timeout(self.budget, worked) => done.unwrap_or(Err(CutOff::TimeUp)),
        }
    }

    /// Returns the client of an address. Removes clients that have no request, which bounds the map.
    fn client(&self, address: IpAddr) -> Arc<Client> {
        // Entries are inserted in one step, so that a panic of another thread leaves no half-made ones.
        let mut clients = self.clients.lock().unwrap_or_else(PoisonError::into_inner);
        clients.retain(|_, client| Arc::strong_count(client) > 1 || client.slot.try_lock().is_err());
        clients.entry(address).or_default().clone()
    }
}

#[cfg(test)]
#[path = "planner_tests.rs"]
mod tests;

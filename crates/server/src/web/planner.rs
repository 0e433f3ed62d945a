//! Plans that clients ask for: of each client the newest request alone, for a limited time, and only while it waits.
//!
//! A newer request of the same client supersedes the older one, rather than wait behind it: what an editor asks about has
//! changed by then, and no client can make others queue up. Clients are told apart by their IP addresses.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use tokio::sync::watch;

/// Why there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutOff {
    /// It took longer than the budget.
    TimeUp,
    /// The same client asked again.
    Superseded,
    /// It panicked.
    Failed,
}

/// Tells work on another thread to give up, at the latest when this is dropped.
#[derive(Debug, Default)]
pub struct GiveUp(Arc<AtomicBool>);

/// What the other thread asks.
#[derive(Clone, Debug)]
pub struct IsGivenUp(Arc<AtomicBool>);

/// Gives clients their turns.
#[derive(Debug)]
pub struct Planner {
    budget: Duration,
    clients: Mutex<BTreeMap<IpAddr, Arc<Client>>>,
}

/// The turns of one client.
#[derive(Debug, Default)]
struct Client {
    /// Number of its newest request.
    newest: watch::Sender<u64>,
    /// Held while one is worked on, by the thread that does.
    slot: Arc<tokio::sync::Mutex<()>>,
}

impl GiveUp {
    /// What the other thread asks.
    pub fn asked(&self) -> IsGivenUp {
        IsGivenUp(self.0.clone())
    }

    /// Gives up now.
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
    /// Whether to give up.
    pub fn get(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

impl Planner {
    /// Whatever is asked for takes no longer than this.
    pub fn new(budget: Duration) -> Self {
        Self { budget, clients: Mutex::default() }
    }

    /// How long anything may take.
    pub fn budget(&self) -> Duration {
        self.budget
    }

    /// Works for a client on a thread of its own. `work` is to ask now and then whether it is given up, and to end soon
    /// where it is: when time is up, when the same client asks again, or when this future is dropped because the client
    /// has gone. The next request of the client begins once it has ended.
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
            // The sender lives as long as the client.
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

    /// The client of an address; forgets clients without work.
    fn client(&self, address: IpAddr) -> Arc<Client> {
        // Entries are whole ones: a panic elsewhere leaves none half made.
        let mut clients = self.clients.lock().unwrap_or_else(PoisonError::into_inner);
        clients.retain(|_, client| Arc::strong_count(client) > 1 || client.slot.try_lock().is_err());
        clients.entry(address).or_default().clone()
    }
}

#[cfg(test)]
#[path = "planner_tests.rs"]
mod tests;

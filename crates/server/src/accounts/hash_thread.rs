//! The thread that hashes passwords, one after the other.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Sender, channel};

use tokio::sync::{OwnedSemaphorePermit, Semaphore, oneshot};

/// Work for the thread: one hash.
type Job = Box<dyn FnOnce() + Send>;

/// A separate thread that hashes passwords, because hashing on the threads of the runtime would delay connections. A hash
/// takes a processor and 19 MiB, some of which the allocator keeps afterwards. In one test (2026-11-27, glibc), the
/// allocator kept up to 78 MB after hashing on the runtime's threads. After hashing on this thread, it was 59 MB.
#[derive(Debug)]
pub struct HashThread {
    jobs: Sender<Job>,
    turns: Arc<Semaphore>,
}

/// The right of one request to hash. No other request hashes while this value exists.
#[derive(Debug)]
pub struct HashTurn {
    _permit: Option<OwnedSemaphorePermit>,
}

impl HashThread {
    /// Starts the thread. The thread ends when the returned value is dropped. Error if the operating system cannot start a
    /// thread.
    pub fn start() -> Result<Self, String> {
        let (jobs, inbox) = channel::<Job>();
        let thread = std::thread::Builder::new().name("passwords".into()).spawn(move || {
            for job in inbox {
                // A panic fails only its own request, for which `run` returns `None`.
                let _ = catch_unwind(AssertUnwindSafe(job));
            }
        });
        thread.map_err(|error| format!("the system gives no thread for passwords: {error}"))?;
        Ok(Self { jobs, turns: Arc::new(Semaphore::new(1)) })
    }

    /// Waits until no other request hashes. A request that is cancelled while it waits gives up its place in the queue.
    pub async fn turn(&self) -> HashTurn {
        // The semaphore is never closed.
        HashTurn { _permit: self.turns.clone().acquire_owned().await.ok() }
    }

    /// Runs `hash` on the thread, and returns its result and the turn. The turn is held until `hash` has ended, even if the
    /// request is cancelled. Cancelled requests thus do not queue up here. `None` if `hash` panicked.
    pub async fn run<T: Send + 'static>(
        &self,
        turn: HashTurn,
        hash: impl FnOnce() -> T + Send + 'static,
    ) -> Option<(T, HashTurn)> {
        let (done, hashed) = oneshot::channel();
        let job: Job = Box::new(move || {
            let _ = done.send((hash(), turn));
        });
        self.jobs.send(job).ok()?;
        hashed.await.ok()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::sync_channel;

    use super::*;

    #[tokio::test]
    async fn a_request_that_was_given_up_or_failed_makes_no_other_wait_for_ever() {
        let hashing = HashThread::start().unwrap();
        let (go_on, waiting) = sync_channel::<()>(0);
        let turn = hashing.turn().await;
        let mut given_up = Box::pin(hashing.run(turn, move || waiting.recv().is_ok()));
        let begun = tokio::time::timeout(std::time::Duration::from_millis(1), &mut given_up);
        assert!(begun.await.is_err(), "it hashes until it may go on");
        drop(given_up);
        assert_eq!(hashing.turns.available_permits(), 0, "the turn is that of the hashing");
        go_on.send(()).unwrap();
        let turn = hashing.turn().await;
        assert!(hashing.run(turn, || -> bool { panic!("a failure on purpose") }).await.is_none());
        let turn = hashing.turn().await;
        let (hashed, turn) = hashing.run(turn, || 7).await.unwrap();
        assert_eq!((hashed, hashing.turns.available_permits()), (7, 0));
        drop(turn);
        assert_eq!(hashing.turns.available_permits(), 1);
    }
}

//! Work that may run on several threads. The planner itself starts no threads; its caller passes in a [`Workers`].

/// A task. Its arguments are its index and a function that the task polls. Once that function returns `true`, the task
/// is cancelled and should return soon.
pub type WorkerTask<'a> = &'a (dyn Fn(usize, &dyn Fn() -> bool) + Sync);

/// Runs independent tasks.
pub trait Workers {
    /// Calls `task(index, is_cancelled)` once for each index below `count`, in any order and on any threads, and
    /// returns after all calls have returned. An implementation calls its own argument `is_cancelled` on the calling
    /// thread only. Soon after that argument returns `true`, the functions that were given to the tasks must return
    /// `true` as well.
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>);
}

/// Runs all tasks one after the other on the calling thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneThread;

impl Workers for OneThread {
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>) {
        (0..count).for_each(|index| task(index, is_cancelled));
    }
}

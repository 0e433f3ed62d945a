//! Work that may run on several threads. The planner starts no threads: a [`Workers`] is passed in.

/// A task, called with its index and a function. The task polls the function, and is cancelled once it returns `true`.
pub type WorkerTask<'a> = &'a (dyn Fn(usize, &dyn Fn() -> bool) + Sync);

/// Runs independent tasks.
pub trait Workers {
    /// Calls `task(index, is_wanted)` once for each index below `count`, in any order and on any thread, and returns
    /// after all calls. `is_cancelled` is called on the calling thread only. Soon after it returns `true`, the tasks'
    /// `is_wanted` returns `true` as well.
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>);
}

/// Runs the tasks one after the other on the calling thread.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneThread;

impl Workers for OneThread {
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>) {
        (0..count).for_each(|index| task(index, is_cancelled));
    }
}

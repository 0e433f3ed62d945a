//! Work that may run on several threads. The planner starts none: they are passed in.

/// One task; it is cancelled once the function says so, which the task polls.
pub type WorkerTask<'a> = &'a (dyn Fn(usize, &dyn Fn() -> bool) + Sync);

/// Runs independent tasks.
pub trait Workers {
    /// Calls `task(index, is_wanted)` once for each index below `count`, in any order and on any thread, and returns when
    /// all calls have returned. `is_cancelled` is asked on the calling thread only; each task gets a function that says yes
    /// soon after.
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>);
}

/// The calling thread, one task after the other.
#[derive(Clone, Copy, Debug, Default)]
pub struct OneThread;

impl Workers for OneThread {
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>) {
        (0..count).for_each(|index| task(index, is_cancelled));
    }
}

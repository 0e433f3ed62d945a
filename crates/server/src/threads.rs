//! Threads for the planner: one per processor core.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use lightbots_plan::{WorkerTask, Workers};

/// Interval at which the calling thread checks for a cancellation while it waits for the other threads. A cancelled plan
/// thus ends as early as in the planner's own loops.
const POLL: Duration = Duration::from_millis(10);
/// Most threads. Memory limits their number, because each thread plans a drive of up to 10,000 robots.
const MOST: usize = 16;

/// Worker threads for the planner: one per core, at most [`MOST`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Threads;

impl Workers for Threads {
    fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>) {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        on_threads(cores.min(MOST).min(count), count, is_cancelled, task);
    }
}

fn on_threads(threads: usize, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>) {
    let (next, cancelled) = (AtomicUsize::new(0), AtomicBool::new(false));
    let work = |is_cancelled: &dyn Fn() -> bool| {
        while let Some(index) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&index| index < count) {
            task(index, is_cancelled);
        }
    };
    let ask = || {
        if is_cancelled() {
            cancelled.store(true, Ordering::Relaxed);
        }
        cancelled.load(Ordering::Relaxed)
    };
    std::thread::scope(|scope| {
        let others: Vec<_> =
            (1..threads).map(|_| scope.spawn(|| work(&|| cancelled.load(Ordering::Relaxed)))).collect();
        work(&ask);
        while !others.iter().all(std::thread::ScopedJoinHandle::is_finished) {
            ask();
            std::thread::sleep(POLL);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_plan::{OneThread, ShowOptions, show_with};
    use lightbots_show::Show;
    use std::sync::Mutex;

    #[test]
    fn each_task_runs_once_on_any_number_of_threads() {
        for (threads, count) in [(1, 0), (1, 5), (3, 2), (4, 100)] {
            let runs = Mutex::new(vec![0; count]);
            on_threads(threads, count, &|| false, &|index, _| runs.lock().unwrap()[index] += 1);
            assert_eq!(runs.into_inner().unwrap(), vec![1; count]);
        }
    }

    #[test]
    fn a_cancellation_reaches_tasks_on_all_threads() {
        let ended = AtomicUsize::new(0);
        on_threads(3, 3, &|| true, &|_, is_cancelled| {
            while !is_cancelled() {
                std::thread::yield_now();
            }
            ended.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(ended.into_inner(), 3);
    }

    /// Plans a show on a given number of threads.
    struct Many(usize);

    impl Workers for Many {
        fn each(&self, count: usize, is_cancelled: &dyn Fn() -> bool, task: WorkerTask<'_>) {
            on_threads(self.0, count, is_cancelled, task);
        }
    }

    #[test]
    fn a_plan_has_the_same_bits_on_any_number_of_threads() {
        let bytes = include_bytes!("../../../shows/rings.lightbots.json");
        let show: Show = lightbots_exchange::read(bytes, Some("json")).unwrap().show;
        let starts = lightbots_show::starting_places(&show);
        let plan = |workers: &dyn Workers| {
            show_with(workers, &show, &starts, &ShowOptions::default(), &|| false).unwrap()
        };
        let one = plan(&OneThread);
        assert!(one.ok());
        for threads in [2, 5] {
            assert!(plan(&Many(threads)) == one, "{threads} threads");
        }
    }
}

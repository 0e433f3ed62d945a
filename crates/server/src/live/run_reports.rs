//! Reports of runs, made while the runs are on.
//!
//! To make the report of half an hour with a thousand robots from the whole log takes minutes. A thread that replays
//! the log while it is written stays about a second behind. It needs a fraction of a processor core.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;

use lightbots_report::{GrowingReport, page};

use crate::disk::{self, Readers};

/// Most pieces of a log, about a second each, that wait for their report.
const WAITING_MAX: usize = 256;

/// The logs whose reports are being made.
#[derive(Clone, Debug, Default)]
pub struct ReportsUnderWay(Arc<Mutex<BTreeSet<PathBuf>>>);

impl ReportsUnderWay {
    /// Whether the report of this log is being made. The report is ready soon after the run. If making the report fails, it
    /// can still be made from the whole log.
    pub fn contains(&self, log: &Path) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).contains(log)
    }

    fn begin(&self, log: &Path) -> UnderWay {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).insert(log.to_owned());
        UnderWay(self.clone(), log.to_owned())
    }
}

/// Marks the report of a log as being made, until this value is dropped.
struct UnderWay(ReportsUnderWay, PathBuf);

impl Drop for UnderWay {
    fn drop(&mut self) {
        self.0.0.lock().unwrap_or_else(PoisonError::into_inner).remove(&self.1);
    }
}

/// What the thread receives.
enum Piece {
    /// The next bytes of the log.
    Log(Vec<u8>),
    /// The log is complete.
    End,
}

/// Makes the report of one run. If the value is dropped without [`end`](Self::end), no report is written.
pub struct RunReporter {
    pieces: SyncSender<Piece>,
    /// Whether the run is over. People then wait for its report, so the thread no longer gives way to others.
    is_over: Arc<AtomicBool>,
    thread: JoinHandle<()>,
}

impl RunReporter {
    /// Starts the thread that makes the report of the run with this log, and writes it to `file`.
    pub fn start(log: &Path, file: PathBuf, reports: &ReportsUnderWay) -> Self {
        let (pieces, inbox) = sync_channel(WAITING_MAX);
        let under_way = reports.begin(log);
        let is_over = Arc::new(AtomicBool::new(false));
        let over = is_over.clone();
        let thread = std::thread::spawn(move || {
            let _under_way = under_way;
            set_priority(NICE);
            // If the recorded controller panicked, the replayed one panics as well.
            let made = catch_unwind(AssertUnwindSafe(|| make(&inbox, &file, &over)));
            match made {
                Ok(Ok(())) => {}
                Ok(Err(line)) => tracing::warn!("no report was made during the run: {line}"),
                Err(_) => tracing::warn!("no report was made during the run: the controller failed"),
            }
        });
        Self { pieces, is_over, thread }
    }

    /// Passes bytes of the log to the thread. Returns `false` if the thread is too slow or has failed. A slow thread ends
    /// without a report once this value is dropped.
    pub fn feed(&self, bytes: Vec<u8>) -> bool {
        self.pieces.try_send(Piece::Log(bytes)).is_ok()
    }

    /// Marks the log as complete and waits for the report. If the program did not wait, the run could stay without a report.
    pub fn end(self) {
        self.is_over.store(true, Ordering::Relaxed);
        // A thread that failed has logged why. A thread that is too slow ends when `pieces` is dropped.
        let _ = self.pieces.try_send(Piece::End);
        drop(self.pieces);
        // The thread has logged its own failure.
        let _ = self.thread.join();
    }
}

fn make(inbox: &Receiver<Piece>, file: &Path, is_over: &AtomicBool) -> Result<(), String> {
    let mut report = GrowingReport::default();
    let mut gives_way = true;
    loop {
        let piece = inbox.recv();
        if gives_way && is_over.load(Ordering::Relaxed) {
            set_priority(0);
            gives_way = false;
        }
        match piece {
            Ok(Piece::Log(bytes)) => report.feed(&bytes).map_err(|error| error.to_string())?,
            Ok(Piece::End) => break,
            Err(_) => return Err("this machine is too slow for it, or the log was cut off".into()),
        }
    }
    let (report, scrub) = report.finish().map_err(|error| error.to_string())?;
    let page = page(&report, &scrub).into_bytes();
    disk::replace(file, &page, Readers::All).map_err(|error| error.to_string())
}

/// Niceness of the thread while the show plays: the default of the command `nice`. Beside a busy thread of usual niceness,
/// it gets about a tenth of that thread's processor time.
const NICE: i32 = 10;

/// Sets the niceness of this thread on Linux. Does nothing on other systems.
#[cfg_attr(
    not(target_os = "linux"),
    expect(unused_variables, reason = "other systems have no threads with a priority")
)]
fn set_priority(nice: i32) {
    // On Linux, this concerns the calling thread alone. To lower the niceness again needs a right; without it the
    // niceness stays.
    #[cfg(target_os = "linux")]
    let _ = rustix::process::setpriority_process(None, nice);
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use lightbots_base::Instant;
    use lightbots_control::{Config, Controller, RecordedController};
    use lightbots_report::report_of;

    use super::*;

    fn report_file(log: &Path) -> PathBuf {
        log.with_extension("html")
    }

    fn log() -> Vec<u8> {
        let mut controller = RecordedController::new(Controller::new(Config::default()));
        assert!(controller.begin_log(Instant(1_000_000), Vec::new()));
        for second in 1..40 {
            controller.message(Instant(second * 1_000_000), "T/LightBot/UUID", b"a 0.5 1.3");
            controller.wake(Instant(second * 1_000_000 + 1));
            while controller.next_send().is_some() {}
            while controller.next_event().is_some() {}
            while controller.next_plan_request().is_some() {}
        }
        let mut log = controller.take_log();
        log.extend(controller.end_log());
        log
    }

    fn wait_for(reports: &ReportsUnderWay, log: &Path) {
        while reports.contains(log) {
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    #[test]
    fn the_report_made_during_a_run_is_that_of_its_whole_log() {
        let folder = std::env::temp_dir().join(format!("lightbots-reports-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let (reports, path) = (ReportsUnderWay::default(), folder.join("000001.lblog"));
        let log = log();
        let reporter = RunReporter::start(&path, report_file(&path), &reports);
        for bytes in log.chunks(100) {
            assert!(reporter.feed(bytes.to_vec()));
        }
        assert!(reports.contains(&path) && !report_file(&path).exists());
        reporter.end();
        assert!(!reports.contains(&path));
        let (report, scrub) = report_of(&log, &mut |_| {}).unwrap();
        assert_eq!(std::fs::read_to_string(report_file(&path)).unwrap(), page(&report, &scrub));

        let other = folder.join("000002.lblog");
        let reporter = RunReporter::start(&other, report_file(&other), &reports);
        assert!(reporter.feed(log[..log.len() / 2].to_vec()));
        drop(reporter);
        wait_for(&reports, &other);
        assert!(!report_file(&other).exists(), "the run was cut off");
        std::fs::remove_dir_all(folder).unwrap();
    }
}

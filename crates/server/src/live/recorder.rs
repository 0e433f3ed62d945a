//! Files of the controller's input log. A thread of its own writes them, so that a slow disk never delays a show.

use std::fs::{DirEntry, File};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, OnceLock};
use std::thread::JoinHandle;

use lightbots_api::RunEntryKind;
use lightbots_base::Instant;
use lightbots_control::{Event, OnReturn, Operation, RecordedController, Refusal, UnfinishedRun};

use super::clock::unix_ms;
use super::journal::JournalFile;
use super::run_facts::{RunFacts, RunNotes};
use super::run_reports::{ReportsUnderWay, RunReporter};
use crate::disk;

/// Folder of recorded runs in the data folder.
const FOLDER: &str = "runs";
/// Ending of a recorded run.
const ENDING: &str = ".lblog";
/// Most recorded runs that are kept.
const RUNS_MAX: usize = 20;
/// Most bytes that all recorded runs may have; older ones are deleted.
const BYTES_MAX: u64 = 1 << 30;
/// Most bytes of one recorded run; what comes later is not recorded.
pub const RUN_BYTES_MAX: u64 = 256 << 20;
/// Most pieces of a log, about a second each, that wait for the disk.
const WAITING_MAX: usize = 256;

/// What is recorded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum RecordingTarget {
    /// Nothing.
    Off,
    /// Everything, into this file.
    File(PathBuf),
    /// Each run, into a file of its own in this data folder.
    Runs(PathBuf),
}

impl RecordingTarget {
    /// Whether each run has a log of its own.
    fn is_by_run(&self) -> bool {
        matches!(self, Self::Runs(_))
    }

    /// Where the journal of runs is written.
    fn data_folder(&self) -> Option<&Path> {
        match self {
            Self::Runs(data) => Some(data),
            _ => None,
        }
    }
}

/// Keeps the log of a controller, and the journal of its runs.
#[derive(Debug)]
pub struct Recorder {
    recording: RecordingTarget,
    writer: Option<LogWriter>,
    journal: Option<JournalFile>,
    /// The run that is on.
    run: Option<RunNotes>,
    reports: ReportsUnderWay,
}

impl Recorder {
    /// A recorder for a controller that is new.
    pub fn new(recording: RecordingTarget, controller: &mut RecordedController, now: Instant) -> Self {
        if matches!(recording, RecordingTarget::File(_)) {
            controller.begin_log(now, notes("play"));
        }
        let journal = recording.data_folder().map(|data| JournalFile::start(data, controller));
        let reports = ReportsUnderWay::default();
        Self { recording, writer: None, journal, run: None, reports }
    }

    /// The logs whose reports are being made.
    pub fn reports(&self) -> ReportsUnderWay {
        self.reports.clone()
    }

    /// The operator asks for something: a run may begin.
    pub fn before(&mut self, controller: &mut RecordedController, now: Instant, operation: &Operation) {
        let Some(kind) = RunNotes::kind(operation) else { return };
        if self.recording.is_by_run() && !controller.is_recording() && controller.begin_log(now, notes("run"))
        {
            self.run = Some(RunNotes::begin(controller.show().map(|show| &**show), kind));
        }
    }

    /// Takes in what the controller says.
    pub fn note(&mut self, event: &Event) {
        if let Some(run) = &mut self.run {
            run.add(event);
        }
    }

    /// Has the controller take up a run that was cut off.
    pub fn take_up(
        &mut self,
        controller: &mut RecordedController,
        now: Instant,
        (run, on_return): (&UnfinishedRun, OnReturn),
    ) -> Result<(), Refusal> {
        if self.recording.is_by_run() {
            let taken_up = ("taken_up".to_owned(), format!("on the way to frame {}", run.frame() + 1));
            controller.begin_log(now, notes("run").into_iter().chain([taken_up]).collect());
            self.run = Some(RunNotes::begin(Some(run.show()), RunEntryKind::Show));
        }
        let done = controller.take_up(now, run, on_return);
        if let Some(journal) = self.journal.as_mut().filter(|_| !controller.has_run()) {
            journal.discard();
        }
        done
    }

    /// Hands on what is new in log and journal. Lines for people, once something went wrong.
    pub fn keep(&mut self, controller: &mut RecordedController) -> impl Iterator<Item = String> + use<> {
        let line = self.journal.as_mut().and_then(|journal| journal.keep(controller));
        self.keep_log(controller).into_iter().chain(line)
    }

    fn keep_log(&mut self, controller: &mut RecordedController) -> Option<String> {
        if !controller.is_recording() {
            return None;
        }
        let is_over = self.recording.is_by_run() && !controller.has_run();
        if is_over && self.writer.is_none() {
            // The run was refused.
            self.run = None;
            controller.end_log();
            return None;
        }
        let mut failure = self.write(controller.take_log());
        if is_over || failure.is_some() {
            failure = self.write(controller.end_log()).or(failure);
            self.write_facts();
            (self.writer, self.run) = (None, None);
        }
        failure.map(|line| format!("The run is not recorded any further: {line}."))
    }

    /// The program ends: waits for the disk.
    pub fn finish(mut self, controller: &mut RecordedController) {
        let _ = self.write(controller.end_log());
        self.write_facts();
        if let Some(writer) = self.writer {
            writer.finish();
        }
        if let Some(journal) = self.journal {
            journal.finish(controller);
        }
    }

    fn write(&mut self, bytes: Vec<u8>) -> Option<String> {
        if bytes.is_empty() {
            return None;
        }
        if self.writer.is_none() {
            self.writer = Some(LogWriter::start(self.recording.clone(), self.reports.clone())?);
            self.write_facts();
        }
        self.writer.as_mut().and_then(|writer| writer.write(bytes))
    }

    /// Hands on the facts of the run as they are now.
    fn write_facts(&self) {
        if let (Some(writer), Some(run)) = (&self.writer, &self.run) {
            // A disk that is too slow is told by the log.
            let _ = writer.pieces.try_send(Piece::Facts(run.facts().clone()));
        }
    }
}

/// What people should know of a log of this command.
fn notes(command: &str) -> Vec<(String, String)> {
    vec![("command".to_owned(), command.to_owned()), ("began_unix_ms".to_owned(), unix_ms().to_string())]
}

/// The file of a recorded run by its number.
pub fn run_file(data: &Path, number: u64) -> PathBuf {
    data.join(FOLDER).join(format!("{number:06}{ENDING}"))
}

/// What the thread writes.
#[derive(Debug)]
enum Piece {
    /// The next bytes of the log.
    Log(Vec<u8>),
    /// The facts beside it.
    Facts(RunFacts),
}

/// The file with the facts of a run, beside its log.
pub fn facts_file(log: &Path) -> PathBuf {
    log.with_extension("json")
}

/// The file with the report of a run, beside its log, once it was asked for.
pub fn report_file(log: &Path) -> PathBuf {
    log.with_extension("html")
}

/// A thread that writes one log.
#[derive(Debug)]
struct LogWriter {
    pieces: SyncSender<Piece>,
    written: u64,
    bytes_max: u64,
    failure: Arc<OnceLock<String>>,
    thread: JoinHandle<()>,
}

impl LogWriter {
    /// `None`: nothing is recorded.
    fn start(recording: RecordingTarget, reports: ReportsUnderWay) -> Option<Self> {
        if recording == RecordingTarget::Off {
            return None;
        }
        let bytes_max = if recording.is_by_run() { RUN_BYTES_MAX } else { u64::MAX };
        let (pieces, inbox) = sync_channel(WAITING_MAX);
        let failure = Arc::new(OnceLock::new());
        let failed = failure.clone();
        let thread = std::thread::spawn(move || {
            if let Err(error) = write_log(&recording, &inbox, &reports) {
                // The first failure is told.
                let _ = failed.set(error.to_string());
            }
        });
        Some(Self { pieces, written: 0, bytes_max, failure, thread })
    }

    fn write(&mut self, bytes: Vec<u8>) -> Option<String> {
        if let Some(line) = self.failure.get() {
            return Some(line.clone());
        }
        self.written += bytes.len() as u64;
        if self.written > self.bytes_max {
            return Some(format!("its log has {} MB", self.bytes_max >> 20));
        }
        self.pieces.try_send(Piece::Log(bytes)).err().map(|_| "the disk is too slow".to_owned())
    }

    fn finish(self) {
        drop(self.pieces);
        // A failure of the thread was told before, or it came too late to be told.
        let _ = self.thread.join();
    }
}

/// Writes pieces into a file until there are no more. That of a run becomes its report meanwhile.
fn write_log(
    recording: &RecordingTarget,
    inbox: &Receiver<Piece>,
    reports: &ReportsUnderWay,
) -> std::io::Result<()> {
    let path = match recording {
        RecordingTarget::Off => return Ok(()),
        RecordingTarget::File(path) => path.clone(),
        RecordingTarget::Runs(data) => next_run(data)?,
    };
    let mut file = File::create(&path)?;
    let mut reporter = recording.is_by_run().then(|| RunReporter::start(&path, report_file(&path), reports));
    for piece in inbox {
        match piece {
            Piece::Log(bytes) => {
                file.write_all(&bytes)?;
                reporter = reporter.filter(|reporter| reporter.feed(bytes));
            }
            Piece::Facts(facts) => facts.write(&facts_file(&path))?,
        }
    }
    file.sync_all()?;
    if let Some(reporter) = reporter {
        reporter.end();
    }
    Ok(())
}

/// The file of the next run; old ones are deleted.
fn next_run(data: &Path) -> std::io::Result<PathBuf> {
    let folder = data.join(FOLDER);
    disk::create_folder(&folder)?;
    let runs = recorded_runs(data)?;
    let mut bytes = RUN_BYTES_MAX;
    for (place, &(number, length)) in runs.iter().enumerate() {
        bytes += length;
        if place + 1 >= RUNS_MAX || bytes > BYTES_MAX {
            remove_run(data, number)?;
        }
    }
    Ok(run_file(data, runs.first().map_or(1, |&(number, _)| number + 1)))
}

fn remove_run(data: &Path, number: u64) -> std::io::Result<()> {
    let log = run_file(data, number);
    for beside in [facts_file(&log), report_file(&log)] {
        match disk::remove(&beside) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    disk::remove(&log)
}

/// Numbers and lengths of the recorded runs, the newest first.
pub fn recorded_runs(data: &Path) -> std::io::Result<Vec<(u64, u64)>> {
    let folder = match std::fs::read_dir(data.join(FOLDER)) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        folder => folder?,
    };
    let mut runs: Vec<(u64, u64)> = folder.flatten().filter_map(run_of_entry).collect();
    runs.sort_unstable_by(|a, b| b.cmp(a));
    Ok(runs)
}

/// Number and length of a recorded run.
fn run_of_entry(entry: DirEntry) -> Option<(u64, u64)> {
    let name = entry.file_name();
    let number = name.to_str()?.strip_suffix(ENDING)?.parse().ok()?;
    Some((number, entry.metadata().ok().filter(|file| file.is_file())?.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_runs_are_kept() {
        let data = std::env::temp_dir().join(format!("lightbots-runs-{}", std::process::id()));
        for number in 1..=25 {
            let path = next_run(&data).unwrap();
            assert_eq!(path, run_file(&data, number));
            for file in [&path, &facts_file(&path), &report_file(&path)] {
                File::create(file).unwrap();
            }
        }
        let kept: Vec<u64> = recorded_runs(&data).unwrap().iter().map(|run| run.0).collect();
        assert_eq!(kept, (6..=25).rev().collect::<Vec<_>>());
        assert_eq!(std::fs::read_dir(data.join(FOLDER)).unwrap().count(), 3 * kept.len());
        let large = File::create(run_file(&data, 25)).unwrap();
        large.set_len(BYTES_MAX).unwrap();
        next_run(&data).unwrap();
        assert_eq!(std::fs::read_dir(data.join(FOLDER)).unwrap().count(), 0);
        std::fs::remove_dir_all(data).unwrap();
    }
}

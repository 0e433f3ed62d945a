//! Writes the controller's input log and the facts of its runs to files. A thread for each log does this, so that a
//! slow disk does not delay a show.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::JoinHandle;

use lightbots_api::RunEntryKind;
use lightbots_base::Instant;
use lightbots_control::{Event, OnReturn, Operation, RecordedController, Refusal, UnfinishedRun};

use super::clock::unix_ms;
use super::journal::JournalFile;
use super::run_facts::{RunFacts, RunNotes};
use super::run_files::{RUN_BYTES_MAX, facts_file, next_run, report_file};
use super::run_reports::{ReportsUnderWay, RunReporter};

/// Most pieces of a log, about a second each, that wait for the disk. If a further piece comes, the log ends.
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

    /// The data folder in which the journal of runs is written; `None` unless each run has its own log.
    fn data_folder(&self) -> Option<&Path> {
        match self {
            Self::Runs(data) => Some(data),
            _ => None,
        }
    }
}

/// Records the log of a controller, and the journal of its runs.
#[derive(Debug)]
pub struct Recorder {
    recording: RecordingTarget,
    writer: Option<LogWriter>,
    /// Threads of logs that have ended. They may still be writing.
    closing: Vec<JoinHandle<()>>,
    journal: Option<JournalFile>,
    /// Notes on the present run, if each run has a log of its own. They stay if the log ends before the run does.
    run: Option<RunNotes>,
    reports: ReportsUnderWay,
    /// Most bytes of the log of a run.
    run_bytes_max: u64,
}

impl Recorder {
    /// A recorder for a new controller. Begins the log if everything goes into one file, and the journal if each run
    /// has its own log.
    pub fn new(recording: RecordingTarget, controller: &mut RecordedController, now: Instant) -> Self {
        if matches!(recording, RecordingTarget::File(_)) {
            controller.begin_log(now, notes("play"));
        }
        let journal = recording.data_folder().map(|data| JournalFile::start(data, controller));
        let reports = ReportsUnderWay::default();
        let run_bytes_max = RUN_BYTES_MAX;
        Self { recording, writer: None, closing: Vec::new(), journal, run: None, reports, run_bytes_max }
    }

    /// The logs whose reports are being made.
    pub fn reports(&self) -> ReportsUnderWay {
        self.reports.clone()
    }

    /// Begins the log of a run, if `operation` begins a run, each run has its own log, and no log is being recorded.
    /// Call this before the operation.
    pub fn before(&mut self, controller: &mut RecordedController, now: Instant, operation: &Operation) {
        let Some(kind) = RunNotes::kind(operation) else { return };
        if self.recording.is_by_run() && !controller.is_recording() && controller.begin_log(now, notes("run"))
        {
            self.run = Some(RunNotes::begin(controller.show().map(|show| &**show), kind));
        }
    }

    /// Adds an event of the controller to the notes on the run.
    pub fn note(&mut self, event: &Event) {
        if let Some(run) = &mut self.run {
            run.add(event);
        }
    }

    /// Makes the controller take up a run that was cut off. If each run has its own log, begins the log of this run first.
    /// If the controller has no run afterwards, removes the journal.
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

    /// Passes new bytes of the log and the journal to the threads that write them. Returns one line for people if the log
    /// failed, and one if the journal failed.
    pub fn keep(&mut self, controller: &mut RecordedController) -> impl Iterator<Item = String> + use<> {
        let line = self.journal.as_mut().and_then(|journal| journal.keep(controller));
        self.keep_log(controller).into_iter().chain(line)
    }

    fn keep_log(&mut self, controller: &mut RecordedController) -> Option<String> {
        let is_over = self.recording.is_by_run() && !controller.has_run();
        if !controller.is_recording() {
            if is_over && self.run.is_some() {
                self.end_run();
            }
            return None;
        }
        if is_over && self.writer.is_none() {
            // No log was written before, so that the run was refused.
            self.run = None;
            controller.end_log();
            return None;
        }
        let mut failure = self.write(controller.take_log());
        if is_over || failure.is_some() {
            failure = self.write(controller.end_log()).or(failure);
        }
        // If the log of a run ended before the run, the writer stays for the facts at the end of the run.
        if is_over || !self.recording.is_by_run() && failure.is_some() {
            self.end_run();
        }
        failure.map(|line| format!("The run is not recorded any further: {line}."))
    }

    /// Passes the final facts of the run to its writer, and lets the writer close the files.
    fn end_run(&mut self) {
        self.write_facts();
        self.run = None;
        self.closing.retain(|thread| !thread.is_finished());
        self.closing.extend(self.writer.take().map(|writer| writer.thread));
    }

    /// Ends log and journal when the program ends. Waits for the threads that write files and make reports.
    pub fn finish(mut self, controller: &mut RecordedController) {
        let _ = self.write(controller.end_log());
        self.write_facts();
        if let Some(journal) = self.journal {
            journal.finish(controller);
        }
        // These threads wait for reports, which take longer than the journal. A failure was reported before, or came
        // too late.
        for thread in self.closing.into_iter().chain(self.writer.map(|writer| writer.thread)) {
            let _ = thread.join();
        }
    }

    fn write(&mut self, bytes: Vec<u8>) -> Option<String> {
        if bytes.is_empty() {
            return None;
        }
        if self.writer.is_none() {
            self.writer =
                Some(LogWriter::start(self.recording.clone(), self.reports.clone(), self.run_bytes_max)?);
            self.write_facts();
        }
        self.writer.as_mut().and_then(|writer| writer.write(bytes))
    }

    /// Passes the facts of the run, as they are now, to the writer.
    fn write_facts(&self) {
        if let (Some(writer), Some(run)) = (&self.writer, &self.run) {
            *writer.shared.facts.lock().unwrap_or_else(PoisonError::into_inner) = Some(run.facts().clone());
            // If there is no room, the thread finds the facts when it ends.
            let _ = writer.pieces.try_send(Piece::Facts);
        }
    }
}

/// Notes for people in a log: the command that writes it, and the time.
fn notes(command: &str) -> Vec<(String, String)> {
    vec![("command".to_owned(), command.to_owned()), ("began_unix_ms".to_owned(), unix_ms().to_string())]
}

/// What the thread writes.
#[derive(Debug)]
enum Piece {
    /// The next bytes of the log.
    Log(Vec<u8>),
    /// There are new facts of the run, for the file beside the log.
    Facts,
}

/// What a writing thread shares.
#[derive(Debug, Default)]
struct SharedWithWriter {
    /// The newest facts of the run that are not written yet.
    facts: Mutex<Option<RunFacts>>,
    /// Why the thread failed first.
    failure: OnceLock<String>,
}

impl SharedWithWriter {
    fn write_facts(&self, log: &Path) -> std::io::Result<()> {
        let facts = self.facts.lock().unwrap_or_else(PoisonError::into_inner).take();
        facts.map_or(Ok(()), |facts| facts.write(&facts_file(log)))
    }

    fn fail(&self, error: &std::io::Error) {
        // Only the first failure is reported.
        let _ = self.failure.set(error.to_string());
    }
}

/// A thread that writes one log, and the sending side of its queue.
#[derive(Debug)]
struct LogWriter {
    pieces: SyncSender<Piece>,
    written: u64,
    bytes_max: u64,
    shared: Arc<SharedWithWriter>,
    thread: JoinHandle<()>,
}

impl LogWriter {
    /// Starts the thread. `None` if nothing is recorded.
    fn start(recording: RecordingTarget, reports: ReportsUnderWay, run_bytes_max: u64) -> Option<Self> {
        if recording == RecordingTarget::Off {
            return None;
        }
        let bytes_max = if recording.is_by_run() { run_bytes_max } else { u64::MAX };
        let (pieces, inbox) = sync_channel(WAITING_MAX);
        let shared = Arc::new(SharedWithWriter::default());
        let of_thread = shared.clone();
        let thread = std::thread::spawn(move || {
            // `LogWriter::write` reports the failure.
            write_log(&recording, &inbox, &of_thread, &reports)
                .unwrap_or_else(|error| of_thread.fail(&error));
        });
        Some(Self { pieces, written: 0, bytes_max, shared, thread })
    }

    fn write(&mut self, bytes: Vec<u8>) -> Option<String> {
        if let Some(line) = self.shared.failure.get() {
            return Some(line.clone());
        }
        self.written += bytes.len() as u64;
        if self.written > self.bytes_max {
            return Some(format!("its log has {} MB", self.bytes_max >> 20));
        }
        self.pieces.try_send(Piece::Log(bytes)).err().map(|_| "the disk is too slow".to_owned())
    }
}

/// Writes pieces into a file until their sender is dropped. If each run has its own log, the run's report is made meanwhile.
fn write_log(
    recording: &RecordingTarget,
    inbox: &Receiver<Piece>,
    shared: &SharedWithWriter,
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
        let written = match piece {
            // A log with a gap cannot be replayed.
            Piece::Log(_) if shared.failure.get().is_some() => Ok(()),
            Piece::Log(bytes) => {
                let written = file.write_all(&bytes);
                reporter = reporter.filter(|reporter| reporter.feed(bytes));
                written
            }
            Piece::Facts => shared.write_facts(&path),
        };
        if let Err(error) = written {
            shared.fail(&error);
            // A report of a part would look like that of the whole run.
            reporter = None;
        }
    }
    shared.write_facts(&path)?;
    file.sync_all()?;
    if let Some(reporter) = reporter {
        reporter.end();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use lightbots_base::Vec2;
    use lightbots_control::{Config, Controller, MissingPolicy};
    use lightbots_show::{Frame, Pixel, Show};

    use super::*;

    /// Begins a run in which a show leads one resting robot away.
    fn run_begun(recorder: &mut Recorder, controller: &mut RecordedController) {
        let pixel = Pixel { at: Vec2::new(0.5, 0.5), ..Pixel::default() };
        let frame = Frame { pixels: vec![pixel], ..Frame::default() };
        let show = Arc::new(Show { frames: vec![frame], ..Show::default() });
        controller.connected(Instant(1_000));
        controller.message(Instant(2_000), "T/LightBot/UUID", b"a 0.5 1.3");
        controller.operate(Instant(3_000), Operation::Open(show)).unwrap();
        // A log can begin only when no outputs of the controller wait to be taken.
        listen(recorder, controller);
        let play = Operation::Play { from: 0, missing: MissingPolicy::Refuse };
        recorder.before(controller, Instant(4_000), &play);
        controller.operate(Instant(4_000), play).unwrap();
    }

    /// Passes new events of the controller to the recorder. Returns the recorder's lines for people.
    fn listen(recorder: &mut Recorder, controller: &mut RecordedController) -> Vec<String> {
        while let Some(event) = controller.next_event() {
            recorder.note(&event);
        }
        while controller.next_send().is_some() {}
        while controller.next_plan_request().is_some() {}
        recorder.keep(controller).collect()
    }

    #[test]
    fn facts_that_found_no_room_are_written_at_the_end() {
        let path = std::env::temp_dir().join(format!("lightbots-facts-{}.lblog", std::process::id()));
        let (_, inbox) = sync_channel(1);
        let shared = SharedWithWriter::default();
        *shared.facts.lock().unwrap() = Some(RunFacts { show: "a".into(), ..RunFacts::default() });
        let target = RecordingTarget::File(path.clone());
        write_log(&target, &inbox, &shared, &ReportsUnderWay::default()).unwrap();
        assert_eq!(RunFacts::read(&facts_file(&path)).unwrap().show, "a");
        std::fs::remove_file(facts_file(&path)).unwrap();
        std::fs::remove_file(path).unwrap();
    }

    #[test]
    fn a_run_that_is_longer_than_its_log_ends_in_the_list() {
        let data = std::env::temp_dir().join(format!("lightbots-long-run-{}", std::process::id()));
        let mut controller = RecordedController::new(Controller::new(Config::default()));
        let target = RecordingTarget::Runs(data.clone());
        let mut recorder = Recorder::new(target, &mut controller, Instant(0));
        recorder.run_bytes_max = 4_000;
        run_begun(&mut recorder, &mut controller);
        let mut said = Vec::new();
        // A log has pieces of about a second.
        for moment in 0..1_000 {
            controller.message(Instant(5_000 + moment * 20_000), "T/LightBot/UUID", b"a 0.5 1.3");
            said.extend(listen(&mut recorder, &mut controller));
        }
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].contains("not recorded any further"), "{said:?}");
        assert!(controller.has_run() && !controller.is_recording());
        controller.operate(Instant(21_000_000), Operation::Abort).unwrap();
        for moment in 0..1_000 {
            controller.wake(Instant(22_000_000 + moment * 10_000));
            listen(&mut recorder, &mut controller);
        }
        assert!(!controller.has_run());
        recorder.finish(&mut controller);
        let facts = facts_file(&crate::live::run_files::run_file(&data, 1));
        assert!(RunFacts::read(&facts).is_some_and(|facts| facts.ended_ms.is_some()));
        std::fs::remove_dir_all(data).unwrap();
    }
}

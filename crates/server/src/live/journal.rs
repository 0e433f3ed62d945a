//! The file of the journal of a run. A thread of its own writes it, so that a slow disk never delays a show.

use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbots_control::{JOURNAL_OUTDATED, JournalPiece, RecordedController, UnfinishedRun};

use super::clock::computer_time;
use crate::disk::{self, Readers};

/// Path of the journal of the present run in the data folder. The file is removed when the run has ended.
const FILE: &str = "runs/present.lbjournal";
/// Longest journal that is read, bytes. The controller begins a journal again long before it is that long.
const BYTES_MAX: u64 = 256 << 20;
/// Most pieces that wait for the disk. While this many wait, further changes stay in the controller.
const WAITING_MAX: usize = 64;
/// Pause after a failure of the disk before the journal is written again.
const TRY_AGAIN: Duration = Duration::from_secs(10);

/// Reads the unfinished run from the journal that a killed program left in its data folder. `None` if there is no journal,
/// or if its run had ended; such a journal is removed. `Err`: a line for people.
pub fn unfinished_run(data: &Path) -> Result<Option<UnfinishedRun>, String> {
    let path = data.join(FILE);
    if let Some(folder) = path.parent() {
        disk::remove_drafts(folder);
    }
    let bytes = match disk::read_regular(&path, BYTES_MAX) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unreadable(&path, &error.to_string())),
    };
    let run = UnfinishedRun::read(&bytes).map_err(|error| unreadable(&path, &error.to_string()))?;
    if run.is_none() {
        // The program was killed after the end of the run, before it removed the file.
        disk::remove(&path).map_err(|error| unreadable(&path, &error.to_string()))?;
    }
    Ok(run)
}

fn unreadable(path: &Path, why: &str) -> String {
    format!("the journal of the last run, {}, cannot be used: {why}", path.display())
}

/// Keeps the journal of a controller's runs on the disk.
#[derive(Debug)]
pub struct JournalFile {
    pieces: SyncSender<JournalPiece>,
    shared: Arc<Shared>,
    thread: JoinHandle<()>,
    /// Time of the last failure to write. `None` if writing works, or is being tried again.
    tried: Option<Instant>,
    /// Whether a failure was reported to people. Only the first failure is reported.
    is_told: bool,
}

/// What the writing thread shares: the number of pieces that wait to be written, and its last failure.
#[derive(Debug, Default)]
struct Shared {
    waiting: AtomicUsize,
    failure: Mutex<Option<String>>,
}

impl JournalFile {
    /// Begins to write the journals of the controller's runs into this data folder.
    pub fn start(data: &Path, controller: &mut RecordedController) -> Self {
        controller.keep_journal();
        let (pieces, inbox) = sync_channel(WAITING_MAX);
        let shared = Arc::new(Shared::default());
        let mut file = Written { path: data.join(FILE), file: None };
        let of_thread = shared.clone();
        let thread = std::thread::spawn(move || file.write_all(&inbox, &of_thread));
        Self { pieces, shared, thread, tried: None, is_told: false }
    }

    /// Passes new pieces of the journal to the thread. Returns a line for people at the first failure to write,
    /// otherwise `None`.
    pub fn keep(&mut self, controller: &mut RecordedController) -> Option<String> {
        let failure = self.shared.failure.lock().unwrap_or_else(PoisonError::into_inner).take();
        if failure.is_some() {
            self.tried = Some(Instant::now());
        } else if self.tried.take_if(|tried| tried.elapsed() > TRY_AGAIN).is_some() {
            controller.begin_journal_again();
        }
        if self.shared.waiting.load(Ordering::Relaxed) < WAITING_MAX {
            self.send(controller);
        }
        let line = |why| {
            format!("The run could not be gone on with after a crash: its journal is not written: {why}.")
        };
        let failure = failure.filter(|_| !self.is_told)?;
        self.is_told = true;
        Some(line(failure))
    }

    fn send(&mut self, controller: &mut RecordedController) {
        let Some(piece) = controller.take_journal(computer_time()) else { return };
        self.shared.waiting.fetch_add(1, Ordering::Relaxed);
        if self.pieces.try_send(piece).is_err() {
            self.shared.waiting.fetch_sub(1, Ordering::Relaxed);
            controller.begin_journal_again();
        }
    }

    /// Makes the writing thread remove the journal, because its run is not taken up.
    pub fn discard(&mut self) {
        self.shared.waiting.fetch_add(1, Ordering::Relaxed);
        // There is room, because runs are found at the start, when the queue is empty.
        let _ = self.pieces.try_send(JournalPiece { begins: false, ends: true, bytes: Vec::new() });
    }

    /// Passes on the last pieces when the program ends. Waits until everything is written.
    pub fn finish(mut self, controller: &mut RecordedController) {
        self.keep(controller);
        drop(self.pieces);
        // A failure of the thread was reported before, or came too late.
        let _ = self.thread.join();
    }
}

/// The journal's file, for the writing thread.
struct Written {
    path: PathBuf,
    /// The open journal. `None` if no journal has begun, if the last one has ended, or if writing it failed. Pieces that
    /// are to be appended are then dropped. A file can be removed from a disk that cannot be written.
    file: Option<File>,
}

impl Written {
    /// Writes pieces until their sender is dropped. Writes all waiting pieces before each synchronisation with the
    /// disk.
    fn write_all(&mut self, inbox: &Receiver<JournalPiece>, shared: &Shared) {
        while let Ok(first) = inbox.recv() {
            let pieces: Vec<JournalPiece> = std::iter::once(first).chain(inbox.try_iter()).collect();
            shared.waiting.fetch_sub(pieces.len(), Ordering::Relaxed);
            for piece in &pieces {
                self.write(piece).unwrap_or_else(|error| self.fail(&error, shared));
            }
            let synced = self.file.as_ref().map_or(Ok(()), File::sync_data);
            synced.unwrap_or_else(|error| self.fail(&error, shared));
        }
    }

    fn write(&mut self, piece: &JournalPiece) -> std::io::Result<()> {
        if piece.ends {
            self.file = None;
            disk::remove(&self.path)?;
        } else if piece.begins {
            disk::replace(&self.path, &piece.bytes, Readers::All)?;
            self.file = Some(OpenOptions::new().append(true).open(&self.path)?);
        } else if let Some(file) = &mut self.file {
            file.write_all(&piece.bytes)?;
        }
        Ok(())
    }

    /// Reports a failure, and marks the journal on the disk as outdated.
    fn fail(&mut self, error: &std::io::Error, shared: &Shared) {
        self.file = None;
        if let Err(error) = self.mark_outdated() {
            tracing::debug!("the journal could not be marked as outdated: {error}");
        }
        *shared.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
    }

    fn mark_outdated(&self) -> std::io::Result<()> {
        let (at, mark) = JOURNAL_OUTDATED;
        let mut file = OpenOptions::new().write(true).open(&self.path)?;
        file.seek(SeekFrom::Start(at as u64))?;
        file.write_all(&[mark])?;
        file.sync_data()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::{Instant, Span};
    use lightbots_control::{Config, Controller, MissingPolicy, OnReturn, Operation};
    use lightbots_show::{Frame, Pixel, Show};

    /// A controller in a run of one robot, whose journal is written.
    fn playing() -> RecordedController {
        let mut controller = RecordedController::new(Controller::new(Config::default()));
        controller.connected(Instant(1));
        let frame = Frame { pixels: vec![Pixel::default()], ..Frame::default() };
        let show = Show { frames: vec![frame], ..Show::default() };
        controller.operate(Instant(2), Operation::Open(Arc::new(show))).unwrap();
        controller.message(Instant(3), "T/LightBot/Status", b"a 0.5 0.5 st=idle");
        controller
    }

    fn begin(controller: &mut RecordedController, at: Instant) {
        let play = Operation::Play { from: 0, missing: MissingPolicy::Refuse };
        controller.operate(at, play).unwrap();
    }

    #[test]
    fn a_run_is_in_the_folder_until_it_has_ended() {
        let data = std::env::temp_dir().join(format!("lightbots-journal-{}", std::process::id()));
        assert_eq!(unfinished_run(&data), Ok(None));
        let mut controller = playing();
        let mut journal = JournalFile::start(&data, &mut controller);
        begin(&mut controller, Instant(4));
        assert_eq!(journal.keep(&mut controller), None);
        journal.finish(&mut controller);
        let run = unfinished_run(&data).unwrap().unwrap();
        assert_eq!((run.frame(), run.show().frames.len()), (0, 1));

        let mut journal = JournalFile::start(&data, &mut controller);
        controller.operate(Instant(3), Operation::Abort).unwrap();
        controller.operate(Instant(4), Operation::StopAll).unwrap();
        controller.wake(Instant(9_000_000));
        controller.message(Instant(9_000_001), "T/LightBot/Status", b"a 0.5 0.5 st=idle");
        begin(&mut controller, Instant(9_000_002));
        journal.keep(&mut controller);
        controller.operate(Instant(9_000_010), Operation::Abort).unwrap();
        journal.finish(&mut controller);
        assert_eq!(unfinished_run(&data), Ok(None));
        assert!(!data.join(FILE).exists());

        std::fs::write(data.join(FILE), b"LBotsJrn\x63\x00").unwrap();
        assert!(unfinished_run(&data).unwrap_err().contains("format 99"));
        std::fs::remove_dir_all(data).unwrap();
    }

    #[test]
    fn a_disk_that_cannot_be_written_is_told_once() {
        let data = std::env::temp_dir().join(format!("lightbots-no-journal-{}", std::process::id()));
        // A file is in the place of the folder.
        std::fs::write(&data, b"").unwrap();
        let mut controller = playing();
        let mut journal = JournalFile::start(&data, &mut controller);
        begin(&mut controller, Instant(4));
        let mut told = Vec::new();
        while told.is_empty() {
            told.extend(journal.keep(&mut controller));
        }
        assert!(told[0].contains("journal is not written"), "{told:?}");
        controller.operate(Instant(5), Operation::Pause).unwrap();
        assert_eq!(journal.keep(&mut controller), None);

        // The end of the run removes an older journal, although none can be written.
        std::fs::remove_file(&data).unwrap();
        std::fs::create_dir_all(data.join("runs")).unwrap();
        std::fs::write(data.join(FILE), b"an older journal").unwrap();
        controller.operate(Instant(6), Operation::Abort).unwrap();
        journal.finish(&mut controller);
        assert!(!data.join(FILE).exists());
        std::fs::remove_dir_all(data).unwrap();
    }

    #[test]
    fn a_journal_that_lacks_an_entry_says_so() {
        let data = std::env::temp_dir().join(format!("lightbots-outdated-journal-{}", std::process::id()));
        let mut controller = playing();
        controller.keep_journal();
        begin(&mut controller, Instant(4));
        let mut written = Written { path: data.join(FILE), file: None };
        written.write(&controller.take_journal(computer_time()).unwrap()).unwrap();
        let may_go_on = || {
            let run = unfinished_run(&data).unwrap().unwrap();
            run.goes_on_within(run.last_change(), OnReturn::GoOrAsk, &Config::default().waits) > Span::ZERO
        };
        assert!(may_go_on());

        // A file that is open for reading alone cannot be appended to.
        written.file = Some(File::open(data.join(FILE)).unwrap());
        controller.operate(Instant(5), Operation::Pause).unwrap();
        let error = written.write(&controller.take_journal(computer_time()).unwrap()).unwrap_err();
        written.fail(&error, &Shared::default());
        assert!(!may_go_on());
        std::fs::remove_dir_all(data).unwrap();
    }
}

//! The file of the journal of a run. A thread of its own writes it, so that a slow disk never delays a show.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use lightbots_control::{JournalPiece, RecordedController, UnfinishedRun};

use super::clock::unix_us;
use crate::disk::{self, Readers};

/// The journal of the present run, in the data folder. It is removed when the run has ended.
const FILE: &str = "runs/present.lbjournal";
/// Most bytes of a journal that is read: many times those after which it begins again.
const BYTES_MAX: u64 = 256 << 20;
/// Most pieces that wait for the disk. While there are as many, the controller keeps its changes together.
const WAITING_MAX: usize = 64;
/// After a failure of the disk, the journal is begun again at most this often.
const TRY_AGAIN: Duration = Duration::from_secs(10);

/// The journal that a killed program left in its data folder: the run that was not ended. `Err`: a line for people.
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
        // Its program was killed after the end of the run and before it removed the file.
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
    /// When the journal was begun again after a failure.
    tried: Option<Instant>,
    /// People were told of a failure.
    is_told: bool,
}

/// What the thread says.
#[derive(Debug, Default)]
struct Shared {
    waiting: AtomicUsize,
    failure: Mutex<Option<String>>,
}

impl JournalFile {
    /// The controller's runs are written into this data folder from now on.
    pub fn start(data: &Path, controller: &mut RecordedController) -> Self {
        controller.keep_journal();
        let (pieces, inbox) = sync_channel(WAITING_MAX);
        let shared = Arc::new(Shared::default());
        let mut file = Written { path: data.join(FILE), file: None };
        let of_thread = shared.clone();
        let thread = std::thread::spawn(move || file.write_all(&inbox, &of_thread));
        Self { pieces, shared, thread, tried: None, is_told: false }
    }

    /// Hands on what is new. A line for people, once something went wrong.
    pub fn keep(&mut self, controller: &mut RecordedController) -> Option<String> {
        let failure = self.shared.failure.lock().unwrap_or_else(PoisonError::into_inner).take();
        if failure.is_some() || self.tried.is_some_and(|tried| tried.elapsed() > TRY_AGAIN) {
            self.tried = failure.is_some().then(Instant::now);
            controller.begin_journal_again();
        }
        if self.tried.is_none() && self.shared.waiting.load(Ordering::Relaxed) < WAITING_MAX {
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
        let Some(piece) = controller.take_journal(unix_us()) else { return };
        self.shared.waiting.fetch_add(1, Ordering::Relaxed);
        if self.pieces.try_send(piece).is_err() {
            self.shared.waiting.fetch_sub(1, Ordering::Relaxed);
            controller.begin_journal_again();
        }
    }

    /// The run that was found is over: its journal is removed.
    pub fn discard(&mut self) {
        self.shared.waiting.fetch_add(1, Ordering::Relaxed);
        // The queue is empty at the start, when runs are found.
        let _ = self.pieces.try_send(JournalPiece { begins: false, ends: true, bytes: Vec::new() });
    }

    /// The program ends: waits for the disk.
    pub fn finish(mut self, controller: &mut RecordedController) {
        self.keep(controller);
        drop(self.pieces);
        // A failure of the thread was told before, or it came too late to be told.
        let _ = self.thread.join();
    }
}

/// The file of the thread.
struct Written {
    path: PathBuf,
    /// `None`: no journal has begun, or writing it failed.
    file: Option<File>,
}

impl Written {
    /// Writes pieces until there are no more. What is there is written before it is synchronised.
    fn write_all(&mut self, inbox: &Receiver<JournalPiece>, shared: &Shared) {
        while let Ok(first) = inbox.recv() {
            let pieces: Vec<JournalPiece> = std::iter::once(first).chain(inbox.try_iter()).collect();
            shared.waiting.fetch_sub(pieces.len(), Ordering::Relaxed);
            if let Err(error) = self.write(&pieces) {
                self.file = None;
                *shared.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
            }
        }
    }

    fn write(&mut self, pieces: &[JournalPiece]) -> std::io::Result<()> {
        for piece in pieces {
            if piece.begins {
                disk::replace(&self.path, &piece.bytes, Readers::All)?;
                self.file = Some(OpenOptions::new().append(true).open(&self.path)?);
            } else if let Some(file) = &mut self.file {
                file.write_all(&piece.bytes)?;
            }
            if piece.ends {
                self.file = None;
                disk::remove(&self.path)?;
            }
        }
        self.file.as_ref().map_or(Ok(()), File::sync_data)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::Instant;
    use lightbots_control::{Config, Controller, MissingPolicy, Operation};
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
        journal.finish(&mut controller);
        std::fs::remove_file(data).unwrap();
    }
}

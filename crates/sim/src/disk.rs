//! The disk that holds the journal. It may be full or slow, and a crash may leave only half of a piece on it. A failure
//! has the same effects as in the journal's thread of the server (`server/src/live/journal.rs`).

use std::collections::VecDeque;

use lightbots_base::{Instant, Span};
use lightbots_control::{JOURNAL_OUTDATED, JournalPiece};

/// Time after a failure until the journal is begun again, as in the server.
const TRY_AGAIN: Span = Span::from_millis(10_000);

/// The file of the journal.
#[derive(Clone, Debug, Default)]
pub(crate) struct Disk {
    /// Bytes that are on the disk.
    file: Vec<u8>,
    /// What is being written, in order, each with the time at which it will be on the disk.
    pending: VecDeque<(Instant, Change)>,
    /// Changes that begin before this time fail, except that a file is removed or marked.
    full_until: Instant,
    /// Changes that begin before this time reach the disk late, after `takes`.
    slow_until: Instant,
    takes: Span,
    /// Whether pieces are appended to the file. Otherwise no journal has begun, or writing it failed: such pieces are lost.
    is_open: bool,
    /// When writing failed last; `None`: it did not, or the journal was begun again since.
    failed: Option<Instant>,
}

/// A change of the file.
#[derive(Clone, Debug)]
enum Change {
    /// The piece is appended, replaces the file, or removes it.
    Write(JournalPiece),
    /// The file says from now on that it lacks entries.
    MarkOutdated,
}

impl Disk {
    /// Makes the disk full until a time: pieces are lost, except those that end a run.
    pub fn fill(&mut self, until: Instant) {
        self.full_until = self.full_until.max(until);
    }

    /// Delays each piece that is written before `until`: it is on the disk only after `takes`, and after all earlier
    /// pieces.
    pub fn slow(&mut self, until: Instant, takes: Span) {
        (self.slow_until, self.takes) = (until, takes);
    }

    /// Whether the journal must be begun again now, because a failure is [`TRY_AGAIN`] ago. Returns true once for each
    /// failure.
    pub fn begins_again(&mut self, now: Instant) -> bool {
        self.failed.take_if(|failed| now - *failed > TRY_AGAIN).is_some()
    }

    /// Begins to write a piece. If the disk is full, the piece is lost, and the file is marked as outdated. A piece that
    /// ends a run removes the file, which needs no room.
    pub fn write(&mut self, now: Instant, piece: JournalPiece) {
        let is_written = piece.begins || piece.ends || self.is_open;
        if !piece.ends && is_written && now < self.full_until {
            (self.is_open, self.failed) = (false, Some(now));
            self.begin(now, Change::MarkOutdated);
        } else if is_written {
            self.is_open = !piece.ends;
            self.begin(now, Change::Write(piece));
        }
    }

    fn begin(&mut self, now: Instant, change: Change) {
        let takes = if now < self.slow_until { self.takes } else { Span::ZERO };
        let last = self.pending.back().map_or(now, |(at, _)| *at);
        self.pending.push_back(((now + takes).max(last), change));
        self.settle(now);
    }

    /// Makes the changes that are on the disk by now.
    fn settle(&mut self, now: Instant) {
        while self.pending.front().is_some_and(|(at, _)| *at <= now)
            && let Some((_, change)) = self.pending.pop_front()
        {
            match change {
                Change::Write(piece) if piece.ends => self.file.clear(),
                Change::Write(piece) => {
                    if piece.begins {
                        self.file.clear();
                    }
                    self.file.extend(piece.bytes);
                }
                Change::MarkOutdated => {
                    if let Some(mark) = self.file.get_mut(JOURNAL_OUTDATED.0) {
                        *mark = JOURNAL_OUTDATED.1;
                    }
                }
            }
        }
    }

    /// Applies a crash of the program that writes. If the piece being written is appended, its first half is on the
    /// disk. If it replaces the file, the old file stays. All later pieces are lost, and an earlier failure is
    /// forgotten.
    pub fn crash(&mut self, now: Instant) {
        self.settle(now);
        if let Some((_, Change::Write(torn))) = self.pending.front()
            && !torn.begins
            && !torn.ends
        {
            self.file.extend(&torn.bytes[..torn.bytes.len() / 2]);
        }
        self.pending.clear();
        (self.is_open, self.failed) = (false, None);
    }

    /// The bytes of the file at the last write or crash.
    pub fn file(&self) -> &[u8] {
        &self.file
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const END: JournalPiece = JournalPiece { begins: false, ends: true, bytes: Vec::new() };

    fn piece(begins: bool, bytes: &[u8]) -> JournalPiece {
        JournalPiece { begins, ends: false, bytes: bytes.to_vec() }
    }

    #[test]
    fn a_crash_tears_what_is_being_written() {
        let mut disk = Disk::default();
        disk.write(Instant(0), piece(true, b"ab"));
        disk.slow(Instant(10), Span(5));
        disk.write(Instant(1), piece(false, b"cdef"));
        disk.write(Instant(2), piece(false, b"gh"));
        disk.crash(Instant(5));
        assert_eq!(disk.file(), b"abcd");
        disk.write(Instant(6), piece(true, b"new"));
        disk.crash(Instant(7));
        assert_eq!(disk.file(), b"abcd");
    }

    #[test]
    fn after_a_failure_the_journal_begins_again() {
        let mut disk = Disk::default();
        disk.write(Instant(0), piece(true, b"ab"));
        disk.fill(Instant(10));
        disk.write(Instant(1), piece(false, b"c"));
        assert!(!disk.begins_again(Instant(9_000_000)));
        disk.write(Instant(9_000_001), piece(false, b"c"));
        assert_eq!(disk.file(), b"ab");
        assert!(disk.begins_again(Instant(10_000_002)));
        disk.write(Instant(10_000_003), piece(true, b"d"));
        assert_eq!(disk.file(), b"d");
    }

    #[test]
    fn a_full_disk_marks_the_journal_and_keeps_no_run_that_has_ended() {
        let mut disk = Disk::default();
        disk.write(Instant(0), piece(true, &[0; 12]));
        disk.fill(Instant(10));
        disk.write(Instant(1), piece(false, b"c"));
        assert_eq!(disk.file()[JOURNAL_OUTDATED.0], JOURNAL_OUTDATED.1);
        disk.write(Instant(2), END);
        assert!(disk.file().is_empty());
    }

    #[test]
    fn a_journal_that_is_still_being_written_is_marked_after_that() {
        let mut disk = Disk::default();
        disk.slow(Instant(10), Span(5));
        disk.write(Instant(0), piece(true, &[0; 12]));
        disk.fill(Instant(20));
        disk.write(Instant(1), piece(false, b"c"));
        disk.crash(Instant(9));
        assert_eq!(disk.file()[JOURNAL_OUTDATED.0], JOURNAL_OUTDATED.1);
    }
}

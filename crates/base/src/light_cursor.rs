//! The position in a light track that a robot has reached.

use crate::light_track::{LightRecord, LightTrack};
use crate::{Rgb, Span};

/// A position in a light track. It remembers the current record, so that a small step forward takes the same time in
/// long and short tracks.
#[derive(Clone, Copy, Debug, Default)]
pub struct LightCursor {
    record: usize,
    /// How many repetitions of the current block of records have begun; 0 if no repeat is in progress.
    repeats: u32,
    /// Beginning of the current record, microseconds after the start of the track.
    began_us: u64,
    /// The colour with which the current record begins.
    before: Rgb,
    moved: bool,
}

impl LightCursor {
    /// Returns the colour at `elapsed` after the start of the track: its start colour for negative times, its last
    /// colour after its end. For a time before the current record, the search begins again at the start of the track. A
    /// repeat of more records than precede it is skipped.
    pub fn at(&mut self, track: LightTrack<'_>, elapsed: Span) -> Rgb {
        let elapsed_us = self.seek(track, elapsed);
        let Some(&record) = track.records.get(self.record) else { return self.before };
        record.within(self.before, (elapsed_us - self.began_us) as f64 / record.duration_us() as f64)
    }

    /// Moves to the record at `elapsed` after the start of the track, or behind the last record if the track is over.
    /// Returns `elapsed` in microseconds, at least 0.
    #[inline]
    pub fn seek(&mut self, track: LightTrack<'_>, elapsed: Span) -> u64 {
        let elapsed_us = u64::try_from(elapsed.0).unwrap_or(0);
        if !self.moved || elapsed_us < self.began_us {
            *self = Self { before: track.start, moved: true, ..Self::default() };
        }
        while let Some(&record) = track.records.get(self.record) {
            let LightRecord::Repeat { records, times } = record else {
                let whole_us = record.duration_us();
                if elapsed_us - self.began_us < whole_us {
                    break;
                }
                self.began_us += whole_us;
                self.before = record.end(self.before);
                self.record += 1;
                continue;
            };
            self.repeat(track, (records as usize, times), elapsed_us);
        }
        elapsed_us
    }

    /// Returns the record that [`LightCursor::seek`] found, as a straight line in sRGB codes. A step is a line of one
    /// colour. The result is its beginning after the start of the track, its duration, and its first and last colour.
    /// `None` if the track is over.
    #[inline]
    pub fn line(&self, track: LightTrack<'_>) -> Option<(Span, Span, (Rgb, Rgb))> {
        let record = *track.records.get(self.record)?;
        let end = match record {
            LightRecord::Line { to, .. } => to,
            LightRecord::Step { .. } | LightRecord::Repeat { .. } => self.before,
        };
        let span = |us: u64| Span(i64::try_from(us).unwrap_or(i64::MAX));
        Some((span(self.began_us), span(record.duration_us()), (self.before, end)))
    }

    /// Whether the track is over.
    pub fn is_at_end(&self, track: LightTrack<'_>) -> bool {
        self.record >= track.records.len()
    }

    /// At a repeat, goes back to the beginning of the repeated records, or on to the record behind the repeat.
    /// Repetitions that are already over at `elapsed_us` are skipped in one step, because a repeat may stand for
    /// millions. A repeat of more records than precede it, or of records without duration, is passed.
    fn repeat(&mut self, track: LightTrack<'_>, (records, times): (usize, u32), elapsed_us: u64) {
        let block_us = match self.record.checked_sub(records) {
            Some(first) => track.records[first..self.record].iter().map(|record| record.duration_us()).sum(),
            None => 0,
        };
        let left = if block_us == 0 { 0 } else { times.saturating_sub(self.repeats) };
        let over = u32::try_from((elapsed_us - self.began_us) / u64::max(block_us, 1)).unwrap_or(u32::MAX);
        let skipped = over.min(left);
        self.began_us += u64::from(skipped) * block_us;
        if skipped == left {
            (self.repeats, self.record) = (0, self.record + 1);
        } else {
            self.repeats += skipped + 1;
            self.record -= records;
        }
    }
}

//! Stretches of light: colours over time that the controller sends ahead (R55 to R57 of docs/protocol.md). This module
//! decides which stretch plays, and computes its colour.

use lightbots_base::{Instant, LightCursor, LightRecord, LightTrack, Rgb, Span};
use lightbots_wire::{LightAnchor, LightStretch, MAX_LIGHT_RECORDS};

use crate::light_piece::LightPiece;
use crate::timeline::Timeline;

/// Number of stretches that are stored: the stretch that plays, the stretch that follows it, and the first stretch of
/// the next drive.
pub(crate) const STORED: usize = 3;
/// A message is old if its number is below the newest one by less than this. A number farther below comes from a
/// restarted controller. With a smaller value, more late messages count as new.
pub(crate) const OLD_NUMBERS: u32 = 64;

/// Colours of one stretch.
#[derive(Debug)]
pub(crate) struct StoredTrack {
    start: Rgb,
    records: heapless::Vec<LightRecord, MAX_LIGHT_RECORDS>,
}

impl StoredTrack {
    pub(crate) const EMPTY: Self = Self { start: Rgb::BLACK, records: heapless::Vec::new() };

    fn put(&mut self, stretch: &LightStretch) {
        self.start = stretch.start;
        self.records.clear();
        // Fits: both have the same capacity.
        let _ = self.records.extend_from_slice(&stretch.records);
    }

    fn track(&self) -> LightTrack<'_> {
        LightTrack { start: self.start, records: &self.records }
    }
}

/// Storage of all stretches.
pub(crate) type StoredTracks = [StoredTrack; STORED];

/// A received stretch. Its colours lie in [`StoredTracks`].
#[derive(Clone, Copy, Debug)]
struct Kept {
    number: u32,
    slot: usize,
    /// Number of the route whose START begins the stretch; `None` if it begins at a given moment.
    seq: Option<u32>,
    /// Moment of the show clock at which the time of the stretch is 0; `None` while the stretch waits for a START.
    from: Option<Instant>,
    runs_freely: bool,
    skip: Span,
    over: Span,
}

/// The stretch that plays.
#[derive(Clone, Copy, Debug)]
struct Playing {
    kept: Kept,
    /// The colour that was shown before the stretch began. The stretch blends from it.
    before: Rgb,
    cursor: LightCursor,
    /// Moment of the show clock at which its track began. It is valid while the time of the stretch runs evenly with
    /// the show clock.
    began: Instant,
    /// Whether blending is over, and the time of the stretch runs evenly with the show clock until a further message
    /// comes.
    is_even: bool,
}

impl Playing {
    /// Returns the line of colours at the cursor, limited to the time between two moments of the show clock. `None` if
    /// the track is over.
    fn piece(&self, track: LightTrack<'_>, moments: (Instant, Instant)) -> Option<LightPiece> {
        let (begins, lasts, colours) = self.cursor.line(track)?;
        Some(LightPiece::new(moments, (self.began + begins, lasts), colours))
    }
}

/// The stretches of a robot. Their colours lie in [`StoredTracks`].
#[derive(Debug)]
pub(crate) struct LightAhead {
    playing: Option<Playing>,
    /// Stretches that have not begun, in the order in which they arrived.
    waiting: heapless::Vec<Kept, STORED>,
    /// Number of the stretch that was received last, apart from old messages; 0 if none was.
    newest: u32,
    /// Route number and moment (show clock) of the START that was received last.
    started: Option<(u32, Instant)>,
    /// Time of the stretch that plays. Like path time, it stands still during holds.
    timeline: Timeline,
    /// No waiting stretch begins before this moment of the show clock.
    quiet_until: Instant,
}

impl Default for LightAhead {
    fn default() -> Self {
        Self {
            playing: None,
            waiting: heapless::Vec::new(),
            newest: 0,
            started: None,
            timeline: Timeline::new(),
            quiet_until: Instant::ZERO,
        }
    }
}

impl LightAhead {
    /// Number of the stretch that was received last; 0 if none was.
    pub(crate) fn newest(&self) -> u32 {
        self.newest
    }

    /// Whether a stretch plays or waits.
    pub(crate) fn is_any(&self) -> bool {
        self.playing.is_some() || !self.waiting.is_empty()
    }

    /// Stores a stretch until it begins. An old message, or a copy of the newest one, changes nothing. If all places
    /// are taken, the new stretch replaces the waiting stretch that arrived last.
    pub(crate) fn keep(&mut self, stretch: &LightStretch, storage: &mut StoredTracks) {
        if self.newest != 0 && self.newest.wrapping_sub(stretch.number) < OLD_NUMBERS {
            return;
        }
        self.newest = stretch.number;
        let is_taken = |slot: &usize| {
            self.playing.is_some_and(|playing| playing.kept.slot == *slot)
                || self.waiting.iter().any(|kept| kept.slot == *slot)
        };
        let free = (0..STORED).find(|slot| !is_taken(slot));
        let Some(slot) = free.or_else(|| self.waiting.pop().map(|kept| kept.slot)) else { return };
        let (seq, from, runs_freely) = match stretch.anchor {
            LightAnchor::Start(seq) => {
                let heard = self.started.filter(|(started, _)| *started == seq);
                (Some(seq), heard.map(|(_, at)| at), false)
            }
            LightAnchor::Moment(at) => (None, Some(at), false),
            LightAnchor::Free(at) => (None, Some(at), true),
        };
        storage[slot].put(stretch);
        let (number, skip, over) = (stretch.number, stretch.skip, stretch.over);
        let kept = Kept { number, slot, seq, from, runs_freely, skip, over };
        // Fits: there are no more of them than slots.
        let _ = self.waiting.push(kept);
        self.quiet_until = Instant::ZERO;
    }

    /// Handles a START, which sets when the stretches of the route `seq` begin. A further START of the same route
    /// counts only if its moment `at` is later.
    pub(crate) fn start(&mut self, seq: u32, at: Instant) {
        if self.started.is_some_and(|(known, before)| known == seq && before >= at) {
            return;
        }
        self.started = Some((seq, at));
        self.quiet_until = Instant::ZERO;
        for kept in self.waiting.iter_mut().filter(|kept| kept.seq == Some(seq)) {
            kept.from = Some(at);
        }
    }

    /// Notes a hold (`hold`) or a resume for the moment `at`, show clock. It counts for stretches that do not run
    /// freely.
    pub(crate) fn note(&mut self, at: Instant, hold: bool) {
        self.timeline.note(at, hold);
        // A resume that is received late advances the time at once.
        self.quiet_until = Instant::ZERO;
    }

    /// Ends the stretch that plays, if one does. Waiting stretches stay.
    pub(crate) fn end(&mut self) {
        self.playing = None;
        self.quiet_until = Instant::ZERO;
    }

    /// Drops all stretches.
    pub(crate) fn clear(&mut self) {
        self.playing = None;
        self.waiting.clear();
    }

    /// Drops all stretches and all moments of the show clock, because the show clock was reset. The number of the
    /// newest stretch is kept.
    pub(crate) fn forget_moments(&mut self) {
        *self = Self { newest: self.newest, ..Self::default() };
    }

    /// Whether a waiting stretch is to begin at the moment `show` or before, show clock.
    pub(crate) fn begins(&self, show: Instant) -> bool {
        show >= self.quiet_until && self.due(show).is_some()
    }

    /// Returns the colour at the moment `show`, show clock; `None` if no stretch plays. `shown`: the colour of the own
    /// light until now.
    pub(crate) fn step(&mut self, show: Instant, shown: Rgb, storage: &StoredTracks) -> Option<Rgb> {
        if show >= self.quiet_until {
            while let Some(index) = self.due(show) {
                let kept = self.waiting.remove(index);
                self.begin(kept, shown);
            }
            self.quiet_until = self.next_due(show);
        }
        let playing = self.playing.as_mut()?;
        let kept = &playing.kept;
        let from = kept.from?;
        let (time, is_even) =
            if kept.runs_freely { (show - from, true) } else { self.timeline.time_and_whether_even(show) };
        let (elapsed, over) = (time - kept.skip, kept.over);
        let track = storage[kept.slot].track();
        playing.is_even = is_even && elapsed >= over;
        playing.began = show - elapsed;
        let colour = playing.cursor.at(track, elapsed);
        if elapsed < over {
            return Some(playing.before.mixed(colour, elapsed.as_secs() / over.as_secs()));
        }
        if playing.cursor.is_at_end(track) {
            self.end();
        }
        Some(colour)
    }

    /// Returns the line of colours at the moment `show` (show clock), after the last line has ended. `None` if a
    /// stretch may begin, none plays, or its track is over: `step` must then compute the colour.
    #[inline]
    pub(crate) fn next_piece(&mut self, show: Instant, storage: &StoredTracks) -> Option<LightPiece> {
        if show >= self.quiet_until {
            return None;
        }
        let playing = self.playing.as_mut()?;
        let (track, elapsed) = (storage[playing.kept.slot].track(), show - playing.began);
        playing.cursor.seek(track, elapsed);
        playing.piece(track, (show, self.quiet_until))
    }

    /// Returns the line of colours from the moment `show` on, show clock. `step` must have computed the colour of that
    /// moment before. [`LightPiece::NONE`] if no line is known.
    pub(crate) fn piece(&self, show: Instant, storage: &StoredTracks) -> LightPiece {
        let even = self.playing.as_ref().filter(|playing| playing.is_even);
        let piece = even
            .and_then(|playing| playing.piece(storage[playing.kept.slot].track(), (show, self.quiet_until)));
        piece.unwrap_or(LightPiece::NONE)
    }

    fn begin(&mut self, kept: Kept, shown: Rgb) {
        // Stretches that wait for a moment are dropped: they belong to the drive before, or this stretch was sent later
        // in their place.
        let is_replaced = |other: &Kept| kept.seq.is_some() || is_earlier(other.number, kept.number);
        self.waiting.retain(|other| other.seq.is_some() || !is_replaced(other));
        let is_new = |playing: &Playing| playing.kept.from != kept.from;
        if let Some(from) =
            kept.from.filter(|_| self.playing.as_ref().is_none_or(is_new) && !kept.runs_freely)
        {
            self.timeline.begin(from);
        }
        self.playing = Some(Playing {
            kept,
            before: shown,
            cursor: LightCursor::default(),
            began: Instant::ZERO,
            is_even: false,
        });
    }

    /// Index of the first waiting stretch that is to begin at the moment `show` or before.
    fn due(&self, show: Instant) -> Option<usize> {
        let is_due =
            |kept: Kept| self.time_of(kept, show).is_some_and(|time| time >= kept.skip.max(Span::ZERO));
        (0..self.waiting.len()).find(|&index| is_due(self.waiting[index]))
    }

    /// Moment of the show clock before which no waiting stretch begins. It is a lower bound, because the time of a
    /// stretch never runs faster than the show clock.
    fn next_due(&self, show: Instant) -> Instant {
        let due =
            |kept: &Kept| self.time_of(*kept, show).map(|time| show + (kept.skip.max(Span::ZERO) - time));
        self.waiting.iter().filter_map(due).min().unwrap_or(Instant::FAR)
    }

    /// The time of a stretch at the moment `show`, show clock: the time since its start, without holds unless it runs
    /// freely. `None` while its start is not known.
    fn time_of(&self, kept: Kept, show: Instant) -> Option<Span> {
        let from = kept.from?;
        if kept.runs_freely || show < from {
            return Some(show - from);
        }
        if self.playing.is_some_and(|playing| playing.kept.from == Some(from) && !playing.kept.runs_freely) {
            return Some(self.timeline.at(show).time);
        }
        let mut own = self.timeline.clone();
        own.begin(from);
        Some(own.at(show).time)
    }
}

/// Whether `number` comes before `other`. Numbers wrap around after the largest one.
fn is_earlier(number: u32, other: u32) -> bool {
    (other.wrapping_sub(number) as i32) > 0
}

#[cfg(test)]
#[path = "light_ahead_tests.rs"]
mod tests;

//! Stretches of light that were sent ahead (R55 to R57): which one plays, and its colour.

use lightbots_base::{Instant, LightCursor, LightRecord, LightTrack, Rgb, Span};
use lightbots_wire::{LightAnchor, LightStretch, MAX_LIGHT_RECORDS};

use crate::light_piece::LightPiece;
use crate::timeline::Timeline;

/// Number of stretches that are stored: the one that plays, the one that goes on from it, and the first of the next
/// drive.
pub(crate) const STORED: usize = 3;
/// A message whose number is less than this below the newest is old, as with routes.
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

/// A stretch that was received, without its colours.
#[derive(Clone, Copy, Debug)]
struct Kept {
    number: u32,
    slot: usize,
    /// The route whose START it waits for.
    seq: Option<u32>,
    /// Moment of the show clock from which its time counts; `None` while it waits for a START.
    from: Option<Instant>,
    runs_freely: bool,
    skip: Span,
    over: Span,
}

/// The stretch that plays.
#[derive(Clone, Copy, Debug)]
struct Playing {
    kept: Kept,
    /// The colour that was shown before it began.
    before: Rgb,
    cursor: LightCursor,
    /// Moment of the show clock at which its track began, if its time runs with the show clock.
    began: Instant,
    /// Whether its time runs with the show clock until a message comes, and blending is over.
    is_even: bool,
}

impl Playing {
    /// The line of colours at its cursor, as far as it lies between two moments. `None` if the track is over.
    fn piece(&self, track: LightTrack<'_>, moments: (Instant, Instant)) -> Option<LightPiece> {
        let (begins, lasts, colours) = self.cursor.line(track)?;
        Some(LightPiece::new(moments, (self.began + begins, lasts), colours))
    }
}

/// The stretches of a robot. Their records lie in its storage.
#[derive(Debug)]
pub(crate) struct LightAhead {
    playing: Option<Playing>,
    /// Stretches that have not begun, in order of arrival.
    waiting: heapless::Vec<Kept, STORED>,
    /// Number of the stretch that was received last; 0: none.
    newest: u32,
    /// Route number and moment of the START that was received last.
    started: Option<(u32, Instant)>,
    /// Time of the stretch that plays, which stands still during holds.
    timeline: Timeline,
    /// No stretch that waits begins before this moment of the show clock.
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
    /// Number of the stretch that was received last; 0: none.
    pub(crate) fn newest(&self) -> u32 {
        self.newest
    }

    /// Whether a stretch plays or waits.
    pub(crate) fn is_any(&self) -> bool {
        self.playing.is_some() || !self.waiting.is_empty()
    }

    /// Keeps a stretch. An old message changes nothing. Without room, the new stretch replaces the one that came last
    /// of those that wait.
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

    /// Takes a START, which sets when stretches of that route begin. For the START of a route that is known, only a
    /// later moment counts.
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

    /// Notes a hold or resume.
    pub(crate) fn note(&mut self, at: Instant, hold: bool) {
        self.timeline.note(at, hold);
        // A resume that is received late advances the time at once.
        self.quiet_until = Instant::ZERO;
    }

    /// Ends the stretch that plays.
    pub(crate) fn end(&mut self) {
        self.playing = None;
        self.quiet_until = Instant::ZERO;
    }

    /// Drops all stretches.
    pub(crate) fn clear(&mut self) {
        self.playing = None;
        self.waiting.clear();
    }

    /// Drops all stretches and moments, because the show clock was set anew.
    pub(crate) fn forget_moments(&mut self) {
        *self = Self { newest: self.newest, ..Self::default() };
    }

    /// Whether a stretch begins by this moment of the show clock.
    pub(crate) fn begins(&self, show: Instant) -> bool {
        show >= self.quiet_until && self.due(show).is_some()
    }

    /// The colour at a moment of the show clock; `None` if no stretch plays. `shown`: the colour until now.
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

    /// The line of colours after one that is over, if nothing else happened. `None` if `step` must compute the colour.
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

    /// The line of colours from a moment of the show clock on, after `step` computed the colour of that moment.
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

    /// Index of the first stretch that waits and begins by this moment.
    fn due(&self, show: Instant) -> Option<usize> {
        let is_due =
            |kept: Kept| self.time_of(kept, show).is_some_and(|time| time >= kept.skip.max(Span::ZERO));
        (0..self.waiting.len()).find(|&index| is_due(self.waiting[index]))
    }

    /// Moment of the show clock before which no stretch that waits begins. The time of a stretch goes no faster than
    /// the show clock.
    fn next_due(&self, show: Instant) -> Instant {
        let due =
            |kept: &Kept| self.time_of(*kept, show).map(|time| show + (kept.skip.max(Span::ZERO) - time));
        self.waiting.iter().filter_map(due).min().unwrap_or(Instant::FAR)
    }

    /// The time of a stretch since its anchor; `None` if that is not known.
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

/// Whether a number comes before another one; numbers wrap around.
fn is_earlier(number: u32, other: u32) -> bool {
    (other.wrapping_sub(number) as i32) > 0
}

#[cfg(test)]
#[path = "light_ahead_tests.rs"]
mod tests;

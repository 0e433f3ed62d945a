//! Writes the journal of a run.

use super::{
    Change, Entry, JournalState, LegEntry, MAGIC, OUTDATED, ParticipantEntry, Position, RunBegun,
    RunProgress, VERSION,
};
use crate::block::append_block;
use crate::computer_time::ComputerTime;
use crate::context::Context;
use crate::mutant::Mutant;
use crate::run::Run;
use lightbots_base::{Instant, Span};

/// Longest time between two entries of a journal while the controller runs. A later controller computes from it by when
/// robots stood.
const ALIVE: Span = Span::from_millis(2_000);
/// A new journal replaces one that is longer than both this number of bytes and this multiple of its first piece. A
/// journal thus stays small while a show loops for days.
const BEGUN_AGAIN: (usize, usize) = (4 << 20, 8);

/// Bytes for a journal's file, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JournalPiece {
    /// Whether the bytes are the beginning of a new journal, which replaces the file. Otherwise they are appended to
    /// the file.
    pub begins: bool,
    /// Whether the run is over. If so, no more bytes of this journal follow.
    pub ends: bool,
    /// The bytes.
    pub bytes: Vec<u8>,
}

/// The journal of the present run, if one is kept.
#[derive(Debug, Default)]
pub(crate) struct Journal {
    is_kept: bool,
    /// The state of the run after all changes, whether they were taken or not; `None` if no run is recorded.
    state: Option<JournalState>,
    /// Changes that were not written to a piece yet.
    pending: Vec<Change>,
    at: Instant,
    /// Whether the next piece begins a new journal with the whole state.
    begins: bool,
    /// Whether pins, owners and obstacles were compared with `state` since the operator's last operation.
    is_mapping_checked: bool,
    /// `Roster::changes` at the moment when participants were last recorded.
    roster_changes: u64,
    alive_at: Instant,
    /// Number of bytes of the journal.
    bytes: usize,
    /// Number of bytes of the journal's first piece.
    first_bytes: usize,
}

impl Journal {
    /// Records runs from now on.
    pub fn keep(&mut self) {
        self.is_kept = true;
    }

    /// Makes the next piece begin a new journal with the whole state. Needed if a piece was lost on its way to the
    /// disk.
    pub fn begin_again(&mut self) {
        self.begins = self.state.is_some();
        self.pending.clear();
    }

    /// Records that the operator requested an operation. `what`: short name of the operation.
    pub fn operated(&mut self, now: Instant, what: &str) {
        if self.state.is_some() {
            self.is_mapping_checked = false;
            self.push(now, Change::Operated(what.to_owned()));
        }
    }

    /// Records what changed in this run since the last call, if a journal is kept. Pins, owners and obstacles are
    /// compared only with a new leg and after an operation.
    pub fn note(&mut self, now: Instant, run: &Run, context: &Context) {
        if !self.is_kept {
            return;
        }
        if self.state.as_ref().is_none_or(|state| state.ended.is_some()) {
            self.begin(now, run, context);
        }
        self.note_roster(now, run, context);
        let has_new_leg = self.note_leg(now, run);
        if has_new_leg || !self.is_mapping_checked {
            self.is_mapping_checked = true;
            self.note_mapping(now, run, context);
        }
        let progress = run.journal_progress();
        self.note_places(now, run, context, progress.position);
        if self.state.as_ref().is_some_and(|state| state.progress != progress) || now >= self.alive_at {
            self.push(now, Change::Progress(progress));
        }
    }

    /// Records that the run is over. `how`: how the run ended, for people.
    pub fn end(&mut self, now: Instant, how: &str) {
        if self.state.is_some() {
            self.push(now, Change::Ended(how.to_owned()));
        }
    }

    /// Takes the next piece for the journal's file; `None` if there is nothing to write. `clocks`: what the clocks
    /// of the controller's computer read now.
    pub fn take(&mut self, clocks: ComputerTime) -> Option<JournalPiece> {
        let state = self.state.as_ref()?;
        if self.pending.is_empty() && !self.begins {
            return None;
        }
        let (begins, ends) = (std::mem::take(&mut self.begins), state.ended.is_some());
        let mut changes = std::mem::take(&mut self.pending);
        if Mutant::LoseJournalEntries.is_planted() && self.bytes.is_multiple_of(5) {
            changes.clear();
        }
        let mut bytes = Vec::new();
        if begins {
            bytes.extend_from_slice(MAGIC);
            bytes.extend_from_slice(&VERSION.to_le_bytes());
            bytes.resize(OUTDATED.0 + 1, 0);
            changes = vec![Change::State(Box::new(state.clone()))];
        }
        // Cannot fail: all types of an entry can be written as bytes.
        let entry = postcard::to_allocvec(&Entry { at: self.at, clocks, changes }).unwrap_or_default();
        append_block(&mut bytes, &entry);
        self.count(begins, bytes.len());
        if ends {
            self.state = None;
        }
        Some(JournalPiece { begins, ends, bytes })
    }

    fn count(&mut self, begins: bool, bytes: usize) {
        if begins {
            (self.bytes, self.first_bytes) = (0, bytes);
        }
        self.bytes += bytes;
        let (least, times) = BEGUN_AGAIN;
        if self.bytes > least.max(self.first_bytes * times) {
            self.begin_again();
        }
    }

    fn push(&mut self, now: Instant, change: Change) {
        if let Some(state) = &mut self.state {
            // Cannot fail: the change was made for this state.
            let _ = state.apply(change.clone());
        }
        if !self.begins {
            self.pending.push(change);
        }
        (self.at, self.alive_at) = (now, now + ALIVE);
    }

    fn begin(&mut self, now: Instant, run: &Run, context: &Context) {
        let playback = &run.playback;
        self.state = Some(JournalState {
            begun: RunBegun {
                at: run.roster.begun,
                show: playback.show.clone(),
                purpose: playback.purpose,
                missing: playback.missing,
            },
            participants: participants(run, context),
            leg: None,
            pins: context.mapping.pins.iter().map(|(&pixel, &robot)| (pixel, robot)).collect(),
            owners: context.mapping.owners.oldest_first(),
            found: Vec::new(),
            ignores_strangers: false,
            progress: run.journal_progress(),
            ended: None,
        });
        self.pending.clear();
        self.roster_changes = run.roster.changes;
        (self.begins, self.is_mapping_checked) = (true, true);
        (self.at, self.alive_at) = (now, now + ALIVE);
    }

    fn note_roster(&mut self, now: Instant, run: &Run, context: &Context) {
        if std::mem::replace(&mut self.roster_changes, run.roster.changes) == run.roster.changes {
            return;
        }
        // The place of a participant that takes part is not recorded again, because the leg says more.
        self.note_participants(now, run, context, |known, entry| known.membership != entry.membership);
    }

    /// Records the places of participants once robots are no longer on the leg or at its goals. Their places then do
    /// not follow from the leg.
    fn note_places(&mut self, now: Instant, run: &Run, context: &Context, position: Position) {
        let was_in_leg = self.state.as_ref().is_some_and(|state| state.progress.position.is_in_leg());
        if was_in_leg && !position.is_in_leg() {
            self.note_participants(now, run, context, |known, entry| known != entry);
        }
    }

    /// Records participants that are new, or for which `differs(recorded entry, present entry)` is true.
    fn note_participants(
        &mut self,
        now: Instant,
        run: &Run,
        context: &Context,
        differs: fn(&ParticipantEntry, &ParticipantEntry) -> bool,
    ) {
        for (number, entry) in participants(run, context).into_iter().enumerate() {
            let known = self.state.as_ref().and_then(|state| state.participants.get(number));
            if known.is_none_or(|known| differs(known, &entry)) {
                self.push(now, Change::Participant { number: number as u32, entry });
            }
        }
    }

    /// Records the leg of the run, if there is one and it is not recorded yet. Returns whether it was recorded now.
    fn note_leg(&mut self, now: Instant, run: &Run) -> bool {
        let Some(leg) = run.phase.left_leg(&run.pipeline) else { return false };
        let known = self.state.as_ref().and_then(|state| state.leg.as_ref());
        if known.is_some_and(|known| known.seq == leg.seq) {
            return false;
        }
        self.push(now, Change::Leg(LegEntry::of(leg)));
        true
    }

    fn note_mapping(&mut self, now: Instant, run: &Run, context: &Context) {
        let Some(state) = &self.state else { return };
        let pins: Vec<_> = context.mapping.pins.iter().map(|(&pixel, &robot)| (pixel, robot)).collect();
        let owners = context.mapping.owners.oldest_first();
        let obstacles = &run.pipeline.obstacles;
        let mut changes = Vec::new();
        if state.found != obstacles.found || state.ignores_strangers != obstacles.ignores_strangers {
            let (found, ignores_strangers) = (obstacles.found.clone(), obstacles.ignores_strangers);
            changes.push(Change::Obstacles { found, ignores_strangers });
        }
        if state.pins != pins {
            changes.push(Change::Pins(pins));
        }
        if state.owners != owners {
            changes.push(Change::Owners(owners));
        }
        changes.into_iter().for_each(|change| self.push(now, change));
    }
}

fn participants(run: &Run, context: &Context) -> Vec<ParticipantEntry> {
    let entry = |known: &crate::run::Participant| {
        let robot = context.fleet.robot(known.robot);
        ParticipantEntry {
            id: robot.id,
            abilities: robot.reported.abilities,
            at: robot.reported.at,
            membership: known.membership,
            probation: known.probation,
            last_seen: known.last_seen.clone(),
        }
    };
    run.roster.participants.iter().map(entry).collect()
}

impl Run {
    /// Returns how far the run is, as the journal holds it.
    fn journal_progress(&self) -> RunProgress {
        let (playback, tally) = (&self.playback, &self.tally);
        RunProgress {
            next: playback.next,
            leaves_loop: playback.leaves_loop,
            looping: playback.looping,
            paused: playback.paused,
            stepping: playback.stepping,
            waits_for_go: playback.waits_for_go,
            frames_played: tally.frames_played as u32,
            dropouts: tally.dropouts as u32,
            taken_up: tally.taken_up,
            position: self.phase.left(&self.pipeline),
        }
    }
}

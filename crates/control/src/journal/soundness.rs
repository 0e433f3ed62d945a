//! Checks whether a state is plausible, so that a controller can have written it. A checksum only shows that bytes were
//! not changed, and not which program wrote them.

use super::{JournalState, ParticipantEntry, Position};
use crate::run::{AirTime, PathClock, Probation, StopTimes, Whereabouts};
use lightbots_base::{Instant, Span, Vec2};
use std::collections::BTreeSet;

/// Moments and spans must be less than this number of microseconds (36,000 years), so that sums of a few of them do not
/// overflow.
const TIME_MAX: u64 = 1 << 60;
/// Longest time from an entry of a journal to the begin of a hold that was stated before the entry. Controllers state
/// holds at most 4 s ahead. With a larger value, a forged journal delays every START of the controller that takes it
/// up.
const HOLD_AHEAD: Span = Span::from_millis(60_000);

impl JournalState {
    /// Whether the values of this state are plausible and fit together, so that a controller can go on with the run.
    /// `at`: show clock at the last entry.
    pub fn is_sound(&self, at: Instant) -> bool {
        let names: BTreeSet<_> = self.participants.iter().map(|entry| entry.id).collect();
        let leg_fits = self.leg.as_ref().is_none_or(|leg| leg.to_leg(self.participants.len()).is_some());
        let needs_leg = self.progress.position.drive.is_some();
        names.len() == self.participants.len()
            && !self.begun.show.frames.is_empty()
            && is_moment(self.begun.at)
            && leg_fits
            && (self.leg.is_some() || !needs_leg)
            && self.found.iter().all(is_place)
            && self.participants.iter().all(ParticipantEntry::is_sound)
            && self.progress.position.is_sound(at)
    }
}

impl ParticipantEntry {
    fn is_sound(&self) -> bool {
        let Whereabouts { possible, likely } = &self.last_seen;
        let is_moment_of_probation = match self.probation {
            Probation::Turning { from, since, .. } => from.is_finite() && is_moment(since),
            _ => true,
        };
        is_moment_of_probation && self.at.iter().chain(possible).chain(likely).all(is_place)
    }
}

impl Position {
    fn is_sound(&self, at: Instant) -> bool {
        let is_air =
            |air: AirTime| is_moment(air.since) && is_moment(air.until) && air.left.is_none_or(is_span);
        let are_moments = |stops: StopTimes| is_moment(stops.began) && is_moment(stops.stood);
        self.drive.is_none_or(|clock| is_clock(clock, at))
            && self.stops.is_none_or(are_moments)
            && self.stood.is_none_or(is_air)
    }
}

fn is_clock(clock: PathClock, at: Instant) -> bool {
    let hold = clock.hold.is_none_or(|hold| {
        let stated = [hold.until, hold.release_at].into_iter().flatten().all(is_moment);
        stated && is_moment(hold.at) && hold.at < at + HOLD_AHEAD && is_moment(hold.check_at)
    });
    hold && is_moment(clock.began) && is_moment(clock.ends) && is_span(clock.lost)
}

fn is_moment(at: Instant) -> bool {
    at.0 < TIME_MAX
}

fn is_span(span: Span) -> bool {
    span.0.unsigned_abs() < TIME_MAX
}

fn is_place(at: &Vec2) -> bool {
    at.x.is_finite() && at.y.is_finite()
}

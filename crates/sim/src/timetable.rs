//! Events of a rehearsal whose times are known before it begins.

use core::cmp::Reverse;

use lightbots_base::Span;

/// Events, each with its time after the first departure.
#[derive(Clone, Debug)]
pub(crate) struct Timetable<E> {
    /// Sorted, latest first.
    coming: Vec<(Span, E)>,
}

impl<E> Timetable<E> {
    /// Sorts events by time. Of events at the same time, the one that is last in `events` happens first.
    pub fn new(mut events: Vec<(Span, E)>) -> Self {
        events.sort_by_key(|&(at, _)| Reverse(at));
        Self { coming: events }
    }

    /// Whether no event is left.
    pub fn is_empty(&self) -> bool {
        self.coming.is_empty()
    }

    /// Removes and returns the next event. `None` if none is due at `since_begin`, the time since the first departure.
    pub fn next_until(&mut self, since_begin: Span) -> Option<E> {
        self.coming.pop_if(|(at, _)| *at <= since_begin).map(|(_, event)| event)
    }
}

impl<E> Default for Timetable<E> {
    fn default() -> Self {
        Self { coming: Vec::new() }
    }
}

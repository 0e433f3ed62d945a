//! What happens in a rehearsal at moments that are known before.

use core::cmp::Reverse;

use lightbots_base::Span;

/// Events by their time after the first departure.
#[derive(Clone, Debug)]
pub(crate) struct Timetable<E> {
    /// Sorted, latest first.
    coming: Vec<(Span, E)>,
}

impl<E> Timetable<E> {
    /// Of events at the same time, the one that comes last here happens first.
    pub fn new(mut events: Vec<(Span, E)>) -> Self {
        events.sort_by_key(|&(at, _)| Reverse(at));
        Self { coming: events }
    }

    /// Whether there is nothing to come.
    pub fn is_empty(&self) -> bool {
        self.coming.is_empty()
    }

    /// The next event until a time after the first departure.
    pub fn next_until(&mut self, since_begin: Span) -> Option<E> {
        self.coming.pop_if(|(at, _)| *at <= since_begin).map(|(_, event)| event)
    }
}

impl<E> Default for Timetable<E> {
    fn default() -> Self {
        Self { coming: Vec::new() }
    }
}

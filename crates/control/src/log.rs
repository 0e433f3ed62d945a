//! Events waiting to be read. Events that robots can cause at any rate are limited, so that no robot can flood the
//! screen.

use crate::event::{Event, EventKind};
use lightbots_base::{Instant, Span};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Largest number of waiting events.
const WAITING_MAX: usize = 50_000;
/// Largest number of limited events that are recorded in one [`PERIOD`].
const FREQUENT_MAX: u32 = 10;
/// Time over which limited events are counted.
const PERIOD: Span = Span::from_millis(1_000);

/// The queue of events.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct EventQueue {
    #[serde(skip)]
    waiting: VecDeque<Event>,
    period_began: Instant,
    said: u32,
    suppressed: u64,
}

impl EventQueue {
    /// Queues an event. If the queue is full, the event is counted as suppressed.
    pub fn record(&mut self, at: Instant, kind: EventKind) {
        if self.waiting.len() < WAITING_MAX {
            self.waiting.push_back(Event { at, kind });
        } else {
            self.suppressed += 1;
        }
    }

    /// Queues an event of a kind that robots can cause at any rate. If [`FREQUENT_MAX`] of them were queued in this
    /// period, the event is only counted as suppressed.
    pub fn record_limited(&mut self, at: Instant, kind: EventKind) {
        self.tick(at);
        if self.said < FREQUENT_MAX {
            self.said += 1;
            self.record(at, kind);
        } else {
            self.suppressed += 1;
        }
    }

    /// Once the period is over, begins the next period, and records how many events were suppressed, if any were.
    pub fn tick(&mut self, now: Instant) {
        if now - self.period_began < PERIOD {
            return;
        }
        self.period_began = now;
        self.said = 0;
        if self.suppressed > 0 && self.waiting.len() < WAITING_MAX {
            let count = std::mem::take(&mut self.suppressed);
            self.record(now, EventKind::Suppressed(count));
        }
    }

    /// Whether no event waits to be read.
    pub fn is_drained(&self) -> bool {
        self.waiting.is_empty()
    }

    /// Takes the next event; `None` if none waits.
    pub fn next(&mut self) -> Option<Event> {
        self.waiting.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::RobotId;

    #[test]
    fn frequent_events_are_limited_and_counted() {
        let mut log = EventQueue::default();
        let id = RobotId::new("a").unwrap();
        for _ in 0..1_000 {
            log.record_limited(Instant(2_000_000), EventKind::UnexpectedArrival(id));
        }
        log.tick(Instant(3_000_000));
        let told: Vec<_> = std::iter::from_fn(|| log.next()).collect();
        assert_eq!(told.len(), 11);
        assert_eq!(told[10].kind, EventKind::Suppressed(990));
    }
}

//! Decides when the show clock waits for simulated robots, because the machine is too slow for them and the controller.
//!
//! If a machine cannot simulate robots or pass on their messages in time, the robots seem late and silent. The show
//! would stop for them again and again. If all robots are simulated here, the show clock waits instead, and the show
//! plays more slowly.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Number of messages that may be under way in one direction before the show clock waits. Simulated robots raise it: see
/// `ROBOTS_A_MESSAGE`.
const UNDER_WAY: u64 = 1024;
/// For each group of this many simulated robots, one message more than `UNDER_WAY` may be under way.
const ROBOTS_A_MESSAGE: u64 = 8;

/// State that the controller's task and the simulated robots' task share.
#[derive(Debug, Default)]
pub struct Pace {
    parties: Mutex<Parties>,
    may_slow: AtomicBool,
    known: AtomicUsize,
    simulated: AtomicUsize,
    /// Messages from robots to the controller.
    pub reports: Flow,
    /// Messages from the controller to single robots.
    pub commands: Flow,
}

/// The brokers of the simulated robots and of the controller; `None` for one that uses none.
#[derive(Debug, Default)]
struct Parties {
    /// Broker of the simulated robots.
    robots_at: Option<String>,
    /// Broker of the controller.
    controller_at: Option<String>,
}

/// Messages in one direction.
#[derive(Debug, Default)]
pub struct Flow {
    said: AtomicU64,
    heard: AtomicU64,
}

impl Flow {
    /// Counts messages sent.
    pub fn say(&self, messages: u64) {
        self.said.fetch_add(messages, Ordering::Relaxed);
    }

    /// Counts messages received.
    pub fn hear(&self, messages: u64) {
        self.heard.fetch_add(messages, Ordering::Relaxed);
    }

    /// Number of messages that were received, or that [`forget`](Self::forget) counted as lost.
    pub fn heard(&self) -> u64 {
        self.heard.load(Ordering::Relaxed)
    }

    /// Number of messages under way.
    fn under_way(&self) -> u64 {
        self.said.load(Ordering::Relaxed).saturating_sub(self.heard())
    }

    /// Counts all messages under way as lost.
    pub fn forget(&self) {
        self.heard.fetch_max(self.said.load(Ordering::Relaxed), Ordering::Relaxed);
    }
}

impl Pace {
    /// Sets the number of simulated robots and their broker.
    pub fn simulates(&self, robots: usize, broker: Option<String>) {
        self.simulated.store(robots, Ordering::Relaxed);
        self.parties.lock().unwrap_or_else(PoisonError::into_inner).robots_at = broker;
        self.settle();
    }

    /// Sets the controller's broker.
    pub fn controls(&self, broker: Option<String>) {
        self.parties.lock().unwrap_or_else(PoisonError::into_inner).controller_at = broker;
        self.settle();
    }

    /// Sets the number of robots that the controller knows.
    pub fn knows(&self, robots: usize) {
        if self.known.swap(robots, Ordering::Relaxed) != robots {
            self.settle();
        }
    }

    fn settle(&self) {
        let parties = self.parties.lock().unwrap_or_else(PoisonError::into_inner);
        let together = parties.robots_at.is_some() && parties.robots_at == parties.controller_at;
        // A robot that is not simulated here keeps real time, so that the show clock must not wait.
        let only_ours = self.known.load(Ordering::Relaxed) <= self.simulated.load(Ordering::Relaxed);
        self.may_slow.store(together && only_ours, Ordering::Relaxed);
    }

    /// Whether the show clock may wait for simulated robots. Requires that they use the controller's broker, and that the
    /// controller knows no more robots than are simulated.
    pub fn may_slow(&self) -> bool {
        self.may_slow.load(Ordering::Relaxed)
    }

    /// Whether more messages are under way in either direction than are allowed. The show clock should then wait.
    pub fn is_clogged(&self) -> bool {
        let bound = UNDER_WAY + self.simulated.load(Ordering::Relaxed) as u64 / ROBOTS_A_MESSAGE;
        self.reports.under_way() > bound || self.commands.under_way() > bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_waits_only_where_all_robots_are_simulated_on_the_controllers_broker() {
        let pace = Pace::default();
        assert!(!pace.may_slow());
        pace.simulates(30, Some("mqtt://here".into()));
        pace.knows(30);
        assert!(!pace.may_slow(), "the controller is nowhere");
        pace.controls(Some("mqtt://here".into()));
        assert!(pace.may_slow());
        pace.knows(31);
        assert!(!pace.may_slow(), "one of them lives by another clock");
        pace.knows(30);
        pace.controls(Some("mqtt://there".into()));
        assert!(!pace.may_slow(), "its robots are others");
    }

    #[test]
    fn time_waits_for_messages_in_either_direction_but_not_for_lost_ones() {
        let pace = Pace::default();
        pace.simulates(8 * 76, None);
        pace.commands.say(1100);
        assert!(!pace.is_clogged());
        pace.commands.say(1);
        assert!(pace.is_clogged());
        pace.commands.hear(1);
        assert!(!pace.is_clogged());
        pace.reports.say(9000);
        assert!(pace.is_clogged());
        pace.reports.forget();
        assert!(!pace.is_clogged());
        pace.reports.hear(5000);
        assert!(!pace.is_clogged(), "what others say counts for nothing");
    }
}

//! How fast time may go where controller and simulated robots share a machine that is too slow for them.
//!
//! Robots that a machine cannot simulate in time, or whose messages it cannot pass on in time, would seem late and
//! silent, and the show would stop for them again and again. Where all robots are simulated here, the show clock waits
//! instead: everything goes its way, only slower.

use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Number of messages that may be under way in one direction without holding time up, …
const UNDER_WAY: u64 = 1024;
/// … plus one message for each `ROBOTS_A_MESSAGE` robots.
const ROBOTS_A_MESSAGE: u64 = 8;

/// Shared by the task of the controller and that of the simulated robots.
#[derive(Debug, Default)]
pub struct Pace {
    parties: Mutex<Parties>,
    may_slow: AtomicBool,
    known: AtomicUsize,
    simulated: AtomicUsize,
    /// Messages of robots.
    pub reports: Flow,
    /// Messages to single robots.
    pub commands: Flow,
}

/// The broker that each party uses.
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

    /// Number of messages received, or given up as lost by [`forget`](Self::forget).
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
        // One robot of flesh and blood among them, and time is what its clock says.
        let only_ours = self.known.load(Ordering::Relaxed) <= self.simulated.load(Ordering::Relaxed);
        self.may_slow.store(together && only_ours, Ordering::Relaxed);
    }

    /// Whether time may wait for the simulated robots, because no other robots use it.
    pub fn may_slow(&self) -> bool {
        self.may_slow.load(Ordering::Relaxed)
    }

    /// Whether more messages are under way than `UNDER_WAY` allows, so that time should wait for them.
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

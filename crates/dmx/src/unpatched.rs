//! Universes that a desk sends and that have no robots, collected so that one message names them.

use std::collections::BTreeSet;

use lightbots_base::{Instant, Span};

/// Largest number of universes that are named to people. Bounds memory and the length of messages, because packets may come
/// from any program on the network.
const NAMED_MAX: usize = 16;
/// How long universes are collected before they are named, from the first packet or from when robots were last added. A
/// desk sends all its universes within this time (ANSI E1.31-2018, 6.6.2: each of them every 0.8 to 1 s).
const COLLECTED: Span = Span::from_millis(1_000);

/// The universes that desks send although no robot has channels in them.
#[derive(Debug, Default)]
pub(crate) struct UnpatchedUniverses {
    /// Universes that were not named to people yet.
    waiting: BTreeSet<u16>,
    /// Universes that were named to people.
    named: BTreeSet<u16>,
    /// Whether packets of more than [`NAMED_MAX`] universes came.
    has_more: bool,
    /// Whether people were told that there are more universes than are named.
    is_more_told: bool,
    /// When collecting began; see [`COLLECTED`].
    since: Instant,
}

impl UnpatchedUniverses {
    /// Notes a packet of a universe that has no robots.
    pub fn receive(&mut self, now: Instant, universe: u16) {
        if self.named.contains(&universe) || self.waiting.contains(&universe) {
            return;
        }
        if self.named.len() + self.waiting.len() >= NAMED_MAX {
            self.has_more = true;
            return;
        }
        if self.waiting.is_empty() {
            self.since = now;
        }
        self.waiting.insert(universe);
    }

    /// Notes that robots were added at `now`. `is_patched` returns whether robots now have channels in a universe.
    /// Collecting begins again.
    pub fn robots_added(&mut self, now: Instant, is_patched: impl Fn(u16) -> bool) {
        self.waiting.retain(|&universe| !is_patched(universe));
        // Packets that come until the universes are named tell whether there are still more.
        self.has_more = self.is_more_told;
        self.since = now;
    }

    /// Whether people must still be told something: a universe, or that there are more than are named.
    pub fn is_waiting(&self) -> bool {
        !self.waiting.is_empty() || self.has_more && !self.is_more_told
    }

    /// Takes the universes that people should be told at `now`, in order, and whether there are more than are named. `None`
    /// if there is nothing to tell, or collecting is not over.
    pub fn take(&mut self, now: Instant) -> Option<(Vec<u16>, bool)> {
        if !self.is_waiting() || now - self.since < COLLECTED {
            return None;
        }
        self.is_more_told = self.has_more;
        let taken: Vec<u16> = std::mem::take(&mut self.waiting).into_iter().collect();
        self.named.extend(&taken);
        Some((taken, self.has_more))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ms(ms: u64) -> Instant {
        Instant(ms * 1_000)
    }

    #[test]
    fn all_universes_are_named_once_in_one_message() {
        let mut unpatched = UnpatchedUniverses::default();
        for _ in 0..3 {
            [7, 3, 9].into_iter().for_each(|universe| unpatched.receive(ms(0), universe));
        }
        assert_eq!(unpatched.take(ms(999)), None);
        assert_eq!(unpatched.take(ms(1_000)), Some((vec![3, 7, 9], false)));
        unpatched.receive(ms(1_100), 3);
        assert!(!unpatched.is_waiting() && unpatched.take(ms(9_000)).is_none());
        unpatched.receive(ms(9_000), 4);
        assert_eq!(unpatched.take(ms(10_000)), Some((vec![4], false)));
    }

    #[test]
    fn universes_whose_robots_come_meanwhile_are_not_named() {
        let mut unpatched = UnpatchedUniverses::default();
        [2, 3].into_iter().for_each(|universe| unpatched.receive(ms(0), universe));
        unpatched.robots_added(ms(900), |universe| universe == 2);
        assert_eq!(unpatched.take(ms(1_800)), None);
        assert_eq!(unpatched.take(ms(1_900)), Some((vec![3], false)));
    }

    #[test]
    fn the_names_are_bounded_and_people_are_told_that_there_are_more() {
        let mut unpatched = UnpatchedUniverses::default();
        (0..5_000).for_each(|universe| unpatched.receive(ms(0), universe));
        let named = (0..NAMED_MAX as u16).collect();
        assert_eq!(unpatched.take(ms(1_000)), Some((named, true)));
        (5_000..9_000).for_each(|universe| unpatched.receive(ms(2_000), universe));
        assert!(!unpatched.is_waiting());
    }

    #[test]
    fn a_universe_beyond_those_that_were_named_before_is_told_as_more() {
        let mut unpatched = UnpatchedUniverses::default();
        (0..NAMED_MAX as u16).for_each(|universe| unpatched.receive(ms(0), universe));
        assert!(unpatched.take(ms(1_000)).is_some_and(|(_, has_more)| !has_more));
        unpatched.receive(ms(5_000), 99);
        assert_eq!(unpatched.take(ms(5_000)), Some((Vec::new(), true)));
        assert!(!unpatched.is_waiting());
    }
}

//! Detects that two robots share a name, because each takes the connection of that client id from the other. A robot
//! that reconnects after its connection died does so once, and its old connection was silent.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::limits;

/// Number of take-overs of one client id from which on two robots are assumed to share the name.
const TAKEOVERS: u32 = 3;
/// Time within which [`TAKEOVERS`] take-overs must happen.
const WITHIN: Duration = Duration::from_secs(10);
/// A take-over counts only if the client logged in or published a message within this time before the take-over.
const ALIVE: Duration = Duration::from_secs(1);

/// Latest login or message, and counted take-overs, by client id.
#[derive(Debug, Default)]
pub struct Takeovers(Mutex<BTreeMap<String, Contest>>);

#[derive(Clone, Copy, Debug)]
struct Contest {
    /// Time of the client's last login or published message.
    active: Instant,
    /// Time of the first of the counted take-overs.
    since: Instant,
    count: u32,
}

impl Takeovers {
    /// Notes that a client logged in or published a message.
    pub fn active(&self, client: &str, now: Instant) {
        let mut contests = self.lock();
        if let Some(contest) = contests.get_mut(client) {
            contest.active = now;
            return;
        }
        if contests.len() >= 2 * limits::CONNECTIONS {
            contests.retain(|_, contest| now.duration_since(contest.active) < WITHIN);
        }
        contests.insert(client.to_owned(), Contest { active: now, since: now, count: 0 });
    }

    /// Counts a new connection that takes over the one of the same client id. Returns whether two robots seem to share the
    /// client id.
    pub fn taken_over(&self, client: &str, now: Instant) -> bool {
        let mut contests = self.lock();
        let Some(contest) = contests.get_mut(client) else { return false };
        if now.duration_since(contest.active) > ALIVE {
            contest.count = 0;
            return false;
        }
        if contest.count == 0 || now.duration_since(contest.since) > WITHIN {
            (contest.since, contest.count) = (now, 0);
        }
        contest.count += 1;
        contest.count >= TAKEOVERS
    }

    fn lock(&self) -> MutexGuard<'_, BTreeMap<String, Contest>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether each take-over at these moments, milliseconds, shows that two robots share the name; each new connection
    /// sends packets until `talks_ms` later.
    fn found(takeovers_ms: &[u64], talks_ms: u64) -> Vec<bool> {
        let (takeovers, began) = (Takeovers::default(), Instant::now());
        takeovers.active("LightBot/r1", began);
        let at = |ms| began + Duration::from_millis(ms);
        let takes = takeovers_ms.iter().map(|&ms| {
            let found = takeovers.taken_over("LightBot/r1", at(ms));
            takeovers.active("LightBot/r1", at(ms + talks_ms));
            found
        });
        takes.collect()
    }

    #[test]
    fn three_takeovers_of_living_connections_are_two_robots() {
        assert_eq!(found(&[500, 1_500, 2_500, 3_500], 100), [false, false, true, true]);
        assert_eq!(found(&[500, 1_500, 12_000, 13_000], 11_000), [false, false, false, false]);
    }

    #[test]
    fn a_robot_whose_connections_die_is_one() {
        assert_eq!(found(&[500, 2_500, 4_500, 6_500, 8_500], 100), [false; 5]);
    }
}

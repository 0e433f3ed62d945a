//! Bounds the rate at which a client publishes. A client above it loses its connection, and may not connect for a
//! while, because its messages would delay the reports of all others.

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::limits::{self, Rate};

/// What clients have published, by client id.
#[derive(Debug, Default)]
pub struct Floods(Mutex<BTreeMap<String, Account>>);

#[derive(Clone, Copy, Debug)]
struct Account {
    /// Time at which the client would have sent all counted messages if it kept to the allowed rate.
    paid_until: Instant,
    /// End of the time in which the client may not connect; `None`: it was never cut off.
    banned_until: Option<Instant>,
}

impl Floods {
    /// Counts a message of a client. Returns false if the client has sent too many. The client may then not connect for
    /// [`limits::FLOOD_BAN`], and the caller cuts it off.
    pub fn count(&self, client: &str, rate: Rate, now: Instant) -> bool {
        let mut accounts = self.lock();
        if !accounts.contains_key(client) {
            forget_idle(&mut accounts, now);
            accounts.insert(client.to_owned(), Account { paid_until: now, banned_until: None });
        }
        let Some(account) = accounts.get_mut(client) else { return true };
        let cost = Duration::from_secs(1) / rate.per_second.max(1);
        account.paid_until = account.paid_until.max(now) + cost;
        if account.paid_until.duration_since(now) <= cost * rate.burst {
            return true;
        }
        *account = Account { paid_until: now, banned_until: Some(now + limits::FLOOD_BAN) };
        false
    }

    /// Whether a client may not connect, because it was cut off less than [`limits::FLOOD_BAN`] ago.
    pub fn is_banned(&self, client: &str, now: Instant) -> bool {
        self.lock().get(client).and_then(|account| account.banned_until).is_some_and(|until| now < until)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeMap<String, Account>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Bounds the memory: if there are many accounts, removes those whose `paid_until` and ban are over.
fn forget_idle(accounts: &mut BTreeMap<String, Account>, now: Instant) {
    if accounts.len() >= 2 * limits::CONNECTIONS {
        accounts.retain(|_, account| {
            account.paid_until > now || account.banned_until.is_some_and(|until| until > now)
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RATE: Rate = Rate { per_second: 100, burst: 50 };

    #[test]
    fn a_client_may_send_a_burst_and_then_its_rate() {
        let (floods, began) = (Floods::default(), Instant::now());
        assert!((0..50).all(|_| floods.count("a", RATE, began)));
        for step in 1..1_000 {
            assert!(floods.count("a", RATE, began + Duration::from_millis(10 * step)), "{step}");
        }
    }

    #[test]
    fn a_client_that_floods_is_cut_off_and_banned_for_a_while_and_others_are_not() {
        let (floods, began) = (Floods::default(), Instant::now());
        let sent = (0..1_000).take_while(|_| floods.count("a", RATE, began)).count();
        assert_eq!(sent, 50);
        assert!(floods.is_banned("a", began) && !floods.is_banned("b", began));
        assert!(floods.count("b", RATE, began));
        let later = began + limits::FLOOD_BAN;
        assert!(!floods.is_banned("a", later) && floods.count("a", RATE, later));
    }
}

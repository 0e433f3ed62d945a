//! Limits how often passwords can be guessed. Strangers cannot lock an operator out for ever.
//!
//! Three limits hold at once. For each pair of name and network address: a pause after [`TRIES`] wrong passwords, doubled
//! after each further [`TRIES`]. For each name, and for all names together: a token bucket of wrong passwords that refills
//! slowly. The two buckets do not limit attempts from this machine, nor from an address from which that name has signed in
//! before. Strangers rarely share such an address, so they cannot lock the name out there.

use std::collections::{BTreeMap, BTreeSet};
use std::net::{IpAddr, Ipv6Addr};
use std::time::{Duration, Instant};

use super::NAME_MAX;

/// Number of wrong passwords for one name from one address after which a pause follows.
pub const TRIES: u32 = 5;
/// Length of the first pause. Each further pause is twice as long as the one before, up to [`PAUSE_MAX`].
const PAUSE: Duration = Duration::from_secs(60);
/// The longest pause.
const PAUSE_MAX: Duration = Duration::from_secs(3600);
/// Time after a pair's latest wrong password, or after the end of its latest pause, at which its count is forgotten. The
/// next pause then has the length [`PAUSE`] again.
const FORGOTTEN_AFTER: Duration = Duration::from_secs(2 * 3600);
/// Token bucket for the wrong passwords of one name from all addresses that are not exempt.
const OF_NAME: Bucket = Bucket { most: 20, refill: Duration::from_secs(60) };
/// Token bucket for the wrong passwords of all names together, from all addresses that are not exempt.
const IN_WHOLE: Bucket = Bucket { most: 60, refill: Duration::from_secs(10) };
/// Most pairs of name and address whose wrong passwords are counted. Bounds the memory, because the buckets do not limit
/// attempts from this machine. Beyond it, the pair with the earliest end of its pause is forgotten. An attacker needs about
/// this number of wrong passwords to get a pair forgotten. Hashing all of them takes longer than the first pauses.
const PAIRS_MAX: usize = 10_000;
/// Number of a name's first characters by which wrong passwords are counted: one more than a valid name may have. Bounds the
/// memory for long names.
const LETTERS_MAX: usize = NAME_MAX + 1;
/// Most pairs of name and address with a successful sign-in that are remembered. Beyond it, the pair whose name is first in
/// the order of characters is forgotten.
const KNOWN_MAX: usize = 1_000;

/// Token bucket: it allows `most` wrong passwords at once, and one more after each `refill`.
struct Bucket {
    most: u32,
    refill: Duration,
}

/// State of a bucket: the moment at which it will be full again. `None`: it is full.
type FullAt = Option<Instant>;

impl Bucket {
    /// Returns how long an attempt at `now` has to wait until the bucket allows it. Zero: not at all.
    fn wait(&self, full_at: FullAt, now: Instant) -> Duration {
        let debt = full_at.map_or(Duration::ZERO, |full| full.saturating_duration_since(now));
        debt.saturating_sub(self.refill * (self.most - 1))
    }

    fn spend(&self, full_at: FullAt, now: Instant) -> FullAt {
        Some(full_at.map_or(now, |full| full.max(now)) + self.refill)
    }
}

/// Wrong passwords for one name from one address.
#[derive(Clone, Copy, Debug)]
struct Pair {
    wrong: u32,
    paused_until: Instant,
}

/// What a person may still try after a wrong password.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TriesLeft {
    /// Number of wrong passwords that are left until the next pause; 0: the pause has begun.
    pub tries: u32,
    /// Length of the next pause, or of the pause that has begun.
    pub pause: Duration,
}

/// Counted wrong passwords, and addresses from which names have signed in.
#[derive(Debug, Default)]
pub struct SignInTries {
    pairs: BTreeMap<(String, IpAddr), Pair>,
    names: BTreeMap<String, FullAt>,
    whole: FullAt,
    known: BTreeSet<(String, IpAddr)>,
}

impl SignInTries {
    /// Returns `Ok` if a password may be tried at `now`, else how long to wait.
    pub fn may_try(&self, name: &str, address: IpAddr, now: Instant) -> Result<(), Duration> {
        let key = key(name, address);
        let pause = self
            .pairs
            .get(&key)
            .map_or(Duration::ZERO, |pair| pair.paused_until.saturating_duration_since(now));
        let name_full_at = self.names.get(&key.0).copied().flatten();
        let buckets = OF_NAME.wait(name_full_at, now).max(IN_WHOLE.wait(self.whole, now));
        let wait = if self.is_trusted(&key) { pause } else { pause.max(buckets) };
        if wait.is_zero() { Ok(()) } else { Err(wait) }
    }

    /// Counts a wrong password and returns the tries that are left.
    pub fn wrong(&mut self, name: &str, address: IpAddr, now: Instant) -> TriesLeft {
        self.pairs.retain(|_, pair| now < pair.paused_until + FORGOTTEN_AFTER);
        self.names.retain(|_, full_at| full_at.is_some_and(|full| now < full));
        let key = key(name, address);
        if !self.is_trusted(&key) {
            let full_at = self.names.entry(key.0.clone()).or_default();
            *full_at = OF_NAME.spend(*full_at, now);
            self.whole = IN_WHOLE.spend(self.whole, now);
        }
        if self.pairs.len() >= PAIRS_MAX && !self.pairs.contains_key(&key) {
            let first =
                self.pairs.iter().min_by_key(|(_, pair)| pair.paused_until).map(|(key, _)| key.clone());
            first.and_then(|first| self.pairs.remove(&first));
        }
        let pair = self.pairs.entry(key).or_insert(Pair { wrong: 0, paused_until: now });
        pair.wrong = pair.wrong.saturating_add(1);
        let doublings = ((pair.wrong - 1) / TRIES).min(16);
        let pause = (PAUSE * 2u32.pow(doublings)).min(PAUSE_MAX);
        let tries = (TRIES - pair.wrong % TRIES) % TRIES;
        pair.paused_until = if tries == 0 { now + pause } else { now };
        TriesLeft { tries, pause }
    }

    /// Notes a right password: forgets the wrong ones for this name and address, and exempts this pair from the buckets.
    pub fn right(&mut self, name: &str, address: IpAddr) {
        let key = key(name, address);
        self.pairs.remove(&key);
        self.known.insert(key);
        if self.known.len() > KNOWN_MAX {
            self.known.pop_first();
        }
    }

    fn is_trusted(&self, key: &(String, IpAddr)) -> bool {
        key.1.is_loopback() || self.known.contains(key)
    }
}

/// Returns the key by which wrong passwords are counted: the name's first characters, and the address or its network.
fn key(name: &str, address: IpAddr) -> (String, IpAddr) {
    (name.chars().take(LETTERS_MAX).collect(), network(address))
}

/// Returns the address by which a client is counted. For an IPv6 address, this is the /64 network, because one machine
/// can use every address of its network. Loopback and IPv4 addresses stay as they are. An IPv4 address in IPv6 form
/// becomes IPv4.
fn network(address: IpAddr) -> IpAddr {
    match address.to_canonical() {
        IpAddr::V6(address) if !address.is_loopback() => {
            IpAddr::V6(Ipv6Addr::from_bits(address.to_bits() & !u128::from(u64::MAX)))
        }
        address => address,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    fn address(number: u32) -> IpAddr {
        IpAddr::V4((0x0a00_0000 + number).into())
    }

    #[test]
    fn a_pause_follows_five_wrong_passwords_and_doubles_up_to_an_hour() {
        let (mut tries, mut now) = (SignInTries::default(), Instant::now());
        let mut pauses = Vec::new();
        for _ in 0..8 {
            for left_over in (0..TRIES).rev() {
                // The buckets are not tested here, because they do not hold for the machine's own address.
                assert_eq!(tries.may_try("ann", IpAddr::from([127, 0, 0, 1]), now), Ok(()));
                let left = tries.wrong("ann", IpAddr::from([127, 0, 0, 1]), now);
                assert_eq!(left.tries, left_over);
                if left_over == 0 {
                    let refused =
                        tries.may_try("ann", IpAddr::from([127, 0, 0, 1]), now + left.pause - SECOND);
                    assert_eq!(refused, Err(SECOND));
                    now += left.pause;
                    pauses.push(left.pause.as_secs() / 60);
                }
            }
        }
        assert_eq!(pauses, [1, 2, 4, 8, 16, 32, 60, 60]);
        tries.right("ann", IpAddr::from([127, 0, 0, 1]));
        assert_eq!(tries.wrong("ann", IpAddr::from([127, 0, 0, 1]), now).tries, TRIES - 1);
    }

    #[test]
    fn ten_thousand_guesses_from_many_addresses_are_few_tries() {
        let (mut tries, began) = (SignInTries::default(), Instant::now());
        let mut tried = 0;
        for number in 0..10_000 {
            let now = began + SECOND * number;
            if tries.may_try("ann", address(number), now).is_ok() {
                tries.wrong("ann", address(number), now);
                tried += 1;
            }
        }
        assert_eq!(tried, OF_NAME.most + 9_999 / 60, "the bucket at the start, and one each minute");
        assert!(tries.pairs.len() <= tried as usize && tries.names.len() == 1);
    }

    #[test]
    fn ten_thousand_guesses_from_one_address_are_fewer_still() {
        let (mut tries, began) = (SignInTries::default(), Instant::now());
        let mut tried = 0;
        for number in 0..10_000 {
            let now = began + SECOND * number;
            if tries.may_try("ann", address(1), now).is_ok() {
                tries.wrong("ann", address(1), now);
                tried += 1;
            }
        }
        // Pauses of 1, 2, 4, 8, 16, 32 and 60 minutes fill 123 of 167 minutes.
        assert!(tried <= 8 * TRIES, "{tried}");
    }

    #[test]
    fn guesses_at_many_names_are_bounded_in_whole() {
        let (mut tries, began) = (SignInTries::default(), Instant::now());
        let mut tried = 0;
        for number in 0..10_000 {
            let now = began + SECOND * number;
            let name = format!("name{number}");
            if tries.may_try(&name, address(number), now).is_ok() {
                tries.wrong(&name, address(number), now);
                tried += 1;
            }
        }
        assert_eq!(tried, IN_WHOLE.most + 9_999 / 10, "the bucket at the start, and one each ten seconds");
    }

    #[test]
    fn a_stranger_does_not_close_the_machine_or_of_an_address_that_signed_in() {
        let (mut tries, now) = (SignInTries::default(), Instant::now());
        let (own, machine) = (address(1_000_000), IpAddr::from([127, 0, 0, 1]));
        tries.right("ann", own);
        for number in 0..10_000 {
            if tries.may_try("ann", address(number), now).is_ok() {
                tries.wrong("ann", address(number), now);
            }
        }
        assert!(tries.may_try("ann", address(20_000), now).is_err());
        assert_eq!(tries.may_try("ann", own, now), Ok(()));
        assert_eq!(tries.may_try("ann", machine, now), Ok(()));
        assert!(tries.may_try("bob", own, now).is_ok(), "20 guesses at one name leave room in whole");
    }

    #[test]
    fn strangers_on_this_machine_fill_no_memory_and_end_no_pause() {
        let (mut tries, now) = (SignInTries::default(), Instant::now());
        let machine = IpAddr::from([127, 0, 0, 1]);
        for _ in 0..TRIES {
            tries.wrong("ann", machine, now);
        }
        for number in 0..2 * PAIRS_MAX {
            let name = format!("{number}{}", "x".repeat(4000));
            assert!(tries.may_try(&name, machine, now).is_ok());
            tries.wrong(&name, machine, now);
        }
        assert_eq!(tries.pairs.len(), PAIRS_MAX);
        assert!(tries.pairs.keys().all(|(name, _)| name.len() <= LETTERS_MAX));
        assert!(tries.may_try("ann", machine, now).is_err(), "the pause of a name that is guessed at stays");
    }

    #[test]
    fn one_machine_has_one_network_of_version_6() {
        let of = |text: &str| network(text.parse().unwrap());
        assert_eq!(of("2001:db8::1"), of("2001:db8::ffff:1"));
        assert_ne!(of("2001:db8::1"), of("2001:db8:0:1::1"));
        assert_eq!(of("::ffff:10.0.0.1"), of("10.0.0.1"));
        assert_eq!(of("::1"), "::1".parse::<IpAddr>().unwrap());
    }
}

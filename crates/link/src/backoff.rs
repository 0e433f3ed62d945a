//! Waiting times between attempts to connect.

use std::time::Duration;

/// Waiting times that double from `FIRST` to `LONGEST`. Each is shortened at random by up to a half, so that the robots
/// of a fleet do not all reconnect at one moment.
#[derive(Debug)]
pub(crate) struct Backoff {
    next: Duration,
}

impl Backoff {
    /// First waiting time. With a shorter one, a dead broker would be tried too often. With a longer one, a restarted
    /// broker could be found later than the 1.9 s without messages after which robots stop (R43 of docs/protocol.md).
    const FIRST: Duration = Duration::from_millis(100);
    /// Longest waiting time. A broker that is back is found within it, which is about as long as robots drive on
    /// without messages (1.9 s, R43).
    const LONGEST: Duration = Duration::from_secs(2);

    pub(crate) fn new() -> Self {
        Self { next: Self::FIRST }
    }

    /// Begins again with `FIRST`, after a successful attempt.
    pub(crate) fn reset(&mut self) {
        self.next = Self::FIRST;
    }

    /// Returns the time until the next attempt, and doubles the next waiting time, up to `LONGEST`. `jitter` is a
    /// random number from the whole range of `u32`; a smaller number gives a shorter time.
    pub(crate) fn wait(&mut self, jitter: u32) -> Duration {
        let full = self.next;
        self.next = (full * 2).min(Self::LONGEST);
        full.mul_f64(0.5 + 0.5 * f64::from(jitter) / f64::from(u32::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waits_double_up_to_a_bound_and_start_again() {
        let mut backoff = Backoff::new();
        let waits: Vec<_> = (0..7).map(|_| backoff.wait(u32::MAX).as_millis()).collect();
        assert_eq!(waits, [100, 200, 400, 800, 1600, 2000, 2000]);
        backoff.reset();
        assert_eq!(backoff.wait(0).as_millis(), 50);
    }
}

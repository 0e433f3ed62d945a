//! How long to wait before the next attempt.

use std::time::Duration;

/// Waiting times that double from 100 ms to 2 s, each shortened at random by up to a half, so that a fleet that lost
/// its broker does not come back all at once.
#[derive(Debug)]
pub(crate) struct Backoff {
    next: Duration,
}

impl Backoff {
    const FIRST: Duration = Duration::from_millis(100);
    const LONGEST: Duration = Duration::from_secs(2);

    pub(crate) fn new() -> Self {
        Self { next: Self::FIRST }
    }

    /// The attempt succeeded.
    pub(crate) fn reset(&mut self) {
        self.next = Self::FIRST;
    }

    /// How long to wait now; `jitter` is any random number.
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

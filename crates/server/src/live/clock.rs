//! The show clock of this program.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use lightbots_base::Instant;

/// Microseconds since 1970 at the program's start, from then on counted by the monotonic clock: it never goes back,
/// and a controller that is started again goes on close to where the one before it was.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    began: std::time::Instant,
    offset_us: u64,
}

impl Clock {
    /// A clock that starts now.
    pub fn start() -> Self {
        let since_1970 = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Self { began: std::time::Instant::now(), offset_us: since_1970.as_micros() as u64 }
    }

    /// The moment it is.
    pub fn now(&self) -> Instant {
        Instant(self.offset_us + self.began.elapsed().as_micros() as u64)
    }

    /// When the system's clock shows `at`; at once for a moment that is over.
    pub fn deadline(&self, at: Instant) -> tokio::time::Instant {
        let after_start = Duration::from_micros(at.0.saturating_sub(self.offset_us));
        tokio::time::Instant::from_std(self.began + after_start.min(Duration::from_secs(86_400 * 365)))
    }

    /// A first route number that no controller started before on this machine has reached.
    pub fn seq_base(&self) -> u32 {
        ((self.offset_us / 1_000_000 * 8) as u32).max(1)
    }
}

/// Milliseconds since 1970.
pub fn unix_ms() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_millis() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deadlines_are_moments_of_the_same_clock() {
        let clock = Clock::start();
        let now = clock.now();
        let later = clock.deadline(Instant(now.0 + 5_000_000)) - clock.deadline(now);
        assert_eq!(later, Duration::from_secs(5));
        assert!(clock.deadline(Instant::ZERO) <= tokio::time::Instant::now());
        assert!(clock.now() >= now);
    }
}

//! The show clock of this program.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use lightbots_base::Instant;
use lightbots_control::{ComputerTime, Uptime};

/// The show clock, in microseconds. A new clock begins with the microseconds since 1970, or continues the clock of a
/// run that was cut off. It never goes back, and runs while the computer sleeps, as robots' clocks do. It can be held
/// for a while, together with all its clones.
#[derive(Clone, Debug)]
pub struct Clock {
    began: Duration,
    offset_us: u64,
    shared: Arc<Shared>,
}

/// State that all clones of a clock share. Its times are microseconds that the clock shows more than at its start.
#[derive(Debug)]
struct Shared {
    /// How long the clock had been held in total at the last [`Clock::grant`].
    withheld_us: AtomicU64,
    /// Latest time that the clock may show; it is held there.
    limit_us: AtomicU64,
    /// Latest time that the clock has shown.
    shown_us: AtomicU64,
}

impl Clock {
    /// A clock that starts now.
    pub fn start() -> Self {
        Self::starting_at(unix_us())
    }

    /// A clock that shows this many microseconds now.
    pub fn starting_at(offset_us: u64) -> Self {
        let shared = Shared {
            withheld_us: AtomicU64::new(0),
            limit_us: AtomicU64::new(u64::MAX),
            shown_us: AtomicU64::new(0),
        };
        Self { began: uptime(), offset_us, shared: Arc::new(shared) }
    }

    /// Returns the present time.
    pub fn now(&self) -> Instant {
        let us = self.free_us().min(self.shared.limit_us.load(Ordering::Relaxed));
        Instant(self.offset_us + self.shared.shown_us.fetch_max(us, Ordering::Relaxed).max(us))
    }

    /// Lets the clock run until it shows `until`, where it is held. With [`Instant::FAR`], it is not held. Only one
    /// task may call this.
    pub fn grant(&self, until: Instant) {
        let over_us = self.free_us().saturating_sub(self.shared.limit_us.load(Ordering::Relaxed));
        self.shared.withheld_us.fetch_add(over_us, Ordering::Relaxed);
        self.shared.limit_us.store(until.0.saturating_sub(self.offset_us), Ordering::Relaxed);
    }

    fn free_us(&self) -> u64 {
        let elapsed_us = uptime().saturating_sub(self.began).as_micros() as u64;
        elapsed_us.saturating_sub(self.shared.withheld_us.load(Ordering::Relaxed))
    }

    /// Returns how long the clock has been held since its start, up to the last [`grant`](Self::grant).
    pub fn withheld(&self) -> Duration {
        Duration::from_micros(self.shared.withheld_us.load(Ordering::Relaxed))
    }

    /// Returns the moment of tokio's clock at which this clock shows `at`, unless it is held before. If `at` has passed,
    /// returns the present moment. A moment more than a year ahead becomes a year ahead.
    pub fn deadline(&self, at: Instant) -> tokio::time::Instant {
        let ahead = Duration::from_micros(at.0.saturating_sub(self.now().0));
        tokio::time::Instant::now() + ahead.min(Duration::from_secs(86_400 * 365))
    }
}

/// Returns the time since a fixed moment, with the computer's sleep included. On Linux and macOS, `std::time::Instant`
/// does not count the sleep.
#[cfg(unix)]
fn uptime() -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    #[cfg(any(target_os = "linux", target_os = "android"))]
    let clock = ClockId::Boottime;
    #[cfg(not(any(target_os = "linux", target_os = "android")))]
    let clock = ClockId::Monotonic;
    let shown = clock_gettime(clock);
    Duration::new(shown.tv_sec.unsigned_abs(), shown.tv_nsec.unsigned_abs() as u32)
}

/// Returns the time since the first call. The system's counter runs while the computer sleeps.
#[cfg(not(unix))]
fn uptime() -> Duration {
    static FIRST: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    FIRST.get_or_init(std::time::Instant::now).elapsed()
}

/// Reads the clocks by which a restarted program continues the show clock of a run that was cut off.
pub fn computer_time() -> ComputerTime {
    let us = uptime().as_micros() as u64;
    ComputerTime { wall_us: unix_us(), uptime: boot().map(|boot| Uptime { boot, us }) }
}

/// Returns the number that Linux draws at random when the computer starts; `None` on other systems.
fn boot() -> Option<u128> {
    static BOOT: std::sync::OnceLock<Option<u128>> = std::sync::OnceLock::new();
    let read = || {
        let text = std::fs::read_to_string("/proc/sys/kernel/random/boot_id").ok()?;
        u128::from_str_radix(&text.trim().replace('-', ""), 16).ok()
    };
    *BOOT.get_or_init(read)
}

/// Returns the number for a controller's first route: eight times the seconds since 1970, modulo 2³², but at least 1. A
/// controller that started earlier on this machine is below that number, unless it used more than eight numbers a
/// second.
pub fn seq_base() -> u32 {
    ((unix_us() / 1_000_000 * 8) as u32).max(1)
}

/// Milliseconds since 1970.
pub fn unix_ms() -> u64 {
    unix_us() / 1_000
}

/// Microseconds since 1970.
pub fn unix_us() -> u64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_micros() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_computer_tells_the_time_that_passed() {
        let before = computer_time();
        std::thread::sleep(Duration::from_millis(2));
        let after = computer_time();
        assert!(after.us_since(&before) >= 2_000);
        // A time of day that is set does not count where the system says which start of the computer it was.
        let set_back = ComputerTime { wall_us: 0, ..after };
        assert_eq!(set_back.us_since(&before) > 0, before.uptime.is_some());
    }

    #[test]
    fn deadlines_are_moments_of_the_same_clock() {
        let clock = Clock::start();
        let now = clock.now();
        clock.grant(now);
        let before = tokio::time::Instant::now();
        let later = clock.deadline(Instant(now.0 + 5_000_000)) - Duration::from_secs(5);
        assert!(before <= later && later <= tokio::time::Instant::now());
        assert!(clock.deadline(Instant::ZERO) <= tokio::time::Instant::now());
        assert!(clock.now() >= now);
    }

    #[test]
    fn a_clock_goes_as_far_as_it_may_for_all_and_never_back() {
        let clock = Clock::start();
        let other = clock.clone();
        let shown = other.now();
        clock.grant(shown);
        assert_eq!((other.now(), clock.now()), (shown, shown), "it stands");
        while clock.free_us() + clock.offset_us < shown.0 + 2_000 {
            std::thread::yield_now();
        }
        assert_eq!(other.now(), shown);
        clock.grant(Instant::FAR);
        assert!(other.withheld() >= Duration::from_micros(2_000));
        assert!(other.now() >= shown, "it went back");
        while other.now() <= shown {
            std::thread::yield_now();
        }
    }
}

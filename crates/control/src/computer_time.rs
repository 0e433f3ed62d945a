//! The clocks of the controller's computer. By them a new controller continues the show clock of the controller before
//! it.

use serde::{Deserialize, Serialize};

/// What the clocks of a computer read at one moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ComputerTime {
    /// Time of day, microseconds since 1970. It may be set forwards or back at any moment.
    pub wall_us: u64,
    /// For how long the computer has been on; `None` on systems that do not say which start of the computer it was.
    pub uptime: Option<Uptime>,
}

/// For how long a computer has been on. This clock cannot be set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Uptime {
    /// Number that the system draws at random at each start of the computer.
    pub boot: u128,
    /// Time since that start, with the computer's sleep included, microseconds.
    pub us: u64,
}

impl ComputerTime {
    /// Microseconds from an earlier reading to this one. The uptime counts if both readings have one of the same start
    /// of the computer and it did not go back. Otherwise the time of day counts; then the result is 0 if that was set
    /// back.
    pub fn us_since(&self, earlier: &Self) -> u64 {
        match (self.uptime, earlier.uptime) {
            (Some(now), Some(then)) if now.boot == then.boot && now.us >= then.us => now.us - then.us,
            _ => self.wall_us.saturating_sub(earlier.wall_us),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BEFORE: ComputerTime =
        ComputerTime { wall_us: 1_000_000, uptime: Some(Uptime { boot: 7, us: 5_000 }) };

    #[test]
    fn a_time_of_day_that_was_set_does_not_count_on_the_same_start_of_the_computer() {
        for wall_us in [0, 1_000_000, 9_000_000] {
            let after = ComputerTime { wall_us, uptime: Some(Uptime { boot: 7, us: 8_000 }) };
            assert_eq!(after.us_since(&BEFORE), 3_000);
        }
    }

    #[test]
    fn the_time_of_day_counts_where_the_uptimes_cannot_be_compared() {
        let others = [None, Some(Uptime { boot: 8, us: 9_000 }), Some(Uptime { boot: 7, us: 4_000 })];
        for uptime in others {
            let later = ComputerTime { wall_us: 1_400_000, uptime };
            assert_eq!(later.us_since(&BEFORE), 400_000);
            assert_eq!(ComputerTime { wall_us: 5, uptime }.us_since(&BEFORE), 0, "it was set back");
        }
    }
}

//! When a relaxation is given more time, and how much.

/// Sweeps after which no more than a share of what was wrong may be left, or there is more time; and in a hurry.
const STAGE: (usize, f64) = (12, 0.5);
const HURRIED_STAGE: (usize, f64) = (10, 0.7);
/// Sweeps for the last few, which cost little and go in circles for a while.
const LAST_SWEEPS: usize = 24;
/// How much more time, for the last few, and how much more still for every contact of a robot, up to so many.
const GROWTH: f64 = 1.03;
const LAST_GROWTH: f64 = 1.02;
const GROWTH_A_CONTACT: f64 = 0.014;
const MOST_CONTACTS: f64 = 12.0;

/// How many times as much time there is after a stagnation that was in vain.
pub(crate) fn growth(hurry: bool, resolved: usize, few: usize, robots: usize) -> f64 {
    let crowding = if hurry { resolved as f64 / robots.max(1) as f64 } else { 0.0 };
    let least = if resolved <= few { LAST_GROWTH } else { GROWTH };
    least + GROWTH_A_CONTACT * crowding.min(MOST_CONTACTS)
}

/// Sweeps that are to bring something.
pub(crate) struct Stagnation {
    /// How many there may be, and what share of what was wrong may be left then.
    patience: (usize, f64),
    /// How many there have been.
    sweeps: usize,
    /// How much may be wrong after them.
    hoped: usize,
}

impl Stagnation {
    /// The first; in a `hurry` more time is given sooner.
    pub fn new(hurry: bool) -> Self {
        let patience = if hurry { HURRIED_STAGE } else { STAGE };
        Self { patience, sweeps: 0, hoped: usize::MAX }
    }

    /// Counts a sweep that left so much wrong; whether it ended a stagnation that did not bring enough.
    pub fn is_stagnant(&mut self, wrong: usize, only_few: bool) -> bool {
        self.sweeps += 1;
        let (sweeps, share) = self.patience;
        if self.sweeps < if only_few { LAST_SWEEPS } else { sweeps } {
            return false;
        }
        let is_stagnant = wrong > self.hoped;
        (self.sweeps, self.hoped) = (0, (wrong as f64 * share) as usize);
        is_stagnant
    }
}

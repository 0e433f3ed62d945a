//! When a deformation gets more time, and how much. Sweeps are counted in stages. A stage is in vain if too many
//! contacts are left at its end.

/// Sweeps of a stage, and the share of its contacts that may be left at its end.
const STAGE: (usize, f64) = (12, 0.5);
/// Sweeps of a stage with `hurry`, and the share of its contacts that may be left at its end. Time is added sooner.
const HURRIED_STAGE: (usize, f64) = (10, 0.7);
/// Sweeps of a stage with few contacts: they are cheap, and oscillate for some time.
const LAST_SWEEPS: usize = 24;
/// Factor on the duration after a stage in vain.
const GROWTH: f64 = 1.03;
/// Factor on the duration where few contacts are left.
const LAST_GROWTH: f64 = 1.02;
/// Addition to the factor for each contact per robot, with `hurry`.
const GROWTH_A_CONTACT: f64 = 0.014;
/// Most contacts per robot that count for this addition.
const MOST_CONTACTS: f64 = 12.0;

/// Factor on the duration after a stage in vain.
pub(crate) fn growth(hurry: bool, resolved: usize, few: usize, robots: usize) -> f64 {
    let crowding = if hurry { resolved as f64 / robots.max(1) as f64 } else { 0.0 };
    let least = if resolved <= few { LAST_GROWTH } else { GROWTH };
    least + GROWTH_A_CONTACT * crowding.min(MOST_CONTACTS)
}

/// Counts the sweeps of a stage, and detects stages that resolve too few contacts.
pub(crate) struct Stagnation {
    /// Sweeps of a stage, and the share of contacts that may be left.
    patience: (usize, f64),
    /// Sweeps of this stage.
    sweeps: usize,
    /// Contacts that may be left at the end of this stage.
    hoped: usize,
}

impl Stagnation {
    /// Begins the first stage; with `hurry`, time is added sooner.
    pub fn new(hurry: bool) -> Self {
        let patience = if hurry { HURRIED_STAGE } else { STAGE };
        Self { patience, sweeps: 0, hoped: usize::MAX }
    }

    /// Counts a sweep that left `wrong` contacts. Returns whether it ended a stage in vain.
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

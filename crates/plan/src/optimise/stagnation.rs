//! When a deformation makes the drive longer, and by how much. Sweeps of the deformation are counted in stages. A stage
//! is in vain if too many contacts are left at its end.

/// Number of sweeps of a stage, and the share of the contacts at its beginning that may be left at its end.
const STAGE: (usize, f64) = (12, 0.5);
/// As [`STAGE`], for deformations with `hurry`, which add time sooner.
const HURRIED_STAGE: (usize, f64) = (10, 0.7);
/// Number of sweeps of a stage with few contacts. These sweeps are cheap, and few contacts oscillate for some time.
const LAST_SWEEPS: usize = 24;
/// Factor on the duration of the drive after a stage in vain, if more than a few contacts are left.
const GROWTH: f64 = 1.03;
/// Factor on the duration of the drive after a stage in vain, if few contacts are left.
const LAST_GROWTH: f64 = 1.02;
/// Addition to [`GROWTH`] or [`LAST_GROWTH`] for each contact per robot, with `hurry`.
const GROWTH_A_CONTACT: f64 = 0.014;
/// Most contacts per robot that count for [`GROWTH_A_CONTACT`].
const MOST_CONTACTS: f64 = 12.0;

/// Returns the factor on the duration of the drive after a stage in vain. `resolved`: number of contacts in the last
/// sweep. Up to `few` contacts count as few.
pub(crate) fn growth(hurry: bool, resolved: usize, few: usize, robots: usize) -> f64 {
    let crowding = if hurry { resolved as f64 / robots.max(1) as f64 } else { 0.0 };
    let least = if resolved <= few { LAST_GROWTH } else { GROWTH };
    least + GROWTH_A_CONTACT * crowding.min(MOST_CONTACTS)
}

/// Counts the sweeps of a stage, and detects stages that resolve too few contacts.
pub(crate) struct Stagnation {
    /// Number of sweeps of a stage, and the share of contacts that may be left.
    patience: (usize, f64),
    /// Number of sweeps of this stage that have been made.
    sweeps: usize,
    /// Number of contacts that may be left at the end of this stage.
    hoped: usize,
}

impl Stagnation {
    /// Begins the first stage, with [`HURRIED_STAGE`] if `hurry`.
    pub fn new(hurry: bool) -> Self {
        let patience = if hurry { HURRIED_STAGE } else { STAGE };
        Self { patience, sweeps: 0, hoped: usize::MAX }
    }

    /// Counts a sweep that left `wrong` contacts and robots above their limits. Returns whether the sweep ended a stage
    /// in vain. `only_few`: whether few contacts are left.
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

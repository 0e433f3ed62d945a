//! Totals of all rehearsals under the same conditions.

use lightbots_sim::RehearsalReport;

/// Sums and worst values.
#[derive(Default)]
pub struct Tally {
    cases: usize,
    failed: usize,
    touched: usize,
    contacts: u64,
    braked: usize,
    brakes: u64,
    false_brakes: u64,
    /// The largest tracking error, metres, and the number of its case.
    worst: (f64, usize),
    show_s: f64,
}

impl Tally {
    /// Adds a rehearsal of a case.
    pub fn add(&mut self, index: usize, report: &RehearsalReport, passes: bool) {
        self.cases += 1;
        self.failed += usize::from(!passes);
        self.touched += usize::from(report.contacts > 0);
        self.contacts += report.contacts;
        self.braked += usize::from(report.brakes.all > 0);
        self.brakes += report.brakes.all;
        self.false_brakes += report.brakes.unfounded;
        self.show_s += report.duration_s;
        if report.tracking_error_m.max > self.worst.0 {
            self.worst = (report.tracking_error_m.max, index);
        }
    }

    /// Whether every rehearsal passed.
    pub fn is_fine(&self) -> bool {
        self.failed == 0
    }

    /// All totals in one line.
    pub fn line(&self) -> String {
        format!(
            "{} of {} pass; {} contacts in {} cases; {} brakes ({} false) in {} cases; worst tracking {:.1} mm (case {}); \
             {:.0} min of shows",
            self.cases - self.failed,
            self.cases,
            self.contacts,
            self.touched,
            self.brakes,
            self.false_brakes,
            self.braked,
            self.worst.0 * 1e3,
            self.worst.1,
            self.show_s / 60.0,
        )
    }
}

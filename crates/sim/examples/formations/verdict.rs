//! Requirements on a rehearsal of a formation.

use lightbots_sim::{Conditions, RehearsalOptions, RehearsalReport, rehearse};

use super::case::Case;

/// The largest tracking error of a rehearsal without noise, metres.
pub const IDEAL_TRACKING_MAX_M: f64 = 0.003;

/// What a rehearsal must achieve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Required {
    /// It is played to the end without a contact.
    Untouched,
    /// It is [`Self::Untouched`], without a brake and without a large tracking error.
    Exact,
}

/// Rehearses a case.
pub fn rehearsed(case: &Case, conditions: &Conditions, seed: u64) -> RehearsalReport {
    rehearse(
        &case.show(),
        &RehearsalOptions { seed, conditions: conditions.clone(), robots: None },
        &mut |_| {},
    )
}

/// Whether a rehearsal meets the requirement.
pub fn passes(report: &RehearsalReport, required: Required) -> bool {
    let exact = report.brakes.all == 0 && report.tracking_error_m.max <= IDEAL_TRACKING_MAX_M;
    report.ok && report.contacts == 0 && (required == Required::Untouched || exact)
}

/// The figures of a rehearsal in one line, with its first error.
pub fn line(report: &RehearsalReport) -> String {
    let error = report.issues.iter().find(|issue| issue.is_error());
    format!(
        "contacts {}, brakes {} ({} false), tracking {:.1} mm, closest {:.1} mm, {:.1} s{}{}",
        report.contacts,
        report.brakes.all,
        report.brakes.unfounded,
        report.tracking_error_m.max * 1e3,
        report.closest_m.unwrap_or(f64::NAN) * 1e3,
        report.duration_s,
        if report.ok { "" } else { ", not played as planned" },
        error.map_or(String::new(), |error| format!(": {}", error.message)),
    )
}

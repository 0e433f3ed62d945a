//! Checks the fields `brakes=` and `near=` in all reports of the exam: R53.

use super::pilot::Pilot;
use crate::received::Received;

/// Largest plausible gap in `near=`, metres. No proximity sensor of a small robot reads farther, so a larger number is
/// in another unit.
const SIGHT_M: f64 = 1.0;

/// Records whether all reports of the exam keep R53. Does nothing for a robot that reports only name and place.
pub(super) fn judge(pilot: &Pilot) {
    if !pilot.has_details {
        return;
    }
    let wrong = pilot.session.since(0, first_wrong);
    let came = wrong.clone().unwrap_or_else(|| "nothing else".into());
    let expected = "brakes= a whole number that never falls, near= a gap in metres";
    pilot.session.record(53, wrong.is_none(), "all of the above", expected, came);
}

/// Text of the first report whose `brakes=` or `near=` breaks R53; `None` if there is none.
fn first_wrong(received: &[Received]) -> Option<String> {
    let mut most = 0;
    let breaks = |report: &&Received| {
        let brakes = report.field("brakes").map_or(Some(0), |value| value.parse::<u32>().ok());
        let falls = brakes.is_none_or(|brakes| brakes < most);
        most = brakes.unwrap_or(most);
        let near = report.field("near").map(|value| value.parse::<f64>().unwrap_or(f64::NAN));
        falls || near.is_some_and(|near_m| !(0.0..=SIGHT_M).contains(&near_m))
    };
    let mut reports = received.iter().filter(|received| received.report.is_some());
    reports.find(breaks).map(|report| report.text.clone())
}

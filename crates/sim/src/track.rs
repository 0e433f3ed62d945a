//! The effective track of an Elisa-3: the distance of two ideal wheels that would turn the body as quickly. It says how
//! quickly the body turns at given wheel rates.

/// Radius of a wheel, metres.
pub(crate) const WHEEL_RADIUS_M: f64 = 0.0045;

/// Each row has three values. First: half the difference of the wheel rates, rad/s. Second: effective track when
/// turning on the spot, metres. Third: increase of the track at a mean wheel rate of [`DRIVING_RADPS`] or more, metres.
/// Between rows the values are linear, outside constant. From turning rates measured in Webots R2023b on 2026-11-21:
/// see docs/simulator.md.
const MEASURED: [(f64, f64, f64); 6] = [
    (1.0, 0.0400, 0.0),
    (5.0, 0.040_036, 0.000_54),
    (10.0, 0.039_25, 0.001_474),
    (20.0, 0.040_178, 0.000_61),
    (40.0, 0.040_77, 0.0006),
    (60.0, 0.041_38, 0.0006),
];

/// Mean wheel rate from which on the track increases no further, rad/s. Below, the increase is proportional to the mean
/// rate.
const DRIVING_RADPS: f64 = 50.0;

/// Number of rows of the look-up table, one for each whole rad/s of half the difference of wheel rates, from 0. The
/// motors cannot differ by more.
const ROWS: usize = 142;

/// `[half the difference of wheel rates, rad/s]`: effective track on the spot, and its increase in a drive, metres.
static ROWS_BY_RATE: [(f64, f64); ROWS] = rows_by_rate();

/// Turning rate of the body at constant wheel rates (left and right, rad/s): rad/s, counter-clockwise.
#[inline]
pub(crate) fn turn_radps(left: f64, right: f64) -> f64 {
    let half = 0.5 * (right - left);
    if half == 0.0 {
        return 0.0;
    }
    let rate = half.abs().min((ROWS - 2) as f64);
    // 32 bits, because the processor has an instruction for that conversion.
    let row = rate as i32;
    let share = rate - f64::from(row);
    let (low, high) = (ROWS_BY_RATE[row as usize], ROWS_BY_RATE[row as usize + 1]);
    let driving = (0.5 * (left + right).abs() * (1.0 / DRIVING_RADPS)).min(1.0);
    let track = low.0 + (high.0 - low.0) * share + (low.1 + (high.1 - low.1) * share) * driving;
    2.0 * WHEEL_RADIUS_M * half / track
}

const fn rows_by_rate() -> [(f64, f64); ROWS] {
    let mut rows = [(0.0, 0.0); ROWS];
    let mut rate = 0;
    while rate < ROWS {
        rows[rate] = interpolate(rate as f64);
        rate += 1;
    }
    rows
}

const fn interpolate(rate: f64) -> (f64, f64) {
    let mut before = MEASURED[0];
    let mut next = 0;
    while next < MEASURED.len() {
        let row = MEASURED[next];
        if rate <= row.0 {
            let span = row.0 - before.0;
            let share = if span > 0.0 { (rate - before.0) / span } else { 0.0 };
            return (before.1 + (row.1 - before.1) * share, before.2 + (row.2 - before.2) * share);
        }
        before = row;
        next += 1;
    }
    (before.1, before.2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wheels (rad/s) and turning rate (rad/s) as measured in Webots.
    const TABLE: [(f64, f64, f64); 9] = [
        (-5.0, 5.0, 1.124),
        (-10.0, 10.0, 2.293),
        (-20.0, 20.0, 4.48),
        (-40.0, 40.0, 8.83),
        (-60.0, 60.0, 13.05),
        (0.0, 40.0, 4.453),
        (40.0, 60.0, 2.210),
        (50.0, 60.0, 1.109),
        (58.0, 60.0, 0.225),
    ];

    #[test]
    fn every_measured_rate_is_met_and_mirrored() {
        for (left, right, turn) in TABLE {
            let ours = turn_radps(left, right);
            assert!((ours / turn - 1.0).abs() < 0.003, "{left}/{right}: {ours} for {turn}");
            assert_eq!(turn_radps(right, left), -ours);
            assert_eq!(turn_radps(-left, -right), -ours);
        }
    }

    #[test]
    fn equal_wheels_do_not_turn_and_wild_ones_stay_finite() {
        assert_eq!(turn_radps(60.0, 60.0), 0.0);
        assert!(turn_radps(-140.0, 140.0).is_finite());
        assert!(turn_radps(-1e9, 1e9).is_finite());
    }
}

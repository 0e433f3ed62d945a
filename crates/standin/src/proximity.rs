//! The values and the noise of the proximity sensors in `webots/protos/LightBot.proto`.

/// Number of sensors, one ray each, at equal angles (stated in `webots/protos/LightBot.proto`).
pub const RAYS: usize = 10;
/// Look-up table of a sensor. Each row: distance in metres, value, noise as a share of the value. Sorted by distance
/// (stated in `webots/protos/LightBot.proto`).
pub const TABLE: [[f64; 3]; 5] = [
    [0.0, 1000.0, 0.0075],
    [0.013, 675.0, 0.03],
    [0.023, 425.0, 0.076],
    [0.033, 175.0, 0.26],
    [0.04, 0.0, 0.0],
];

/// Sensor value at a distance in metres: linear between the rows of [`TABLE`]. Below the first row and beyond the last
/// one, the value of that row.
pub(crate) fn value(distance_m: f64) -> f64 {
    between(distance_m, 1)
}

/// Noise of the distance that a sensor shows, metres, 1 sigma: the noise of the value, divided by the mean slope of
/// [`TABLE`]. `distance_m`: the true distance.
#[must_use]
pub fn sigma_m(distance_m: f64) -> f64 {
    let per_m = (TABLE[0][1] - TABLE[4][1]) / TABLE[4][0];
    between(distance_m, 1) * between(distance_m, 2) / per_m
}

/// Returns the value of a column of [`TABLE`] at a distance in metres, linear between the rows.
fn between(distance_m: f64, column: usize) -> f64 {
    let pair = TABLE.windows(2).find(|pair| distance_m < pair[1][0]);
    pair.map_or(TABLE[TABLE.len() - 1][column], |pair| {
        let share = ((distance_m - pair[0][0]) / (pair[1][0] - pair[0][0])).max(0.0);
        pair[0][column] + (pair[1][column] - pair[0][column]) * share
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_fall_with_the_distance() {
        assert_eq!(
            [value(-0.001), value(0.0), value(0.013), value(0.04), value(f64::INFINITY)],
            [1000.0, 1000.0, 675.0, 0.0, 0.0]
        );
        assert!((value(0.018) - 550.0).abs() < 1e-9);
        // 10 mm from rim to rim: 3 % of 675 in units of 40 micrometres.
        assert!((sigma_m(0.013) - 0.000_81).abs() < 1e-9 && sigma_m(1.0) == 0.0);
    }
}

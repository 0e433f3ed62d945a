//! How a robot brakes: the one model that robot, planner and simulator share.
//!
//! The proof reads [`REACTION_S`] and [`GRIP_MPS2`] and keeps a formula of its own.

/// Time from the moment a robot stops dead until the robot behind it has detected that: three steps of 16 ms. Within
/// this time, 97 of 100 robots detect the death of the robot ahead and do not touch it (`reflex/death_tests.rs`,
/// measured on 2026-11-24). With a shorter time, the planner relies on one noisy reading. With a longer one, robots
/// that follow each other are planned farther apart than necessary.
pub const DETECTION_S: f64 = 0.048;
/// Time from a command to the wheels until the wheels obey: one step of the Elisa-3's motors, measured in Webots R2023b
/// on 2026-11-21.
pub const ACTUATION_S: f64 = 0.016;
/// Time from the moment a robot stops dead until the wheels of the robot behind it begin to brake.
pub const REACTION_S: f64 = DETECTION_S + ACTUATION_S;
/// Greatest deceleration that the tyres' grip allows, m/s²: the Elisa-3 loses 0.188 m/s in a step of 16 ms, measured in
/// Webots R2023b on 2026-11-21. With a larger value, robots are expected to stop sooner.
pub const GRIP_MPS2: f64 = 11.75;

/// Distance in metres that a robot at `speed_mps` drives while its wheels brake at the grip limit. This is an upper
/// bound: an Elisa-3 at 0.27 m/s needs 1.3 mm instead of 3.1 mm. The reason is that its speed falls at the beginning of
/// a step.
pub const fn braking_m(speed_mps: f64) -> f64 {
    speed_mps * speed_mps / (2.0 * GRIP_MPS2)
}

/// Distance in metres that a robot at `speed_mps` drives from the moment something ahead of it stops dead until it
/// stands. It drives on for [`REACTION_S`], then brakes. The sign of the speed does not matter.
pub const fn stopping_m(speed_mps: f64) -> f64 {
    speed_mps.abs() * REACTION_S + braking_m(speed_mps)
}

/// The highest speed in m/s from which a robot stands within `distance_m` if its wheels begin to brake after
/// `delay_s`. This is the inverse of `speed · delay_s + braking_m(speed)`. Zero if `distance_m` is not positive or NaN.
pub fn speed_within_mps(distance_m: f64, delay_s: f64) -> f64 {
    if distance_m.is_nan() || distance_m <= 0.0 {
        return 0.0;
    }
    // The positive root of v²/(2g) + v·delay − distance, written without cancellation.
    let half = GRIP_MPS2 * delay_s;
    2.0 * GRIP_MPS2 * distance_m / (half + libm::sqrt(half * half + 2.0 * GRIP_MPS2 * distance_m))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_elisa_3_stands_after_20_mm_at_full_speed() {
        assert!((stopping_m(0.27) - 0.0204).abs() < 1e-4);
        assert_eq!(stopping_m(-0.27), stopping_m(0.27));
        assert_eq!(stopping_m(0.0), 0.0);
    }

    #[test]
    fn the_speed_within_a_distance_stops_within_it() {
        for distance_m in [1e-6, 0.001, 0.005, 0.02, 0.3] {
            for delay_s in [0.0, ACTUATION_S, REACTION_S] {
                let speed_mps = speed_within_mps(distance_m, delay_s);
                let used_m = speed_mps * delay_s + braking_m(speed_mps);
                assert!((used_m - distance_m).abs() < 1e-12, "{distance_m} {delay_s}: {used_m}");
            }
        }
        assert_eq!(speed_within_mps(0.0, 0.016), 0.0);
        assert_eq!(speed_within_mps(-1.0, 0.016), 0.0);
        assert_eq!(speed_within_mps(f64::NAN, 0.016), 0.0);
    }
}

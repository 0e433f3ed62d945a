//! Angles in radians, counter-clockwise.

use core::f64::consts::{PI, TAU};

/// Normalises an angle to (−π, π]. NaN and infinities give NaN.
pub fn wrap(angle: f64) -> f64 {
    if angle > -PI && angle <= PI {
        return angle;
    }
    let turned = libm::fmod(angle, TAU);
    if turned > PI {
        turned - TAU
    } else if turned <= -PI {
        turned + TAU
    } else {
        turned
    }
}

/// The shortest turn from the angle `from` to the angle `to`, in (−π, π]; positive is counter-clockwise.
pub fn difference(to: f64, from: f64) -> f64 {
    wrap(to - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrapping_keeps_the_direction() {
        assert_eq!(wrap(0.5), 0.5);
        assert!((wrap(3.0 * PI) - PI).abs() < 1e-12);
        assert!((wrap(-1.5 * PI) - 0.5 * PI).abs() < 1e-12);
        assert!(wrap(f64::NAN).is_nan());
    }

    #[test]
    fn the_shortest_turn_crosses_the_back() {
        assert!((difference(-3.0, 3.0) - (TAU - 6.0)).abs() < 1e-12);
    }
}

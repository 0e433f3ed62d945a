//! Bernstein coefficients of a span's squared speed and of its turn. Within the span, a polynomial stays between its
//! least and its greatest coefficient. The unit of time is the duration of the span. A span is given by the three steps
//! from each of its control points to the next.

use lightbots_base::Vec2;

/// Bernstein coefficients of a span's squared speed, degree 4.
pub(crate) fn squares(steps: &[Vec2; 3]) -> [f64; 5] {
    let [first, middle, last] = [(steps[0] + steps[1]) * 0.5, steps[1], (steps[1] + steps[2]) * 0.5];
    let inner = (first.dot(last) + 2.0 * middle.length_squared()) / 3.0;
    [first.length_squared(), first.dot(middle), inner, middle.dot(last), last.length_squared()]
}

/// Bernstein coefficients of the cross product of a span's velocity and acceleration, raised to degree 4.
pub(crate) fn crosses(steps: &[Vec2; 3]) -> [f64; 5] {
    let (first, last) = (steps[0].cross(steps[1]), steps[1].cross(steps[2]));
    let middle = (first + steps[0].cross(steps[2]) + last) / 4.0;
    [first, (first + middle) / 2.0, (first + 4.0 * middle + last) / 6.0, (middle + last) / 2.0, last]
}

/// Bernstein coefficients of the first and the second half of a polynomial (de Casteljau).
pub(crate) fn halves(mut whole: [f64; 5]) -> [[f64; 5]; 2] {
    let (mut before, mut after) = (whole, whole);
    for round in 1..5 {
        for i in 0..5 - round {
            whole[i] = (whole[i] + whole[i + 1]) / 2.0;
        }
        (before[round], after[4 - round]) = (whole[0], whole[4 - round]);
    }
    [before, after]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(coefficients: &[f64; 5], u: f64) -> f64 {
        let w = 1.0 - u;
        let weights = [w.powi(4), 4.0 * w.powi(3) * u, 6.0 * w * w * u * u, 4.0 * w * u.powi(3), u.powi(4)];
        coefficients.iter().zip(weights).map(|(coefficient, weight)| coefficient * weight).sum()
    }

    #[test]
    fn coefficients_are_those_of_velocity_and_its_halves() {
        let steps = [Vec2::new(0.3, -0.1), Vec2::new(0.2, 0.4), Vec2::new(-0.5, 0.15)];
        let ends = [(steps[0] + steps[1]) * 0.5, steps[1], (steps[1] + steps[2]) * 0.5];
        let (squares, crosses) = (squares(&steps), crosses(&steps));
        let halves = halves(squares);
        for u in (0..=10).map(|tenth| f64::from(tenth) / 10.0) {
            let w = 1.0 - u;
            let velocity = ends[0] * (w * w) + ends[1] * (2.0 * w * u) + ends[2] * (u * u);
            let acceleration = ((ends[1] - ends[0]) * w + (ends[2] - ends[1]) * u) * 2.0;
            assert!((value(&squares, u) - velocity.length_squared()).abs() < 1e-12);
            assert!((value(&crosses, u) - velocity.cross(acceleration)).abs() < 1e-12);
            let half = if u <= 0.5 { value(&halves[0], 2.0 * u) } else { value(&halves[1], 2.0 * u - 1.0) };
            assert!((value(&squares, u) - half).abs() < 1e-12);
        }
    }
}

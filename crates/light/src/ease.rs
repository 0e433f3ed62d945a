//! Shapes of a value over time: easing, wrapping of a phase, opacity curves.

use crate::colour::within_one;
use core::f64::consts::PI;

/// Easing: a curve that maps a value u between 0 and 1 to another one. Each curve rises from 0 to 1 and never falls.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ease {
    /// u.
    #[default]
    Linear,
    /// u²(3 − 2u): slow at both ends.
    Smooth,
    /// (1 − cos πu)/2: slow at both ends.
    Sine,
    /// u²: slow at 0.
    In,
    /// 1 − (1 − u)²: slow at 1.
    Out,
}

impl Ease {
    /// Returns the curve's value at `u`, 0 to 1. Values of `u` outside of 0..=1 are clamped first.
    pub fn at(self, u: f64) -> f64 {
        let u = within_one(u);
        match self {
            Self::Linear => u,
            Self::Smooth => u * u * (3.0 - 2.0 * u),
            Self::Sine => (1.0 - libm::cos(PI * u)) / 2.0,
            Self::In => u * u,
            Self::Out => 1.0 - (1.0 - u) * (1.0 - u),
        }
    }
}

/// How a phase of any size becomes a value between 0 and 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// Clamped: phases below 0 become 0, phases above 1 become 1.
    #[default]
    Once,
    /// The phase minus the next lower whole number: runs from 0 to 1 in each cycle, then jumps back to 0.
    Loop,
    /// From 0 to 1 while the phase rises by 1, then back to 0 over the next 1: never jumps.
    Mirror,
}

impl Wrap {
    /// The wrapped phase.
    pub fn at(self, phase: f64) -> f64 {
        match self {
            Self::Once => within_one(phase),
            Self::Loop => fraction(phase),
            Self::Mirror => 1.0 - (2.0 * fraction(phase / 2.0) - 1.0).abs(),
        }
    }
}

/// A number minus the next lower whole number: 0 (included) to 1 (excluded), also for negative numbers.
pub(crate) fn fraction(number: f64) -> f64 {
    number - libm::floor(number)
}

/// Opacity of a layer over time, interpolated linearly between points. It is constant before the first point and after
/// the last.
#[derive(Clone, Debug, PartialEq)]
pub struct OpacityCurve {
    /// Moments, in seconds of the effect's own time, and the opacities at them, 0 to 1. Sorted by moment, not empty. At
    /// two points with one moment, the opacity jumps from the first to the second.
    pub points: Vec<(f64, f64)>,
}

impl OpacityCurve {
    /// The same opacity at all times.
    pub fn constant(opacity: f64) -> Self {
        Self { points: vec![(0.0, opacity)] }
    }

    /// Opacity at `tau_s`, seconds of the effect's own time; 1 without points.
    pub fn at(&self, tau_s: f64) -> f64 {
        let after = self.points.partition_point(|&(moment, _)| moment <= tau_s);
        let before = after.checked_sub(1).map(|index| self.points[index]);
        match (before, self.points.get(after)) {
            (Some((start_s, start)), Some(&(end_s, end))) => {
                start + (end - start) * (tau_s - start_s) / (end_s - start_s)
            }
            (Some((_, value)), None) | (None, Some(&(_, value))) => value,
            (None, None) => 1.0,
        }
    }
}

impl Default for OpacityCurve {
    fn default() -> Self {
        Self::constant(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn easing_meets_both_ends_and_never_turns_back() {
        for ease in [Ease::Linear, Ease::Smooth, Ease::Sine, Ease::In, Ease::Out] {
            assert_eq!((ease.at(0.0), ease.at(1.0), ease.at(f64::NAN)), (0.0, 1.0, 0.0), "{ease:?}");
            for step in 0..1000 {
                let u = f64::from(step) / 1000.0;
                assert!(ease.at(u + 0.001) >= ease.at(u), "{ease:?} at {u}");
            }
        }
    }

    #[test]
    fn a_phase_wraps_below_zero_too() {
        assert_eq!([-0.25, 0.25, 1.25].map(|phase| Wrap::Once.at(phase)), [0.0, 0.25, 1.0]);
        assert_eq!([-0.25, 0.25, 1.25].map(|phase| Wrap::Loop.at(phase)), [0.75, 0.25, 0.25]);
        assert_eq!([-0.25, 0.25, 1.25, 2.5].map(|phase| Wrap::Mirror.at(phase)), [0.25, 0.25, 0.75, 0.5]);
    }

    #[test]
    fn a_curve_holds_its_ends_and_may_jump() {
        let curve = OpacityCurve { points: vec![(1.0, 0.0), (2.0, 1.0), (2.0, 0.5), (4.0, 0.0)] };
        assert_eq!([0.0, 1.5, 2.0, 3.0, 9.0].map(|tau| curve.at(tau)), [0.0, 0.5, 0.5, 0.25, 0.0]);
    }
}

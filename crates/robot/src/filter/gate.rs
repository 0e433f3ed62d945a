//! Outlier gate: a fix far from the prediction is rejected as an outlier. Once [`OUTLIERS`] outliers agree with each
//! other, the estimate jumps to them.

use lightbots_base::{Instant, Span, Vec2, wrap};

/// Largest innovation of an inlier, in standard deviations of the innovation; below [`GATE_FLOOR_M`] and
/// [`GATE_FLOOR_RAD`] every fix is an inlier. With a smaller value, good fixes of a robot that was pushed are rejected.
/// With a larger value, outliers near the robot pull it off its place.
const GATE: f64 = 5.0;
/// A position fix whose innovation is less than this is an inlier whatever the covariance says, metres: three sigma of
/// the default noise.
const GATE_FLOOR_M: f64 = 0.006;
/// A heading fix whose innovation is less than this is an inlier whatever the covariance says, radians.
const GATE_FLOOR_RAD: f64 = 0.1;
/// Number of agreeing outliers at which the estimate jumps to them: 0.16 s of fixes at the default pace. With a smaller
/// value, a burst of reflections moves the estimate. With a larger value, a robot that was carried away stands still
/// for longer.
const OUTLIERS: u8 = 10;
/// Two jumps of the place within this time are a fault, because no push moves a robot twice so quickly.
const JUMPS_APART: Span = Span::from_millis(1000);

/// How the filter uses a fix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum GateResult {
    /// The fix is rejected.
    Outlier,
    /// The innovation of the fix corrects the filter.
    Inlier,
    /// The fix replaces the estimate.
    Jump,
}

/// Recent outliers, and the times of the last inliers.
#[derive(Debug, Default)]
pub(super) struct OutlierGate {
    /// Innovation of the latest position fix among the agreeing outliers, metres. The next outlier agrees if its
    /// innovation is close to this one.
    odd_off: Vec2,
    last_jump: Option<Instant>,
    /// When the last position fix arrived that was no outlier; `None` if there was none.
    last_place: Option<Instant>,
    /// When the last heading fix arrived that was no outlier; `None` if there was none.
    last_heading: Option<Instant>,
    odd_places: u8,
    /// Innovation of the latest heading fix among the agreeing outliers, radians.
    odd_turn: f64,
    odd_headings: u8,
    /// Whether two jumps came within [`JUMPS_APART`].
    senseless: bool,
    /// Sum of the jumps of the place since [`take_jump_m`](Self::take_jump_m) was last called, metres.
    jump_m: f64,
}

impl OutlierGate {
    /// Tests the innovation `off` of a position fix, metres, against the variances of the estimate (`believed`) and of
    /// the fix (`noise`), square metres. The first fix is always a jump.
    #[inline]
    pub(super) fn place(&mut self, now: Instant, off: Vec2, believed: f64, noise: f64) -> GateResult {
        let square = off.length_squared();
        let odd = square > GATE * GATE * (believed + noise) && square > GATE_FLOOR_M * GATE_FLOOR_M;
        let first = self.last_place.is_none();
        if odd && !first {
            let agrees = (off - self.odd_off).length_squared() < GATE * GATE * 2.0 * noise;
            if count_outlier(&mut self.odd_places, agrees) {
                self.odd_off = off;
            }
            if self.odd_places < OUTLIERS {
                return GateResult::Outlier;
            }
            self.senseless = self.last_jump.is_some_and(|jump| now - jump < JUMPS_APART);
            self.last_jump = Some(now);
            self.jump_m += off.length();
        }
        self.odd_places = 0;
        self.last_place = Some(now);
        if odd || first { GateResult::Jump } else { GateResult::Inlier }
    }

    /// Tests the innovation `off` of a heading fix, radians, against the variances of the estimate (`believed`) and of
    /// the fix (`noise`). With `first`, the fix is always a jump.
    #[inline]
    pub(super) fn heading(
        &mut self,
        now: Instant,
        off: f64,
        believed: f64,
        noise: f64,
        first: bool,
    ) -> GateResult {
        let square = off * off;
        let odd = square > GATE * GATE * (believed + noise) && square > GATE_FLOOR_RAD * GATE_FLOOR_RAD;
        if odd && !first {
            let apart = wrap(off - self.odd_turn);
            let agrees = apart * apart < (GATE * GATE * 2.0 * noise).max(GATE_FLOOR_RAD * GATE_FLOOR_RAD);
            if count_outlier(&mut self.odd_headings, agrees) {
                self.odd_turn = off;
            }
            if self.odd_headings < OUTLIERS {
                return GateResult::Outlier;
            }
        }
        self.odd_headings = 0;
        self.last_heading = Some(now);
        if odd || first { GateResult::Jump } else { GateResult::Inlier }
    }

    /// When the last position fix arrived that was no outlier; `None` if there was none.
    pub(super) fn last_place(&self) -> Option<Instant> {
        self.last_place
    }

    /// When the last heading fix arrived that was no outlier; `None` if there was none.
    pub(super) fn last_heading(&self) -> Option<Instant> {
        self.last_heading
    }

    /// Returns the sum of the jumps of the place since the last call, metres; 0 if there was none.
    pub(super) fn take_jump_m(&mut self) -> f64 {
        core::mem::take(&mut self.jump_m)
    }

    /// Returns whether two jumps of the place came within [`JUMPS_APART`]. The call clears the flag.
    pub(super) fn take_senseless(&mut self) -> bool {
        core::mem::take(&mut self.senseless)
    }
}

/// Counts an outlier: one that agrees with the outliers before raises the count by one, any other lowers it by one. The
/// count stays at least 1. Returns whether later outliers are to be compared with this one.
#[inline]
fn count_outlier(counted: &mut u8, agrees: bool) -> bool {
    *counted = if agrees { *counted + 1 } else { counted.saturating_sub(1) };
    let is_newest = agrees || *counted == 0;
    *counted = (*counted).max(1);
    is_newest
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f64::consts::PI;

    /// Variance of a fix: square metres for the place, radians squared for the heading.
    const NOISE: f64 = 1e-6;

    #[test]
    fn ten_outliers_in_a_row_that_agree_replace_the_estimate() {
        let mut gate = OutlierGate::default();
        let mut place = |ms: u64, x: f64| gate.place(Instant(ms * 1000), Vec2::new(x, 0.0), 0.0, NOISE);
        assert_eq!(place(0, 3.0), GateResult::Jump);
        assert_eq!(place(1, 0.004), GateResult::Inlier);
        assert!((2..11).all(|ms| place(ms, 0.5) == GateResult::Outlier));
        assert_eq!(place(11, 0.5), GateResult::Jump);
        assert_eq!(place(12, 0.004), GateResult::Inlier);
        assert!(!gate.take_senseless());
        let again = |ms: u64| gate.place(Instant(ms * 1000), Vec2::new(0.5, 0.0), 0.0, NOISE);
        assert_eq!((20..30).map(again).last(), Some(GateResult::Jump));
        assert!(gate.take_senseless() && !gate.take_senseless());
    }

    #[test]
    fn headings_are_gated_likewise() {
        let mut gate = OutlierGate::default();
        assert_eq!(gate.heading(Instant(1), 2.0, 0.0, NOISE, true), GateResult::Jump);
        let mut heading = |us: u64, off: f64| gate.heading(Instant(us), off, 0.0, NOISE, false);
        assert_eq!(heading(2, 0.05), GateResult::Inlier);
        assert_eq!(heading(3, 0.2), GateResult::Outlier);
        let last = (0..9).map(|n| heading(4 + n, 0.2)).last();
        assert_eq!(last, Some(GateResult::Jump));
        heading(20, 0.2);
        assert_eq!(gate.last_heading(), Some(Instant(12)));
    }

    #[test]
    fn headings_that_disagree_do_not_replace_the_estimate() {
        let mut gate = OutlierGate::default();
        gate.heading(Instant(1), 0.0, 0.0, NOISE, true);
        let mut heading = |us: u64, off: f64| gate.heading(Instant(us), off, 0.0, NOISE, false);
        // Each is half a radian and more from the one before it.
        let scattered = |n: u64| 0.5 + (n as f64 * 2.4) % 5.2;
        assert!((2..100).all(|us| heading(us, scattered(us)) == GateResult::Outlier));
        let agreeing = (100..120).map(|us| heading(us, if us % 2 == 0 { -PI } else { PI - 0.01 }));
        assert!(agreeing.take(11).any(|result| result == GateResult::Jump), "they agree over the turn");
    }
}

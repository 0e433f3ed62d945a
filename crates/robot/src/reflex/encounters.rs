//! What a robot reports of its meetings with others (R53): how often it braked, and how near another rim came.

use lightbots_base::{Instant, Span};

/// A brake after at least this time without one is counted anew. Below, one brake of a noisy sensor counts several times.
/// Above, brakes for different robots count as one. Rehearsals count with the same 10 steps of 16 ms.
const FREE: Span = Span::from_millis(160);

/// Brakes and the least gap until now.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Encounters {
    brakes: u32,
    /// When it braked last.
    braked: Option<Instant>,
    /// On the route under way, else on the route finished last, metres.
    near_m: Option<f32>,
}

impl Encounters {
    /// Brakes since power-on.
    pub fn brakes(&self) -> u32 {
        self.brakes
    }

    /// Least gap between rims on the latest route, metres, to a tenth of a millimetre.
    pub fn near_m(&self) -> Option<f64> {
        self.near_m.map(|gap_m| libm::round(f64::from(gap_m) * 1e4) / 1e4)
    }

    /// A new route begins.
    pub fn begin_route(&mut self) {
        self.near_m = None;
    }

    /// The safety layer slows the robot in the step at `now`.
    pub fn brakes_at(&mut self, now: Instant) {
        if self.braked.is_none_or(|braked| now - braked > FREE) {
            self.brakes = self.brakes.saturating_add(1);
        }
        self.braked = Some(now);
    }

    /// A neighbour is seen with this gap between the rims, metres.
    pub fn see(&mut self, gap_m: f32) {
        if gap_m.is_finite() {
            let gap_m = gap_m.max(0.0);
            self.near_m = Some(self.near_m.map_or(gap_m, |least_m| least_m.min(gap_m)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_brake_is_counted_anew_after_ten_free_steps() {
        let mut encounters = Encounters::default();
        for step in [1, 2, 3, 13, 24, 25] {
            encounters.brakes_at(Instant(step * 16_000));
        }
        // Nine free steps between 3 and 13 are too few, ten between 13 and 24 are enough.
        assert_eq!(encounters.brakes(), 2);
    }

    #[test]
    fn the_least_gap_of_the_latest_route_is_kept() {
        let mut encounters = Encounters::default();
        assert_eq!(encounters.near_m(), None);
        for gap_m in [0.0201, 0.012_34, f32::NAN, 0.03] {
            encounters.see(gap_m);
        }
        assert_eq!(encounters.near_m(), Some(0.0123));
        encounters.see(-0.001);
        assert_eq!(encounters.near_m(), Some(0.0));
        encounters.begin_route();
        assert_eq!(encounters.near_m(), None);
    }
}

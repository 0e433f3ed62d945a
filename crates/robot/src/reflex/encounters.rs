//! Statistics of encounters with other robots for reports (R53 of docs/protocol.md): how often the safety layer braked
//! the robot, and the least gap to another rim.

use lightbots_base::{Instant, Span};

/// Time without braking after which braking counts as a new brake: ten steps of 16 ms. With a smaller value, braking by
/// a noisy sensor counts several times. With a larger value, brakes for different robots count as one.
const FREE: Span = Span::from_millis(160);

/// Number of brakes, and least gap to another rim.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Encounters {
    brakes: u32,
    /// When the safety layer last braked the robot, own clock.
    braked: Option<Instant>,
    /// Least estimated gap since the latest route began, metres; `None` if no neighbour was seen since.
    near_m: Option<f32>,
}

impl Encounters {
    /// Number of brakes since power-on.
    pub fn brakes(&self) -> u32 {
        self.brakes
    }

    /// Least gap between rims since the latest route began, metres, rounded to 0.1 mm; `None` if no neighbour was seen.
    pub fn near_m(&self) -> Option<f64> {
        self.near_m.map(|gap_m| libm::round(f64::from(gap_m) * 1e4) / 1e4)
    }

    /// Resets the least gap, because a new route begins.
    pub fn begin_route(&mut self) {
        self.near_m = None;
    }

    /// Notes that the safety layer slows the robot in the step at `now`.
    pub fn brakes_at(&mut self, now: Instant) {
        if self.braked.is_none_or(|braked| now - braked > FREE) {
            self.brakes = self.brakes.saturating_add(1);
        }
        self.braked = Some(now);
    }

    /// Notes the gap between the rims of the robot and a neighbour that it sees, metres.
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

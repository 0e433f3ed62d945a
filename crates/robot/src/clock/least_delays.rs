//! The least delays of both directions of a link, which bound the offset of the show clock.
//!
//! No message arrives before it was sent. So each question bounds the offset from above, and each answer bounds it from
//! below. The quickest question and the quickest answer need not belong to the same round trip. Over a link with much
//! jitter, their sum is less than any single round trip. If the link is equally quick in both directions, the middle
//! between both bounds is the offset.

use lightbots_base::{Instant, Span};

/// Number of least delays that are kept for each direction. The gap between them estimates by how much the least delay
/// exceeds the shortest possible one. With 2, this estimate is poor. With more than 3, the gap depends on the slower
/// messages of the link.
const KEPT: usize = 3;

/// The least delays of messages in one direction, ascending, microseconds. The offset is added to those of questions
/// and subtracted from those of answers.
#[derive(Clone, Copy, Debug)]
struct Direction {
    delays_us: [f64; KEPT],
    /// When the answer with the least delay of this direction was handled, own clock.
    least_at: Instant,
}

impl Direction {
    const NONE: Self = Self { delays_us: [f64::INFINITY; KEPT], least_at: Instant::ZERO };

    fn take(&mut self, now: Instant, delay_us: f64) {
        if delay_us < self.delays_us[0] {
            self.least_at = now;
        }
        let after = self.delays_us.partition_point(|kept| *kept <= delay_us);
        if after < KEPT {
            self.delays_us[after..].rotate_right(1);
            self.delays_us[after] = delay_us;
        }
    }

    fn least_us(&self) -> f64 {
        self.delays_us[0]
    }

    /// Estimate of how much the least delay exceeds the shortest possible delay, microseconds. Infinite until [`KEPT`]
    /// delays are known.
    fn gap_us(&self) -> f64 {
        self.delays_us[KEPT - 1] - self.delays_us[0]
    }
}

/// Estimate of the offset by the least delays: the middle of its bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Middle {
    /// The offset, microseconds.
    pub offset_us: f64,
    /// Variance of the offset, microseconds squared; infinite until enough delays are known.
    pub variance: f64,
}

/// See the [module documentation](self).
#[derive(Clone, Copy, Debug)]
pub(super) struct LeastDelays {
    there: Direction,
    back: Direction,
}

impl LeastDelays {
    pub const NONE: Self = Self { there: Direction::NONE, back: Direction::NONE };

    /// Adapts the delays to a predicted change of the offset by `change_us`, microseconds. The bounds widen by
    /// `error_us` on each side, the error of the prediction.
    pub fn age(&mut self, change_us: f64, error_us: f64) {
        self.there.delays_us.iter_mut().for_each(|delay_us| *delay_us += error_us + change_us);
        self.back.delays_us.iter_mut().for_each(|delay_us| *delay_us += error_us - change_us);
    }

    /// Adds the delays of a round trip whose answer arrived at `now`. `there_us`: delay of the question plus the
    /// offset; `back_us`: delay of the answer minus the offset; both microseconds.
    pub fn take(&mut self, now: Instant, there_us: f64, back_us: f64) {
        if there_us + self.back.least_us() < 0.0 || back_us + self.there.least_us() < 0.0 {
            // Earlier delays contradict this one: one of both clocks was set, or drifts more than was thought.
            *self = Self::NONE;
        }
        self.there.take(now, there_us);
        self.back.take(now, back_us);
    }

    /// Least and largest possible offset, microseconds.
    pub fn bounds_us(&self) -> [f64; 2] {
        [-self.back.least_us(), self.there.least_us()]
    }

    /// Estimates the offset at `now`, own clock, as the middle of its bounds. `answers`: number of answers until now;
    /// `drift`: standard deviation of the drift, as a share.
    pub fn middle(&self, now: Instant, answers: u32, drift: f64) -> Middle {
        let [gap_there, gap_back] = [self.there.gap_us(), self.back.gap_us()];
        let age = |direction: &Direction| (now - direction.least_at).max(Span::ZERO).0 as f64;
        let aged_us = 0.5 * drift * (age(&self.there) + age(&self.back));
        // The first few messages may all have waited in one queue, so that their delays have no gap. The width between
        // the bounds counts then.
        let width_us = self.there.least_us() + self.back.least_us();
        let unknown = width_us * width_us / (12.0 * f64::from(answers.max(1)));
        Middle {
            offset_us: 0.5 * (self.there.least_us() - self.back.least_us()),
            // The standard deviation by the gaps is 1.0 to 1.4 times the error of the middle. Found for evenly spread
            // delays and for sums of two exponential ones.
            variance: (gap_there * gap_there + gap_back * gap_back) / 12.0 + aged_us * aged_us + unknown,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quickest_of_each_direction_bound_the_offset() {
        let mut delays = LeastDelays::NONE;
        for (second, (there, back)) in
            [(9.0, 30.0), (40.0, 7.0), (20.0, 8.0), (10.0, 50.0)].into_iter().enumerate()
        {
            delays.take(Instant(second as u64 * 1_000_000), 100.0 + there, back - 100.0);
        }
        assert_eq!(delays.bounds_us(), [93.0, 109.0]);
        let middle = delays.middle(Instant(4_000_000), 4, 0.0);
        let by_gaps = (11.0 * 11.0 + 23.0 * 23.0) / 12.0;
        assert_eq!((middle.offset_us, middle.variance), (101.0, by_gaps + 16.0 * 16.0 / 48.0));
        let aged = delays.middle(Instant(4_000_000), 4, 1e-6);
        assert!((aged.variance - middle.variance - 3.5 * 3.5).abs() < 1e-9, "{aged:?}");
    }

    #[test]
    fn answers_from_one_queue_do_not_make_the_middle_sure() {
        let mut delays = LeastDelays::NONE;
        for _ in 0..4 {
            delays.take(Instant::ZERO, 2_000.0, 100_000.0);
        }
        let sigma_us = delays.middle(Instant::ZERO, 4, 0.0).variance.sqrt();
        assert!(sigma_us > 10_000.0, "{sigma_us}");
    }

    #[test]
    fn two_delays_say_nothing_yet() {
        let mut delays = LeastDelays::NONE;
        delays.take(Instant::ZERO, 5.0, 5.0);
        delays.take(Instant::ZERO, 6.0, 6.0);
        assert!(delays.middle(Instant::ZERO, 2, 0.0).variance.is_infinite());
    }

    #[test]
    fn bounds_move_with_the_drift_and_widen_by_its_error() {
        let mut delays = LeastDelays::NONE;
        delays.take(Instant::ZERO, 15.0, -5.0);
        delays.age(3.0, 2.0);
        assert_eq!(delays.bounds_us(), [6.0, 20.0]);
    }

    #[test]
    fn a_clock_that_was_set_begins_anew() {
        let mut delays = LeastDelays::NONE;
        delays.take(Instant::ZERO, 15.0, -5.0);
        delays.take(Instant::ZERO, 115.0, -105.0);
        assert_eq!(delays.bounds_us(), [105.0, 115.0]);
    }
}

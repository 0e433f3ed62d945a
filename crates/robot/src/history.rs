//! Odometry since the moment at which the latest fix was measured. A late fix corrects the pose that the robot had at
//! that moment, and odometry leads from that pose to the present.

use lightbots_base::{Instant, Span};

/// Number of steps that are remembered: 0.5 s of 16 ms each, which is more than the largest delay of a fix (0.45 s).
/// With fewer, late fixes correct the wrong pose.
const STEPS: usize = 32;

/// Turns of the left and the right wheel in a step, radians.
type Turns = [f64; 2];

/// The wheel turns of the last steps, oldest first.
#[derive(Debug)]
pub(crate) struct OdometryHistory {
    /// Ring buffer of `(end of the step, turns)`.
    steps: [(Instant, Turns); STEPS],
    oldest: usize,
    count: usize,
    /// End of the last step that was removed.
    taken: Instant,
}

impl OdometryHistory {
    pub(crate) const fn new() -> Self {
        Self { steps: [(Instant::ZERO, [0.0; 2]); STEPS], oldest: 0, count: 0, taken: Instant::ZERO }
    }

    /// Adds a step that ended at `now`. If the buffer is full, removes the oldest step and returns its turns.
    pub(crate) fn add(&mut self, now: Instant, turns: Turns) -> Option<Turns> {
        let pushed_out = if self.count == STEPS { self.take_until(Instant::FAR) } else { None };
        self.steps[(self.oldest + self.count) % STEPS] = (now, turns);
        self.count += 1;
        pushed_out
    }

    /// Removes the oldest step and returns its turns, if it ended at `then` or before; otherwise `None`.
    pub(crate) fn take_until(&mut self, then: Instant) -> Option<Turns> {
        let (ended, turns) = *self.all().next()?;
        if ended > then {
            return None;
        }
        self.taken = ended;
        self.oldest = (self.oldest + 1) % STEPS;
        self.count -= 1;
        Some(turns)
    }

    /// Wheel turns in the part of the oldest step that lies before `then`, interpolated linearly; zero without steps.
    pub(crate) fn begun_by(&self, then: Instant) -> Turns {
        let Some((ended, turns)) = self.all().next() else { return [0.0; 2] };
        let (whole, past) = (*ended - self.taken, then - self.taken);
        let share = if whole > Span::ZERO { (past.as_secs() / whole.as_secs()).clamp(0.0, 1.0) } else { 0.0 };
        turns.map(|turn| turn * share)
    }

    /// The turns of all steps, oldest first.
    pub(crate) fn turns(&self) -> impl Iterator<Item = Turns> {
        self.all().map(|(_, turns)| *turns)
    }

    fn all(&self) -> impl Iterator<Item = &(Instant, Turns)> {
        (0..self.count).map(|step| &self.steps[(self.oldest + step) % STEPS])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_come_out_in_order_when_they_are_old_enough() {
        let mut history = OdometryHistory::new();
        for step in 1..=5u32 {
            assert_eq!(history.add(Instant(u64::from(step) * 16_000), [f64::from(step); 2]), None);
        }
        assert_eq!(history.take_until(Instant(15_999)), None);
        assert_eq!(history.take_until(Instant(40_000)), Some([1.0; 2]));
        assert_eq!(history.take_until(Instant(40_000)), Some([2.0; 2]));
        assert_eq!(history.take_until(Instant(40_000)), None);
        assert_eq!(history.begun_by(Instant(40_000)), [1.5; 2]);
        assert_eq!(history.turns().map(|turns| turns[0]).sum::<f64>(), 12.0);
    }

    #[test]
    fn what_is_longer_ago_than_remembered_is_pushed_out() {
        let mut history = OdometryHistory::new();
        let out = (0..100u32).filter_map(|step| history.add(Instant(u64::from(step)), [f64::from(step); 2]));
        assert_eq!(out.count(), 68);
        assert_eq!(history.turns().next(), Some([68.0; 2]));
    }
}

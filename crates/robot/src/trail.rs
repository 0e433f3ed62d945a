//! What the wheels said over the last half second, so that a late fix can be laid beside the past it belongs to.

use lightbots_base::{Instant, Span, Vec2};

/// Steps remembered: 0.5 s of 16 ms.
const STEPS: usize = 32;

/// Travel by wheel turns alone, summed up since power-on.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Travel {
    /// Stage metres.
    pub way: Vec2,
    /// Radians.
    pub turn: f64,
}

/// The travel of the last steps.
#[derive(Debug)]
pub(crate) struct Trail {
    /// How far back it is asked, always the same; nothing is remembered for zero.
    delay: Span,
    now: Travel,
    past: [(Instant, Travel); STEPS],
    newest: usize,
}

impl Trail {
    pub(crate) fn new(delay: Span) -> Self {
        Self { delay, now: Travel::default(), past: [(Instant::ZERO, Travel::default()); STEPS], newest: 0 }
    }

    /// Adds one step that ended at `now`.
    pub(crate) fn add(&mut self, now: Instant, way: Vec2, turn: f64) {
        self.now.way += way;
        self.now.turn += turn;
        if self.delay <= Span::ZERO {
            return;
        }
        self.newest = (self.newest + 1) % STEPS;
        self.past[self.newest] = (now, self.now);
    }

    /// The travel up to now.
    pub(crate) fn now(&self) -> Travel {
        self.now
    }

    /// The travel up to the delay before the newest step, between steps in proportion; the oldest known where that is
    /// not long enough ago.
    pub(crate) fn before(&self) -> Travel {
        if self.delay <= Span::ZERO {
            return self.now;
        }
        let then = self.past[self.newest].0 - self.delay;
        let mut later = self.past[self.newest];
        for back in 1..STEPS {
            let earlier = self.past[(self.newest + STEPS - back) % STEPS];
            if earlier.0 <= then {
                let share = (then - earlier.0).as_secs() / (later.0 - earlier.0).as_secs().max(1e-6);
                return Travel {
                    way: earlier.1.way.lerp(later.1.way, share),
                    turn: earlier.1.turn + (later.1.turn - earlier.1.turn) * share,
                };
            }
            later = earlier;
        }
        later.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after_100_steps(delay: i64) -> Trail {
        let mut trail = Trail::new(Span(delay));
        for step in 1..=100u64 {
            trail.add(Instant(step * 16_000), Vec2::new(0.004, 0.0), 0.01);
        }
        trail
    }

    #[test]
    fn the_past_is_found_between_two_steps() {
        let trail = after_100_steps(40_000);
        assert!((trail.now().way.x - trail.before().way.x - 0.010).abs() < 1e-12);
        assert!((trail.now().turn - trail.before().turn - 0.025).abs() < 1e-12);
    }

    #[test]
    fn what_is_longer_ago_than_remembered_is_the_oldest_known() {
        assert!((after_100_steps(9_000_000).before().way.x - 69.0 * 0.004).abs() < 1e-12);
        let trail = after_100_steps(0);
        assert_eq!(trail.before().way, trail.now().way);
    }
}

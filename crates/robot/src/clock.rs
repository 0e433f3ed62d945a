//! The show clock, from the robot's own clock and two-way time transfer.
//!
//! Each way has its own least delay: the least forward and the least backward delay among the last answers are taken
//! on their own, which converges far faster over a jittery link than the answer with the shortest round trip.

use lightbots_base::{Instant, Span};
use lightbots_wire::TimeAnswer;

/// Answers remembered.
const KEPT: usize = 16;
/// Answers before the clock counts as synchronised.
const ENOUGH: usize = 4;
/// Answers it asks for quickly at first.
const QUICK: usize = 8;
/// Pace of questions, microseconds: at first; until the drift is known; later; and while nobody answers.
const QUICK_PACE: Span = Span::from_millis(200);
const YOUNG_PACE: Span = Span::from_millis(2000);
const OLD_PACE: Span = Span::from_millis(5000);
/// So many questions without an answer: there is no such controller.
const DEAF: u8 = 8;
/// Age of the clock from which the drift is known well.
const YOUNG: Span = Span::from_millis(30_000);
/// An answer later than this is none.
const LATEST: Span = Span::from_millis(3000);
/// A drift measured over so many seconds counts half.
const HALF_KNOWN_S: f64 = 20.0;
/// The drift is measured anew after this, because crystals follow the temperature.
const ANCHOR_AGE_S: f64 = 600.0;
/// No crystal drifts more.
const WORST_DRIFT: f64 = 300e-6;
/// The show clock has been set anew if an answer is further from belief than its own round trip allows, and this.
const PATIENCE_US: f64 = 2000.0;

/// One answer: both one-way delays with the unknown offset in them, relative to `Clock::base_us`.
#[derive(Clone, Copy, Debug)]
struct Sample {
    asked: Instant,
    /// Robot to controller plus offset, microseconds.
    there_us: f64,
    /// Controller to robot minus offset, microseconds.
    back_us: f64,
}

/// What a robot knows of the show clock.
#[derive(Debug)]
pub(crate) struct Clock {
    base_us: i64,
    samples: heapless::Deque<Sample, KEPT>,
    /// Offset less `base_us` at `at`, microseconds.
    offset_us: f64,
    at: Instant,
    drift: f64,
    /// Where drift is measured from: own time, offset, and the drift believed then.
    anchor: Option<(Instant, f64, f64)>,
    spread_us: f64,
    next_question: Instant,
    unanswered: u8,
    was_reset: bool,
}

impl Clock {
    /// A clock that knows nothing and asks from `first` on.
    pub(crate) fn new(first: Instant) -> Self {
        Self {
            base_us: 0,
            samples: heapless::Deque::new(),
            offset_us: 0.0,
            at: Instant::ZERO,
            drift: 0.0,
            anchor: None,
            spread_us: 0.0,
            next_question: first,
            unanswered: 0,
            was_reset: false,
        }
    }

    /// The show time at `now` of the own clock; `None` until synchronised.
    pub(crate) fn show_time(&self, now: Instant) -> Option<Instant> {
        if self.samples.len() < ENOUGH {
            return None;
        }
        let offset = self.offset_us + self.drift * (now - self.at).0 as f64;
        Some(now + Span(self.base_us.saturating_add(offset as i64)))
    }

    /// How far the clock may be off, microseconds; `None` until synchronised.
    pub(crate) fn error_us(&self, now: Instant) -> Option<u32> {
        let unknown_drift =
            if self.anchor.is_some_and(|(since, ..)| now - since > YOUNG) { 20e-6 } else { 100e-6 };
        let error = self.spread_us + 50.0 + unknown_drift * (now - self.at).0 as f64;
        (self.samples.len() >= ENOUGH).then_some(error as u32)
    }

    /// Takes an answer that came in at `now`. Late, doubled and impossible ones are dropped.
    pub(crate) fn answer(&mut self, now: Instant, answer: &TimeAnswer) {
        let age = now - answer.asked;
        let doubled = self.samples.iter().any(|sample| sample.asked == answer.asked);
        if !(Span::ZERO..=LATEST).contains(&age) || doubled || answer.sent < answer.received {
            return;
        }
        self.unanswered = 0;
        let there = (answer.received - answer.asked).0;
        let back = (now - answer.sent).0;
        if self.contradicts(now, there, back) {
            *self = Self { was_reset: true, drift: self.drift, ..Self::new(self.next_question) };
        }
        if self.samples.is_empty() {
            self.base_us = there;
        }
        if self.samples.is_full() {
            self.samples.pop_front();
        }
        let sample = Sample {
            asked: answer.asked,
            there_us: (there - self.base_us) as f64,
            back_us: back.saturating_add(self.base_us) as f64,
        };
        // Never full: room was made above.
        let _ = self.samples.push_back(sample);
        self.settle(now);
    }

    /// Whether believed offset lies outside what this answer leaves possible: at most `there`, at least `-back`.
    fn contradicts(&self, now: Instant, there: i64, back: i64) -> bool {
        if self.samples.is_empty() {
            return false;
        }
        let believed = self.offset_us + self.drift * (now - self.at).0 as f64;
        let slack = PATIENCE_US + self.spread_us + 100e-6 * (now - self.at).0 as f64;
        let most = there.saturating_sub(self.base_us) as f64;
        let least = back.saturating_add(self.base_us) as f64;
        believed > most + slack || -believed > least + slack
    }

    /// Works out the offset at `now` from the answers kept.
    fn settle(&mut self, now: Instant) {
        let (mut there, mut back) = (f64::INFINITY, f64::INFINITY);
        let (mut there_sum, mut back_sum) = (0.0, 0.0);
        for sample in &self.samples {
            let drifted = self.drift * (now - sample.asked).0 as f64;
            there = there.min(sample.there_us + drifted);
            back = back.min(sample.back_us - drifted);
            there_sum += sample.there_us + drifted;
            back_sum += sample.back_us - drifted;
        }
        let count = self.samples.len() as f64;
        self.offset_us = (there - back) * 0.5;
        self.at = now;
        self.spread_us = ((there_sum + back_sum) / count - there - back) / count;
        self.learn_drift(now);
    }

    fn learn_drift(&mut self, now: Instant) {
        if self.samples.len() < QUICK {
            return;
        }
        let (since, offset_then, drift_then) = *self.anchor.get_or_insert((now, self.offset_us, self.drift));
        let seconds = (now - since).as_secs();
        if seconds <= 0.0 {
            return;
        }
        let measured = (self.offset_us - offset_then) / (seconds * 1e6);
        let weight = seconds * seconds / (seconds * seconds + HALF_KNOWN_S * HALF_KNOWN_S);
        self.drift = (drift_then + (measured - drift_then) * weight).clamp(-WORST_DRIFT, WORST_DRIFT);
        if seconds > ANCHOR_AGE_S {
            self.anchor = Some((now, self.offset_us, self.drift));
        }
    }

    /// Whether it is time to ask; then the next question is due later.
    pub(crate) fn take_question(&mut self, now: Instant) -> bool {
        if now < self.next_question {
            return false;
        }
        let pace = if self.unanswered >= DEAF {
            OLD_PACE
        } else if self.samples.len() < QUICK {
            QUICK_PACE
        } else if self.anchor.is_some_and(|(since, ..)| now - since < YOUNG) {
            YOUNG_PACE
        } else {
            OLD_PACE
        };
        self.next_question = now + pace;
        self.unanswered = self.unanswered.saturating_add(1);
        true
    }

    /// Asks again at once, because a link came up or the controller may be gone.
    pub(crate) fn hurry(&mut self, now: Instant) {
        self.next_question = self.next_question.min(now);
        self.unanswered = 0;
    }

    /// Whether the show clock was set anew, so that earlier moments mean nothing any more. Asking clears it.
    pub(crate) fn take_reset(&mut self) -> bool {
        core::mem::take(&mut self.was_reset)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Plays `seconds` of questions over a link of 5 to 20 ms each way; gives the worst error after the first
    /// `settled_s` seconds, microseconds.
    fn worst_error(drift: f64, seconds: u64, settled_s: u64, seed: u64) -> f64 {
        let mut clock = Clock::new(Instant(1000));
        let show_at = |own: Instant| 7_000_000.0 + own.0 as f64 * (1.0 + drift);
        let mut state = seed;
        let mut jitter = move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Span(5000 + (state >> 40) as i64 % 15_000)
        };
        let mut worst = 0.0f64;
        let mut coming: Option<(Instant, TimeAnswer)> = None;
        for step in 0..seconds * 1000 / 16 {
            let now = Instant(step * 16_000);
            if let Some((_, answer)) = coming.take_if(|(at, _)| *at <= now) {
                clock.answer(now, &answer);
            }
            if clock.take_question(now) {
                let received = now + jitter();
                let show = Instant(show_at(received) as u64);
                coming = Some((received + jitter(), TimeAnswer { asked: now, received: show, sent: show }));
            }
            if let Some(show) = clock.show_time(now).filter(|_| now.0 > settled_s * 1_000_000) {
                worst = worst.max((show.0 as f64 - show_at(now)).abs());
            }
        }
        assert!(clock.show_time(Instant(seconds * 1_000_000)).is_some());
        worst
    }

    #[test]
    fn a_jittery_link_and_a_drifting_crystal_leave_two_milliseconds() {
        for seed in 0..10 {
            let worst = worst_error(100e-6, 300, 20, seed);
            // Answers are only read each 16 ms, as a robot that steps reads them: that is part of the jitter.
            assert!(worst < 2000.0, "seed {seed}: {worst} us");
        }
    }

    #[test]
    fn a_clock_is_good_after_two_seconds() {
        for seed in 20..40 {
            let worst = worst_error(-50e-6, 6, 3, seed);
            assert!(worst < 4500.0, "seed {seed}: {worst} us");
        }
    }

    fn exact(asked: u64, show_offset: u64) -> TimeAnswer {
        let there = Instant(asked + show_offset + 1000);
        TimeAnswer { asked: Instant(asked), received: there, sent: there }
    }

    #[test]
    fn a_controller_that_starts_anew_sets_the_clock_anew() {
        let mut clock = Clock::new(Instant::ZERO);
        for n in 0..8 {
            clock.answer(Instant(n * 100_000 + 2000), &exact(n * 100_000, 50_000_000));
        }
        assert_eq!(clock.show_time(Instant(1_000_000)), Some(Instant(51_000_000)));
        assert!(!clock.take_reset());
        for n in 20..24 {
            clock.answer(Instant(n * 100_000 + 2000), &exact(n * 100_000, 0));
        }
        assert!(clock.take_reset());
        assert_eq!(clock.show_time(Instant(3_000_000)), Some(Instant(3_000_000)));
    }

    #[test]
    fn doubled_late_and_impossible_answers_are_dropped() {
        let mut clock = Clock::new(Instant::ZERO);
        for _ in 0..9 {
            clock.answer(Instant(2000), &exact(0, 5));
        }
        clock.answer(Instant(9_000_000), &exact(100, 5));
        clock.answer(Instant(50), &exact(100, 5));
        assert_eq!(clock.show_time(Instant(0)), None);
    }

    #[test]
    fn nobody_there_is_not_asked_often() {
        let mut clock = Clock::new(Instant::ZERO);
        let asked = (0..60_000u64 / 16).filter(|step| clock.take_question(Instant(step * 16_000))).count();
        assert!((15..25).contains(&asked), "{asked}");
    }
}

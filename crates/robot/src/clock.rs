//! The show clock, computed from the robot's own clock by two-way time transfer.
//!
//! A Kalman filter estimates offset and drift of the show clock. An answer measures the offset as half the difference
//! of the delays of question and answer. The error is at most half of the excess of the round trip over the shortest
//! possible one. So the excess sets the noise of the measurement. Over a jittery link the few quick answers count most,
//! but slower answers count, too. (The clock filter of NTP, RFC 5905 section 10, discards all but the quickest answer.)
//! If both directions of a link have much jitter, quick round trips are rare. Then the least delays of each direction
//! on its own give a better estimate ([`least_delays`]).

mod least_delays;

use least_delays::LeastDelays;
use lightbots_base::{Instant, Span};
use lightbots_wire::TimeAnswer;

/// Least number of answers before the clock can count as synchronised. With a smaller value, one delayed answer decides
/// the offset. With a larger value, robots join later.
const ENOUGH: u32 = 4;
/// Largest error of the clock at which it becomes synchronised, microseconds, 1 sigma. After [`QUICK`] answers it
/// becomes synchronised with any error. With a smaller value, robots on jittery links join later. With a larger value,
/// robots depart at visibly different times.
const GOOD_US: f64 = 3_000.0;
/// Number of answers until which questions are sent every [`QUICK_PACE`], if they are answered. Tuned on the tests of
/// this module: an error of 2 ms after 3 s. With a smaller value, clocks are good later.
const QUICK: u32 = 16;
/// Number of answers until which a robot asks every [`QUICK_PACE`] while the error of its clock is above [`GOOD_US`]:
/// 30 s. With a smaller value, clocks differ too much on a link of 5 to 250 ms each way. Robots are then 25 mm off and
/// brake for each other. With a larger value, a fleet floods a link that is always bad.
const PATIENT: u32 = 150;
/// Number of answers from which questions are sent every [`OLD_PACE`]: the clock is settled. With a smaller value, the
/// drift is too uncertain for questions that rare.
const SETTLED: u32 = 60;
/// Time between two questions at first. With a smaller value, a fleet that is switched on floods its broker.
const QUICK_PACE: Span = Span::from_millis(200);
/// Time between two questions from [`QUICK`] answers on, until the clock is settled.
const YOUNG_PACE: Span = Span::from_millis(1000);
/// Time between two questions once the clock is settled, or while no answers come. With a larger value, drift adds up
/// between answers.
const OLD_PACE: Span = Span::from_millis(3000);
/// Number of unanswered questions in a row after which the robot asks every [`OLD_PACE`], because its controller does
/// not answer time questions.
const DEAF: u8 = 8;
/// Longest round trip of a question and its answer that counts. Slower answers are dropped, because a long round trip
/// says little about the offset.
const LATEST: Span = Span::from_millis(3000);
/// Number of answered questions that are remembered, so that a duplicate of an answer is ignored.
const ANSWERED: usize = 8;
/// Bound of the absolute drift, as a share: three times the 100 ppm of a poor crystal. The initial standard deviation
/// of the drift is a third of the bound.
const WORST_DRIFT: f64 = 300e-6;
/// Random walk of the drift because of temperature: its variance per second, as a share squared.
const WANDER: f64 = 0.3e-6 * 0.3e-6;
/// Noise of the offset as measured by the quickest answer, microseconds, 1 sigma. With a smaller value, the filter
/// becomes more certain than the scheduling on a board allows.
const BEST_US: f64 = 100.0;
/// Share by which the shortest known round trip grows with each answer, because routes through a network change.
const LEAK: f64 = 1e-5;
/// An answer counts as that of a restarted controller if the estimated offset is outside its bounds by more than this,
/// microseconds. With a smaller value, a robot loses its route if its own clock jumps.
const SET_ANEW_US: f64 = 500_000.0;

const _: () = assert!(ENOUGH < QUICK && QUICK < SETTLED && SETTLED < PATIENT);
const _: () = assert!(QUICK_PACE.0 < YOUNG_PACE.0 && YOUNG_PACE.0 < OLD_PACE.0);

/// The show clock as a linear function of the own clock, and when the next question is due. A step reads only this part
/// of the clock's state.
#[derive(Debug)]
pub(crate) struct ShowClock {
    /// The offset (show clock minus own clock) is `base_us` + `offset_us` when the own clock reads `at`. The large
    /// whole number is kept apart so that the fraction stays exact.
    base_us: i64,
    offset_us: f64,
    /// Change of the offset, microseconds per microsecond.
    drift: f64,
    at: Instant,
    next_question: Instant,
    synchronised: bool,
}

/// The Kalman filter that fits the linear function of [`ShowClock`] to the answers of the controller.
#[derive(Debug)]
pub(crate) struct ClockFilter {
    /// Whether the clock was reset. If so, all moments of the show clock that were received before are void.
    was_reset: bool,
    unanswered: u8,
    answers: u32,
    /// Covariance: variance of the offset, covariance of offset and drift, variance of the drift.
    variance: [f64; 3],
    shortest_us: f64,
    mean_us: f64,
    delays: LeastDelays,
    /// When the questions of the latest answers were sent, own clock: a ring buffer.
    answered: [Instant; ANSWERED],
}

impl ShowClock {
    /// A clock that is not synchronised; the first question is due at `first`, own clock.
    pub(crate) fn new(first: Instant) -> Self {
        Self {
            base_us: 0,
            offset_us: 0.0,
            drift: 0.0,
            at: Instant::ZERO,
            next_question: first,
            synchronised: false,
        }
    }

    /// The show clock at `now` of the own clock; `None` until it is synchronised.
    pub(crate) fn show_time(&self, now: Instant) -> Option<Instant> {
        self.synchronised.then(|| now + Span(self.base_us.saturating_add(self.offset_at(now) as i64)))
    }

    /// Returns the delay of a question plus (offset − `base_us`), and the delay of its answer minus (offset −
    /// `base_us`), microseconds. `there` and `back` are the differences between the clock readings at receiving and at
    /// sending.
    fn delays_us(&self, there: i64, back: i64) -> [f64; 2] {
        [there.saturating_sub(self.base_us) as f64, back.saturating_add(self.base_us) as f64]
    }

    fn offset_at(&self, now: Instant) -> f64 {
        self.offset_us + self.drift * (now - self.at).0 as f64
    }

    /// Whether a question is due.
    #[inline]
    pub(crate) fn is_question_due(&self, now: Instant) -> bool {
        now >= self.next_question
    }
}

impl ClockFilter {
    /// A filter without answers.
    pub(crate) fn new() -> Self {
        Self {
            answers: 0,
            answered: [Instant::FAR; ANSWERED],
            variance: [0.0; 3],
            shortest_us: f64::INFINITY,
            mean_us: 0.0,
            delays: LeastDelays::NONE,
            unanswered: 0,
            was_reset: false,
        }
    }

    /// Error of the show clock at `now` of the own clock, 2 sigma, microseconds; `None` until it is synchronised.
    pub(crate) fn error_us(&self, clock: &ShowClock, now: Instant) -> Option<u32> {
        let age = (now - clock.at).0 as f64;
        let [offset, both, drift] = self.variance;
        let variance = offset + age * (2.0 * both + age * drift);
        clock.synchronised.then(|| (2.0 * libm::sqrt(variance.max(0.0))) as u32)
    }

    /// Handles an answer that arrived at `now`, own clock. Answers that are too late (see [`LATEST`]), duplicate or
    /// impossible are dropped.
    pub(crate) fn answer(&mut self, clock: &mut ShowClock, now: Instant, answer: &TimeAnswer) {
        let late = !(Span::ZERO..=LATEST).contains(&(now - answer.asked));
        if late || self.answered.contains(&answer.asked) || answer.sent < answer.received {
            return;
        }
        let was_deaf = core::mem::take(&mut self.unanswered) >= DEAF;
        let there = (answer.received - answer.asked).0;
        let back = (now - answer.sent).0;
        let round_us = there.saturating_add(back).max(0) as f64;
        if self.answers > 0 {
            self.predict(clock, now);
            self.keep_within_bounds(clock, there, back, round_us);
        }
        let begins = self.answers == 0;
        if begins {
            self.begin(clock, now, there, round_us);
        }
        self.answered[self.answers as usize % ANSWERED] = answer.asked;
        let [there_us, back_us] = clock.delays_us(there, back);
        self.answers = self.answers.saturating_add(1);
        self.learn(clock, (there_us - back_us) * 0.5, round_us);
        self.delays.take(now, there_us, back_us);
        self.narrow(clock, now);
        let good = self.answers >= QUICK || self.variance[0] <= GOOD_US * GOOD_US;
        clock.synchronised |= self.answers >= ENOUGH && good;
        if begins || was_deaf {
            // The next question was put off at the slow pace of a settled clock, or of one without a controller.
            clock.next_question = clock.next_question.min(now + self.pace());
        }
    }

    fn begin(&mut self, clock: &mut ShowClock, now: Instant, there: i64, round_us: f64) {
        clock.base_us = there;
        clock.at = now;
        clock.offset_us = -0.5 * round_us;
        self.mean_us = round_us;
        self.shortest_us = round_us;
        let unknown_drift = WORST_DRIFT / 3.0;
        self.variance = [round_us * round_us, 0.0, unknown_drift * unknown_drift];
    }

    fn predict(&mut self, clock: &mut ShowClock, now: Instant) {
        let elapsed = (now - clock.at).0 as f64;
        let [offset, both, drift] = self.variance;
        clock.offset_us += clock.drift * elapsed;
        self.delays.age(clock.drift * elapsed, libm::sqrt(drift.max(0.0)) * elapsed.max(0.0));
        self.variance = [
            offset + elapsed * (2.0 * both + elapsed * drift),
            both + elapsed * drift,
            drift + WANDER * elapsed.max(0.0) * 1e-6,
        ];
        clock.at = now;
    }

    /// Corrects offset and drift by one measurement of the offset. Its noise grows with the excess of the round trip
    /// `round_us` over the shortest one.
    fn learn(&mut self, clock: &mut ShowClock, measured_us: f64, round_us: f64) {
        self.shortest_us = (self.shortest_us + LEAK * self.shortest_us).min(round_us);
        self.mean_us += (round_us - self.mean_us) / f64::from(self.answers.min(32));
        // With few answers, even the shortest round trip may be too long: by the excess of the mean one, or by half of
        // itself.
        let unknown_us =
            (self.mean_us - 0.5 * self.shortest_us) / libm::sqrt(f64::from(self.answers.min(200)));
        let excess = round_us - self.shortest_us + unknown_us;
        let noise = BEST_US * BEST_US + excess * excess / 12.0 + unknown_us * unknown_us / 4.0;
        let [offset, both, _] = self.variance;
        let sum = offset + noise;
        let (gain, drift_gain) = (offset / sum, both / sum);
        let off = measured_us - clock.offset_us;
        clock.offset_us += gain * off;
        self.correct(clock, off, 1.0 - gain, drift_gain);
    }

    /// Corrects the drift by `drift_gain` times the innovation `off` of the offset. Multiplies the variance of the
    /// offset, and its covariance with the drift, by `kept`.
    fn correct(&mut self, clock: &mut ShowClock, off: f64, kept: f64, drift_gain: f64) {
        let [offset, both, drift] = self.variance;
        clock.drift = (clock.drift + drift_gain * off).clamp(-WORST_DRIFT, WORST_DRIFT);
        self.variance = [offset * kept, both * kept, drift - drift_gain * both];
    }

    /// Improves the offset by the least delays. If the middle of their bounds is more certain than the offset, the
    /// offset becomes the middle. Otherwise the offset is clamped to the bounds.
    fn narrow(&mut self, clock: &mut ShowClock, now: Instant) {
        let [offset, both, drift] = self.variance;
        let middle = self.delays.middle(now, self.answers, libm::sqrt(drift.max(0.0)));
        let variance = middle.variance + BEST_US * BEST_US;
        if variance < offset {
            let kept = variance / offset;
            let off = middle.offset_us - clock.offset_us;
            clock.offset_us = middle.offset_us;
            self.correct(clock, off, kept, both / offset * (1.0 - kept));
        } else {
            let [least, most] = self.delays.bounds_us();
            clock.offset_us = clock.offset_us.clamp(least.min(most), most);
        }
    }

    /// Bounds the offset by an answer, which proves that the offset is at most `there` and at least `-back`. An
    /// estimated offset outside moves to the bound and becomes less certain. If it is outside by more than
    /// [`SET_ANEW_US`], the controller was restarted, and the clock is reset.
    fn keep_within_bounds(&mut self, clock: &mut ShowClock, there: i64, back: i64, round_us: f64) {
        let [most, back_us] = clock.delays_us(there, back);
        let least = -back_us;
        let outside = (clock.offset_us - most).max(least - clock.offset_us);
        if outside > SET_ANEW_US {
            *self = Self { was_reset: true, ..Self::new() };
            *clock = ShowClock { drift: clock.drift, ..ShowClock::new(clock.next_question) };
        } else if outside > 0.0 {
            clock.offset_us = clock.offset_us.clamp(least.min(most), most);
            self.variance[0] = self.variance[0].max(round_us * round_us / 12.0);
        }
    }

    /// Notes that a question is sent at `now`, own clock, and sets when the next question is due.
    pub(crate) fn ask(&mut self, clock: &mut ShowClock, now: Instant) {
        clock.next_question = now + self.pace();
        self.unanswered = self.unanswered.saturating_add(1);
    }

    /// Time between two questions in the present state.
    fn pace(&self) -> Span {
        match self.answers {
            _ if self.unanswered >= DEAF => OLD_PACE,
            0..QUICK => QUICK_PACE,
            QUICK..PATIENT if self.variance[0] > GOOD_US * GOOD_US => QUICK_PACE,
            QUICK..SETTLED => YOUNG_PACE,
            _ => OLD_PACE,
        }
    }

    /// Makes the next question due at once, because the link came up. The count of unanswered questions begins again.
    pub(crate) fn hurry(&mut self, clock: &mut ShowClock, now: Instant) {
        clock.next_question = clock.next_question.min(now);
        self.unanswered = 0;
    }

    /// Returns whether the show clock was reset, so that all moments received before are void. The call clears the
    /// flag.
    pub(crate) fn take_reset(&mut self) -> bool {
        core::mem::take(&mut self.was_reset)
    }
}

#[cfg(test)]
#[path = "clock_tests.rs"]
mod tests;

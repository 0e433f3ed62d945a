use super::*;

struct Clock {
    line: ShowClock,
    filter: ClockFilter,
}

impl Clock {
    fn new(first: Instant) -> Self {
        Self { line: ShowClock::new(first), filter: ClockFilter::new() }
    }

    fn answer(&mut self, now: Instant, answer: &TimeAnswer) {
        self.filter.answer(&mut self.line, now, answer);
    }

    fn show_time(&self, now: Instant) -> Option<Instant> {
        self.line.show_time(now)
    }

    fn take_question(&mut self, now: Instant) -> bool {
        let is_due = self.line.is_question_due(now);
        if is_due {
            self.filter.ask(&mut self.line, now);
        }
        is_due
    }
}

/// Simulates `seconds` of questions over a link of 5 ms to `slowest_ms` each way. Returns the worst error after the
/// first `settled_s` seconds, microseconds.
fn worst_error(slowest_ms: i64, drift: f64, seconds: u64, settled_s: u64, seed: u64) -> f64 {
    let mut clock = Clock::new(Instant(1000));
    let show_at = |own: Instant| 7_000_000.0 + own.0 as f64 * (1.0 + drift);
    let mut state = seed;
    let mut jitter = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Span(5000 + (state >> 40) as i64 % ((slowest_ms - 5) * 1000))
    };
    let mut worst = 0.0f64;
    let mut coming: heapless::Deque<(Instant, TimeAnswer), 8> = heapless::Deque::new();
    for step in 0..seconds * 1000 / 16 {
        let now = Instant(step * 16_000);
        while let Some(&(at, answer)) = coming.front().filter(|(at, _)| *at <= now) {
            clock.answer(at, &answer);
            coming.pop_front();
        }
        if clock.take_question(now) {
            let received = now + jitter();
            let show = Instant(show_at(received) as u64);
            let answer = TimeAnswer { asked: now, received: show, sent: show };
            coming.push_back((received + jitter(), answer)).unwrap();
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
    let mut worst: [f64; 10] = core::array::from_fn(|seed| worst_error(20, 100e-6, 300, 40, seed as u64));
    worst.sort_by(f64::total_cmp);
    assert!(worst[6] < 2000.0 && worst[9] < 3000.0, "{worst:?}");
}

#[test]
fn a_clock_is_good_after_three_seconds() {
    for seed in 20..40 {
        let worst = worst_error(20, -50e-6, 6, 3, seed);
        assert!(worst < 2000.0, "seed {seed}: {worst} us");
    }
}

#[test]
fn over_a_slow_and_jittery_link_a_clock_is_good_after_half_a_minute() {
    let mut worst: [f64; 20] = core::array::from_fn(|seed| worst_error(250, 50e-6, 60, 30, seed as u64));
    worst.sort_by(f64::total_cmp);
    assert!(worst[10] < 6_000.0 && worst[19] < 15_000.0, "{worst:?}");
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
    assert!(!clock.filter.take_reset());
    for n in 20..24 {
        clock.answer(Instant(n * 100_000 + 2000), &exact(n * 100_000, 0));
    }
    assert!(clock.filter.take_reset());
    assert_eq!(clock.show_time(Instant(3_000_000)), Some(Instant(3_000_000)));
}

/// Answers each question from `from` on for `seconds`, with this offset of the show clock. Returns the moment from
/// which the clock is synchronised.
fn converse(clock: &mut Clock, from: Instant, seconds: f64, show_offset: u64) -> Option<Instant> {
    let steps = (0..(seconds * 62.5) as u64).map(|step| from + Span(step as i64 * 16_000));
    steps.fold(None, |good, now| {
        if clock.take_question(now) {
            clock.answer(now + Span(2_000), &exact(now.0, show_offset));
        }
        good.or(clock.show_time(now).map(|_| now)).filter(|_| clock.show_time(now).is_some())
    })
}

#[test]
fn a_settled_clock_that_is_set_anew_asks_as_often_as_a_new_one() {
    let mut clock = Clock::new(Instant::ZERO);
    converse(&mut clock, Instant::ZERO, 90.0, 50_000_000);
    let asks_at = clock.line.next_question;
    let good = converse(&mut clock, asks_at, 10.0, 48_000_000).unwrap();
    assert!((good - asks_at).as_secs() < 1.0, "{:?}", good - asks_at);
}

#[test]
fn a_robot_that_gets_answers_again_asks_as_often_as_before() {
    let mut clock = Clock::new(Instant::ZERO);
    converse(&mut clock, Instant::ZERO, 0.3, 50_000_000);
    let silent = (0..1_000u64).map(|step| Instant(300_000 + step * 16_000));
    let last = silent.filter(|&now| clock.take_question(now)).last().unwrap();
    let asks_at = clock.line.next_question;
    assert_eq!(asks_at - last, OLD_PACE);
    let good = converse(&mut clock, asks_at, 10.0, 50_000_000).unwrap();
    assert!((good - asks_at).as_secs() < 1.0, "{:?}", good - asks_at);
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
fn a_controller_that_does_not_answer_is_asked_seldom() {
    let mut clock = Clock::new(Instant::ZERO);
    let asked = (0..60_000u64 / 16).filter(|step| clock.take_question(Instant(step * 16_000))).count();
    assert!((15..30).contains(&asked), "{asked}");
}

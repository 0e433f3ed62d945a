//! Path time that hardly jumps back. Path time is how far along its route a robot should be, as a time. A HOLD names
//! the moment at which path time stops. The HOLD can arrive after that moment, for example after a freeze of the
//! broker. Path time has then run too far. If robots drove straight back to where they should have stopped, they might
//! meet. So each robot goes back along its route. Robots that receive the HOLD at the same moment go back in step.

use lightbots_base::{Instant, Span};
use lightbots_wire::Route;

use crate::timeline::RouteProgress;

/// Lowest rate of path time, in path time per show time; negative rates go back. With a lower rate, robots go back too
/// fast to see others behind them. With a rate closer to 0, going back takes longer.
const BACK: f64 = -0.5;
/// Largest jump back of path time that is made at once: 5 mm at full speed. With a smaller value, small corrections of
/// the clock make robots go back slowly, too.
const JUMP: Span = Span::from_millis(20);
/// Going back ends once path time is ahead of the due path time by no more than this.
const THERE: Span = Span::from_millis(2);

/// The progress of a route under way, which never jumps back by more than [`JUMP`].
#[derive(Debug)]
pub(crate) struct SteadyTime {
    /// Moment of the latest step, show clock.
    at: Instant,
    progress: RouteProgress,
    goes_back: bool,
}

impl SteadyTime {
    /// The progress of a route that begins at the moment `starts`, show clock.
    pub(crate) fn new(starts: Instant) -> Self {
        Self { at: starts, progress: RouteProgress::START, goes_back: false }
    }

    /// Returns the progress at the moment `at`, show clock: `due`, or a progress that goes back towards `due`. `due`:
    /// the progress that follows from all known holds and resumes.
    pub(crate) fn step(&mut self, at: Instant, due: RouteProgress) -> RouteProgress {
        let over_s = (at - core::mem::replace(&mut self.at, at)).as_secs().clamp(0.0, 0.1);
        let RouteProgress { time, rate, .. } = self.progress;
        let ahead = time + Span::from_secs(rate * over_s) - due.time;
        self.goes_back = ahead > if self.goes_back { THERE } else { JUMP };
        self.progress = due;
        if self.goes_back {
            let slope = 1.0 / Route::EASE.as_secs();
            let wanted = (due.rate - libm::sqrt(2.0 * slope * ahead.as_secs())).max(BACK);
            let rate = wanted.clamp(rate - slope * over_s, rate + slope * over_s);
            self.progress = RouteProgress { time: time + Span::from_secs(rate * over_s), rate, ..due };
        }
        self.progress
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::timeline::Timeline;

    /// Duration of a step.
    const STEP: Span = Span::from_millis(16);

    /// Progress of each step of a route from 0 s on. `comes`: when a HOLD of `hold` is learnt of, and a RESUME.
    fn progress(
        hold: Instant,
        comes: Instant,
        resume: Option<Instant>,
    ) -> impl Iterator<Item = (Instant, RouteProgress)> {
        let (mut timeline, mut steady) = (Timeline::new(), SteadyTime::new(Instant::ZERO));
        timeline.begin(Instant::ZERO);
        (0..600).map(move |step| {
            let now = Instant::ZERO + STEP * step;
            if now >= comes {
                timeline.note(hold, true);
                resume.into_iter().for_each(|resume| timeline.note(resume, false));
            }
            (now, steady.step(now, timeline.at(now)))
        })
    }

    #[test]
    fn a_hold_in_time_is_kept_to_the_microsecond() {
        let hold = Instant(2_000_000);
        let mut timeline = Timeline::new();
        timeline.begin(Instant::ZERO);
        timeline.note(hold, true);
        assert!(progress(hold, Instant(1_900_000), None).all(|(now, progress)| progress == timeline.at(now)));
    }

    #[test]
    fn after_a_late_hold_path_time_goes_back_evenly_to_where_all_hold() {
        for late_ms in [100, 500, 1_300] {
            let comes = Instant(2_000_000 + 1000 * late_ms);
            let all: heapless::Vec<(Instant, RouteProgress), 600> =
                progress(Instant(2_000_000), comes, None).collect();
            for pair in all.windows(2) {
                let [(from, a), (to, b)] = [pair[0], pair[1]];
                let rate = (b.time - a.time).as_secs() / (to - from).as_secs();
                assert!(rate >= BACK - 1e-6 && (b.rate - a.rate).abs() < 0.13, "{late_ms} ms: {a:?} {b:?}");
            }
            let last = all.last().unwrap().1;
            assert_eq!(
                (last.time, last.rate, last.held),
                (Span::from_millis(2_150), 0.0, true),
                "{late_ms} ms"
            );
        }
    }

    #[test]
    fn with_a_resume_known_too_path_time_slows_down_until_it_is_right() {
        let (hold, comes) = (Instant(2_000_000), Instant(3_000_000));
        let resume = Instant(3_200_000);
        let mut timeline = Timeline::new();
        timeline.begin(Instant::ZERO);
        timeline.note(hold, true);
        timeline.note(resume, false);
        let (now, last) = progress(hold, comes, Some(resume)).last().unwrap();
        assert_eq!(last, timeline.at(now));
    }
}

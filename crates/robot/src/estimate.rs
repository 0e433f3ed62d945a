//! Estimate of the robot's present pose. The filter estimates the pose at the moment at which the latest fix was
//! measured. If fixes arrive late, odometry since that moment leads to the present pose.

use lightbots_base::{Instant, Pose, Span, Vec2, wrap};

use crate::config::{Config, Fix};
use crate::filter::{Filter, turned};
use crate::history::OdometryHistory;

/// A robot is lost if the error of its place is larger than this, metres, 1 sigma. With a smaller value, robots abandon
/// routes in short outages. With a larger value, robots drive where they may touch their neighbours.
const LOST_M: f64 = 0.02;
/// A robot is lost after this time without a fix, whatever the covariance says.
const LOST_AFTER: Span = Span::from_millis(3000);

/// How well a robot knows its pose in a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseQuality {
    /// Whether the pose is too uncertain to drive: the error of the place exceeds [`LOST_M`], or `lost_for_good`.
    pub lost: bool,
    /// Whether the last fix is older than [`LOST_AFTER`], or no fix ever came. Then even a robot that rests on a held
    /// route is lost.
    pub lost_for_good: bool,
    /// Whether fixes are overdue, or no fix ever came.
    pub blind: bool,
}

/// The estimated present pose.
#[derive(Debug)]
pub(crate) struct Estimate {
    delay: Span,
    filter: Filter,
    /// The present place, stage metres, if fixes arrive late. Otherwise `at`, `facing` and `heading` are unused,
    /// because the filter's pose is the present one.
    at: Vec2,
    /// Unit vector of `heading`.
    facing: Vec2,
    heading: f64,
}

impl Estimate {
    pub(crate) fn new(config: &Config) -> Self {
        Self {
            filter: Filter::new(config),
            delay: config.fix_delay,
            at: Vec2::ZERO,
            heading: 0.0,
            facing: Vec2::new(1.0, 0.0),
        }
    }

    /// Predicts the pose over the step that ended at `now`, from the turns of the left and the right wheel, radians.
    /// `history`: the turns that the filter has not been given yet, because fixes of their time are still to come.
    #[inline]
    pub(crate) fn advance(&mut self, now: Instant, turns_rad: [f64; 2], history: &mut OdometryHistory) {
        if !self.is_ahead() {
            self.filter.advance(turns_rad);
        } else {
            if let Some(turns) = history.add(now, turns_rad) {
                self.filter.advance(turns);
            }
            while let Some(turns) = history.take_until(now - self.delay) {
                self.filter.advance(turns);
            }
        }
        self.predict_present(history);
    }

    /// Corrects the pose by a fix that arrived at `now`. A heading that is not finite is ignored, and so is a place
    /// with a coordinate that is NaN or at least 1 km.
    #[inline]
    pub(crate) fn correct(&mut self, now: Instant, fix: &Fix, history: &OdometryHistory) {
        if !self.is_ahead() {
            self.filter.correct(now, fix);
        } else {
            // The fix was measured within the first step of the history, which the filter has not taken yet.
            let (way, turn) = self.filter.motion(history.begun_by(now - self.delay));
            let moved = self.filter.facing() * way;
            let fix = Fix { at: fix.at - moved, heading: fix.heading.map(|heading| heading - turn) };
            self.filter.correct(now, &fix);
        }
        self.predict_present(history);
    }

    #[inline]
    fn predict_present(&mut self, history: &OdometryHistory) {
        if self.is_ahead() {
            (self.at, self.heading, self.facing) =
                (self.filter.at(), self.filter.heading(), self.filter.facing());
            self.follow_history(history);
        }
    }

    fn follow_history(&mut self, history: &OdometryHistory) {
        let mut turned_by = 0.0;
        for turns in history.turns() {
            let (way, turn) = self.filter.motion(turns);
            let before = self.facing;
            self.facing = turned(before, turn.clamp(-0.3, 0.3));
            self.at += (before + self.facing) * (0.5 * way);
            turned_by += turn;
        }
        self.heading = wrap(self.heading + turned_by);
    }

    /// The estimated present place, stage metres.
    pub(crate) fn at(&self) -> Vec2 {
        if self.is_ahead() { self.at } else { self.filter.at() }
    }

    /// Unit vector of the heading.
    pub(crate) fn facing(&self) -> Vec2 {
        if self.is_ahead() { self.facing } else { self.filter.facing() }
    }

    fn heading(&self) -> f64 {
        if self.is_ahead() { self.heading } else { self.filter.heading() }
    }

    /// Whether fixes arrive late, so that the present is ahead of the filter's moment.
    fn is_ahead(&self) -> bool {
        self.delay > Span::ZERO
    }

    /// Whether the heading is known.
    pub(crate) fn aligned(&self) -> bool {
        self.filter.aligned()
    }

    /// Estimated slip of the left and the right wheel: the share of their turning that does not move the robot.
    pub(crate) fn slip(&self) -> [f64; 2] {
        self.filter.slip()
    }

    /// The estimated present pose; `None` while the heading is unknown.
    pub(crate) fn pose(&self) -> Option<Pose> {
        self.aligned().then_some(Pose::new(self.at(), self.heading()))
    }

    /// Expected error of the place, 1 sigma, metres: that of x or of y, whichever is larger.
    pub(crate) fn error_m(&self) -> f64 {
        libm::sqrt(self.filter.variance())
    }

    /// Expected error of the place after `way_m` more metres of driving without a fix, 1 sigma, metres.
    pub(crate) fn error_after_m(&self, way_m: f64) -> f64 {
        libm::sqrt(self.filter.variance() + self.filter.drift(way_m))
    }

    /// Error of the place after `way_m` more metres of driving without a fix, metres. It assumes that heading error and
    /// slip error stay constant, and adds all errors linearly.
    pub(crate) fn error_at_worst_m(&self, way_m: f64) -> f64 {
        // The filter's covariance is that of the moment at which the fixes were made.
        self.error_m() + self.filter.strays_m(way_m + self.at().distance(self.filter.at()))
    }

    /// How well the pose is known at `now`. Fixes are overdue if none came for longer than `blind_after`.
    #[inline]
    pub(crate) fn quality(&self, now: Instant, blind_after: Span) -> PoseQuality {
        let age = self.filter.last_fix().map(|fix| now - fix);
        let is_older = |span: Span| age.is_none_or(|age| age > span);
        let lost_for_good = is_older(LOST_AFTER);
        let lost = self.filter.variance() > LOST_M * LOST_M || lost_for_good;
        PoseQuality { lost, lost_for_good, blind: is_older(blind_after) }
    }

    /// Whether no fix came for longer than `span`, or ever.
    pub(crate) fn is_blind(&self, now: Instant, span: Span) -> bool {
        self.filter.last_fix().is_none_or(|fix| now - fix > span)
    }

    /// Whether the pose is too uncertain to drive: the error of the place exceeds [`LOST_M`], or the last fix is older
    /// than [`LOST_AFTER`]. Also if no fix ever came.
    pub(crate) fn lost(&self, now: Instant) -> bool {
        self.filter.variance() > LOST_M * LOST_M || self.lost_for_good(now)
    }

    /// Whether the last fix is older than [`LOST_AFTER`], or no fix ever came.
    pub(crate) fn lost_for_good(&self, now: Instant) -> bool {
        self.is_blind(now, LOST_AFTER)
    }

    /// Returns how far outlier fixes have moved the place by jumps since the last call, metres; 0 if there was no jump.
    pub(crate) fn take_jump_m(&mut self) -> f64 {
        self.filter.take_jump_m()
    }

    /// Returns whether the place jumped twice within a second, which no push of the robot explains. The call clears the
    /// flag.
    pub(crate) fn take_senseless(&mut self) -> bool {
        self.filter.take_senseless()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lightbots_base::RobotId;

    fn config() -> Config {
        Config::new(RobotId::new("r").unwrap())
    }

    fn fix(x: f64, heading: f64) -> Fix {
        Fix { at: Vec2::new(x, 0.0), heading: Some(heading) }
    }

    #[test]
    fn dead_reckoning_ends_in_being_lost() {
        let mut history = OdometryHistory::new();
        let mut one = Estimate::new(&config());
        assert!(one.lost(Instant(0)));
        one.correct(Instant(0), &fix(0.0, 0.0), &history);
        assert!(!one.lost(Instant(2_900_000)));
        assert!(one.lost(Instant(3_100_000)));
        let mut steps = 0;
        while !one.lost(Instant(0)) {
            steps += 1;
            one.advance(Instant(steps * 16_000), [0.96, 0.96], &mut history);
        }
        assert!((20..120).contains(&steps), "{steps}");
        assert!(one.error_m() > LOST_M);
    }

    #[test]
    fn what_is_not_a_number_is_no_fix() {
        let mut one = Estimate::new(&config());
        let history = OdometryHistory::new();
        one.correct(
            Instant(0),
            &Fix { at: Vec2::new(f64::NAN, 0.0), heading: Some(f64::INFINITY) },
            &history,
        );
        assert!(one.lost(Instant(0)) && !one.aligned());
    }

    #[test]
    fn late_fixes_between_two_steps_leave_no_lag() {
        let mut history = OdometryHistory::new();
        let mut one = Estimate::new(&Config { fix_delay: Span::from_millis(40), ..config() });
        let (speed, turn) = (0.2, 0.5);
        let truth = |at_s: f64| {
            let angle = turn * at_s;
            (Vec2::new(angle.sin(), 1.0 - angle.cos()) * (speed / turn), angle)
        };
        let wheel = |side: f64| (speed + side * turn * 0.0402 / 2.0) * 0.016 / 0.0045;
        for step in 1..200u64 {
            let now = Instant(step * 16_000);
            let turns = if step > 50 { [wheel(-1.0), wheel(1.0)] } else { [0.0; 2] };
            one.advance(now, turns, &mut history);
            let (at, heading) = truth((step as f64 * 0.016 - 0.8 - 0.04).max(0.0));
            one.correct(now, &Fix { at, heading: Some(heading) }, &history);
            let (at, heading) = truth((step as f64 * 0.016 - 0.8).max(0.0));
            assert!(one.at().distance(at) < 1e-4, "step {step}: {:?} {at:?}", one.at());
            assert!((one.facing() - Vec2::unit(heading)).length() < 1e-3, "step {step}");
        }
    }
}

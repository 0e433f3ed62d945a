//! Whether a robot has enough time to turn to a new direction where its path changes direction at low speed. For that
//! it has the time in which it is so slow that its direction hardly matters.

use super::course::{CREEP_MPS, Course};
use lightbots_base::{Limits, Vec2};

/// Time that a robot may lack for a turn while it is slow, seconds. It finishes the turn while it drives off.
const GRACE_S: f64 = 0.05;
/// Share of [`CREEP_MPS`] above which a robot may count as fast. Between this speed and [`CREEP_MPS`], it may count as
/// slow or as fast.
const FAST_SHARE: f64 = 0.9;
/// Most parts into which one piece is divided; paths that robots drive need some dozens. A piece that needs more is
/// rejected.
const MOST_STRETCHES: usize = 10_000;
/// Parts shorter than this that are neither slow nor fast give no time for turning, seconds.
const SHORTEST_S: f64 = 1e-3;

/// The direction of a robot while it follows its path, and the time that it has and needs for turns.
pub(super) struct Facing<'a> {
    limits: &'a Limits,
    /// Direction at the end of the robot's last fast motion; `None` before its first.
    heading: Option<Vec2>,
    /// Time for which the robot has been slow since its last fast motion, seconds.
    slow_s: f64,
    /// Time that the robot still lacks for earlier turns, seconds.
    behind_s: f64,
}

impl<'a> Facing<'a> {
    pub fn new(limits: &'a Limits) -> Self {
        Self { limits, heading: None, slow_s: 0.0, behind_s: 0.0 }
    }

    /// Follows the next piece of the path, which lasts `seconds`. Returns whether the robot had enough time, but for
    /// [`GRACE_S`], for each turn before it moves fast on this piece. `false` also if the piece needs too many parts.
    pub fn follow(&mut self, course: &Course, seconds: f64) -> bool {
        let mut left = MOST_STRETCHES;
        self.go_on(course, seconds, &mut left) && left > 0
    }

    fn go_on(&mut self, course: &Course, seconds: f64, left: &mut usize) -> bool {
        *left = left.saturating_sub(1);
        if *left == 0 {
            return false;
        }
        if course.speed_bound() < CREEP_MPS {
            self.slow_s += seconds;
            return true;
        }
        if course.speed_floor() >= CREEP_MPS * FAST_SHARE {
            let [first, _, last] = course.velocity;
            let in_time = self.turn(first);
            self.heading = last.normalized();
            self.behind_s = (self.behind_s - seconds).max(0.0);
            return in_time;
        }
        if seconds < SHORTEST_S {
            return true;
        }
        let (first, second) = course.halves();
        let in_time = self.go_on(&first, seconds / 2.0, left);
        self.go_on(&second, seconds / 2.0, left) && in_time
    }

    /// Begins fast motion with this velocity. Returns whether there was time to turn to its direction, but for
    /// [`GRACE_S`].
    fn turn(&mut self, velocity: Vec2) -> bool {
        let Some(line) = velocity.normalized() else { return true };
        self.behind_s = (self.behind_s + self.needed_s(line) - self.slow_s).max(0.0);
        self.slow_s = 0.0;
        self.behind_s <= GRACE_S
    }

    /// Time to turn towards the unit vector `towards`, seconds; that of a quarter turn before the robot's first fast
    /// motion. The robot may then drive forwards or backwards, whichever needs the smaller turn.
    fn needed_s(&self, towards: Vec2) -> f64 {
        let angle = match self.heading {
            Some(heading) => Vec2::new(heading.dot(towards).abs(), heading.cross(towards).abs()).angle(),
            None => core::f64::consts::FRAC_PI_2,
        };
        angle / self.limits.turn_radps.max(1e-3)
    }
}

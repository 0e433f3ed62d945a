//! Whether a robot has enough time to turn where its path turns. It has the time in which it is too slow for its
//! direction to matter.

use super::course::{CREEP_MPS, Course};
use lightbots_base::{Limits, Vec2};

/// Time that a robot may lack for a turn while it is slow, seconds: it catches up while it drives off.
const GRACE_S: f64 = 0.05;
/// Share of the creep speed above which a robot may count as fast. Between this and the creep speed, it may count as
/// slow or fast.
const FAST_SHARE: f64 = 0.9;
/// Most stretches of one piece; driven paths need some dozens. A piece that needs more is rejected.
const MOST_STRETCHES: usize = 10_000;
/// Shorter stretches that are neither slow nor fast give no time for turning, seconds.
const SHORTEST_S: f64 = 1e-3;

/// The direction of a robot along its path, and the time that it has and needs for turns.
pub(super) struct Facing<'a> {
    limits: &'a Limits,
    /// Direction at the end of its last fast motion; `None` before the first drive.
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

    /// Follows a piece that takes `seconds`. Returns whether there is time for all turns at its begin and where it is
    /// slow.
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

    /// Begins fast motion along a line. Returns whether there was time to turn towards it.
    fn turn(&mut self, velocity: Vec2) -> bool {
        let Some(line) = velocity.normalized() else { return true };
        self.behind_s = (self.behind_s + self.needed_s(line) - self.slow_s).max(0.0);
        self.slow_s = 0.0;
        self.behind_s <= GRACE_S
    }

    /// Time of a turn towards a line, forwards or backwards, whichever is nearer.
    fn needed_s(&self, towards: Vec2) -> f64 {
        let angle = match self.heading {
            Some(heading) => Vec2::new(heading.dot(towards).abs(), heading.cross(towards).abs()).angle(),
            None => core::f64::consts::FRAC_PI_2,
        };
        angle / self.limits.turn_radps.max(1e-3)
    }
}

//! Whether a robot has the time to turn where its path does: it has as long as it is too slow for that to matter.

use super::drive::{CREEP_MPS, Course};
use lightbots_base::{Limits, Vec2};

/// What a robot may lack when it has to turn while it is slow, seconds: it makes up for that while it drives off.
const GRACE_S: f64 = 0.05;
/// From this share of the creeping speed on a robot may be called fast, so that speeds between are either.
const FAST_SHARE: f64 = 0.9;
/// Stretches of one piece that are looked at. Paths that are driven need some dozens; what is still undecided after so
/// many is refused.
const MOST_STRETCHES: usize = 10_000;
/// Shorter stretches that are neither slow nor fast give no time for turning, seconds.
const SHORTEST_S: f64 = 1e-3;

/// How a robot stands while its path goes by.
pub(super) struct Facing<'a> {
    limits: &'a Limits,
    /// The line it drove along when it last was fast; `None` before the first drive.
    heading: Option<Vec2>,
    /// For how long it has been slow since then, seconds.
    slow_s: f64,
    /// What it still lacks of earlier turns, seconds.
    behind_s: f64,
}

impl<'a> Facing<'a> {
    pub fn new(limits: &'a Limits) -> Self {
        Self { limits, heading: None, slow_s: 0.0, behind_s: 0.0 }
    }

    /// Goes on along a piece that takes `seconds`; whether there is time enough for all turns at its beginning and
    /// where it is slow. Turns while it is fast are not asked for.
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

    /// Drives fast along a line from now on.
    fn turn(&mut self, velocity: Vec2) -> bool {
        let Some(line) = velocity.normalized() else { return true };
        self.behind_s = (self.behind_s + self.needed_s(line) - self.slow_s).max(0.0);
        self.slow_s = 0.0;
        self.behind_s <= GRACE_S
    }

    /// How long turning towards a line takes, forwards or backwards, whichever is nearer.
    fn needed_s(&self, towards: Vec2) -> f64 {
        let angle = match self.heading {
            Some(heading) => Vec2::new(heading.dot(towards).abs(), heading.cross(towards).abs()).angle(),
            None => core::f64::consts::FRAC_PI_2,
        };
        angle / self.limits.turn_radps.max(1e-3)
    }
}

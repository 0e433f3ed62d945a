//! How often the safety layers of robots brake, and how often nothing faulty was ahead.

use lightbots_base::Vec2;
use serde::Serialize;

/// Least number of steps without braking (10 steps: 0.16 s) between two braking episodes of a robot. A smaller number
/// would split one braking into several episodes, because sensors are noisy. A larger number would join brakings for
/// different neighbours.
const FREE_STEPS: u64 = 10;
/// A robot is off its route if it is farther than this from where its route wants it at the moment, metres. Planned
/// gaps between robots are about this wide.
const OFF_ROUTE_M: f64 = 0.01;
/// Distance beyond the range of the proximity sensors at which a robot still counts as ahead, metres. Together, the two
/// robots move by about 9 mm at most between the reading and the classification.
const BEYOND_SIGHT_M: f64 = 0.01;

/// Numbers of braking episodes in a rehearsal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct BrakeCounts {
    /// Number of all episodes. In each, the safety layer of a robot began to slow it.
    pub all: u64,
    /// Number of the episodes in which no faulty robot and no off-route robot was ahead.
    #[serde(rename = "false")]
    pub unfounded: u64,
}

/// Counts braking episodes. [`Self::note`] opens an episode, and the next call of [`Self::classify`] counts it.
#[derive(Debug)]
pub(crate) struct Brakes {
    counts: BrakeCounts,
    /// `[robot]`: number of the first step in which braking would begin a new episode.
    new_from: Vec<u64>,
    /// Episodes that began and are not classified yet.
    begun: Vec<Brake>,
    /// Largest distance between centres at which a robot counts as ahead, metres. It includes [`BEYOND_SIGHT_M`].
    sight_m: f64,
}

/// An episode that began.
#[derive(Clone, Copy, Debug)]
struct Brake {
    robot: usize,
    /// Direction from the robot to the neighbour for which it brakes, a unit vector in stage axes.
    towards: Vec2,
}

impl Brakes {
    /// A counter for `robots` robots whose proximity sensors detect robots with centres at most `sight_m` metres away.
    pub fn new(robots: usize, sight_m: f64) -> Self {
        Self {
            counts: BrakeCounts::default(),
            new_from: vec![0; robots],
            begun: Vec::new(),
            sight_m: sight_m + BEYOND_SIGHT_M,
        }
    }

    /// Notes that `robot` brakes in step number `step` for a neighbour. `towards`: unit vector from the robot to the
    /// neighbour, in stage axes.
    pub fn note(&mut self, step: u64, robot: usize, towards: Vec2) {
        if step >= self.new_from[robot] {
            self.begun.push(Brake { robot, towards });
        }
        self.new_from[robot] = step + FREE_STEPS + 1;
    }

    /// Classifies the episodes that were noted since the last call. `places[robot]`: centre of the robot now, stage
    /// metres. `is_amiss(robot, off_m)` returns whether the robot is faulty, or farther than `off_m` from its route.
    #[inline]
    pub fn classify(&mut self, places: &[Vec2], is_amiss: impl Fn(usize, f64) -> bool) {
        for Brake { robot, towards } in self.begun.drain(..) {
            let is_ahead = |other: usize| {
                let to_other = places[other] - places[robot];
                other != robot && to_other.length() < self.sight_m && to_other.dot(towards) > 0.0
            };
            let has_cause = (0..places.len()).any(|other| is_ahead(other) && is_amiss(other, OFF_ROUTE_M));
            self.counts.all += 1;
            self.counts.unfounded += u64::from(!has_cause);
        }
    }

    /// Episodes classified until now.
    pub fn counts(&self) -> BrakeCounts {
        self.counts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Direction from robot 0 to the neighbour for which it brakes.
    const AHEAD: Vec2 = Vec2::new(1.0, 0.0);

    #[test]
    fn an_episode_ends_after_ten_free_steps() {
        let mut brakes = Brakes::new(1, 0.084);
        for step in [1, 2, 3, 13, 24, 25] {
            brakes.note(step, 0, AHEAD);
        }
        brakes.classify(&[Vec2::ZERO], |_, _| false);
        // Nine free steps between 3 and 13 are too few, ten between 13 and 24 are enough.
        assert_eq!(brakes.counts(), BrakeCounts { all: 2, unfounded: 2 });
    }

    #[test]
    fn a_brake_is_false_where_nothing_amiss_is_ahead_and_in_sight() {
        let unfounded = |other: Vec2, amiss: bool| {
            let mut brakes = Brakes::new(2, 0.084);
            brakes.note(1, 0, AHEAD);
            brakes.classify(&[Vec2::ZERO, other], |robot, _| amiss && robot == 1);
            assert_eq!(brakes.counts().all, 1);
            brakes.counts().unfounded == 1
        };
        assert!(!unfounded(Vec2::new(0.05, 0.06), true));
        assert!(unfounded(Vec2::new(0.05, 0.06), false));
        assert!(unfounded(Vec2::new(-0.01, 0.06), true));
        assert!(unfounded(Vec2::new(0.1, 0.0), true));
    }
}

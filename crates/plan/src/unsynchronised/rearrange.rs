//! The last resort if no robot can reach its goal: all unsynchronised robots leave their places. They return in an
//! order in which each robot finds a path.

use super::free_space::FreeSpace;
use lightbots_base::Vec2;

/// Distance that a robot keeps from all others after it has left, as a multiple of the gap. With more than 2, other
/// robots can pass between.
const APART: f64 = 2.1;

/// Robots that drive one after the other (the movers), and the discs among which they drive.
pub(super) struct Rearrangement<'a> {
    pub space: &'a FreeSpace<'a>,
    /// Indices of the robots that move.
    pub movers: &'a [usize],
    /// Discs that do not move, stage metres.
    pub standing: &'a [Vec2],
}

impl Rearrangement<'_> {
    /// Returns straight drives in order, `(robot, to)`, that bring all movers from `places[robot]` to places away from
    /// `keep_free`. `None` if a robot finds no path.
    pub fn leave(&self, places: &[Vec2], keep_free: &[Vec2]) -> Option<Vec<(usize, Vec2)>> {
        let room_m = APART * self.space.gap_m;
        let drives =
            self.peel(places, |robot, discs| self.space.path_aside(places[robot], discs, keep_free, room_m))?;
        Some(
            drives
                .into_iter()
                .flat_map(|(robot, path)| path.into_iter().map(move |to| (robot, to)))
                .collect(),
        )
    }

    /// Returns straight drives in order, `(robot, to)`, that bring all movers from `away[robot]` to `goals[robot]`. The
    /// search runs backwards in time: the first robot that could leave its goal arrives there last. `None` if a robot
    /// finds no path.
    pub fn come_back(&self, away: &[Vec2], goals: &[Vec2]) -> Option<Vec<(usize, Vec2)>> {
        let left = self.peel(goals, |robot, discs| self.space.path(goals[robot], away[robot], discs))?;
        let back = left.into_iter().rev().flat_map(|(robot, mut path)| {
            path.pop();
            path.reverse();
            path.push(goals[robot]);
            path.into_iter().map(move |to| (robot, to))
        });
        Some(back.collect())
    }

    /// Moves robots out of `places[robot]` one after the other, always the first robot for which `path(robot, discs)`
    /// finds a path past all others. Returns the robots and their paths in that order; `None` if a robot finds none.
    fn peel(
        &self,
        places: &[Vec2],
        path: impl Fn(usize, &[Vec2]) -> Option<Vec<Vec2>>,
    ) -> Option<Vec<(usize, Vec<Vec2>)>> {
        let mut now = places.to_vec();
        let (mut inside, mut left) = (self.movers.to_vec(), Vec::new());
        while !inside.is_empty() {
            let leaves = |&robot: &usize| {
                let others = self.movers.iter().filter(|&&other| other != robot).map(|&other| now[other]);
                let discs: Vec<Vec2> = others.chain(self.standing.iter().copied()).collect();
                Some((robot, path(robot, &discs)?))
            };
            let (robot, path) = inside.iter().find_map(leaves)?;
            inside.retain(|&other| other != robot);
            now[robot] = *path.last()?;
            left.push((robot, path));
        }
        Some(left)
    }
}

//! Where no robot after the other gets to its goal: all leave, and come back in an order in which each finds its way.

use crate::clear::Floor;
use lightbots_base::Vec2;

/// Those who left stand so many gaps apart from everything: others find a way between them.
const APART: f64 = 2.1;

/// Robots that drive one after the other, and discs that do not move meanwhile.
pub(crate) struct Crowd<'a> {
    pub floor: &'a Floor<'a>,
    /// Indices into what is said of robots.
    pub movers: &'a [usize],
    pub standing: &'a [Vec2],
}

impl Crowd<'_> {
    /// Way-points one after the other, `(robot, to)`, that bring all movers from `places` to where nobody starts or
    /// goes, by `keep_free`.
    pub fn leave(&self, places: &[Vec2], keep_free: &[Vec2]) -> Option<Vec<(usize, Vec2)>> {
        let room_m = APART * self.floor.gap_m;
        let hops =
            self.peel(places, |robot, discs| self.floor.aside(places[robot], discs, keep_free, room_m))?;
        Some(hops.into_iter().flat_map(|(robot, way)| way.into_iter().map(move |to| (robot, to))).collect())
    }

    /// Way-points one after the other that bring all movers from `away` to their goals: backwards in time, as who can
    /// leave its goal first comes there last.
    pub fn come_back(&self, away: &[Vec2], goals: &[Vec2]) -> Option<Vec<(usize, Vec2)>> {
        let left = self.peel(goals, |robot, discs| self.floor.way(goals[robot], away[robot], discs))?;
        let back = left.into_iter().rev().flat_map(|(robot, mut way)| {
            way.pop();
            way.reverse();
            way.push(goals[robot]);
            way.into_iter().map(move |to| (robot, to))
        });
        Some(back.collect())
    }

    /// One mover after the other leaves `places`, whoever finds a way past those who stand there and those who left.
    fn peel(
        &self,
        places: &[Vec2],
        way: impl Fn(usize, &[Vec2]) -> Option<Vec<Vec2>>,
    ) -> Option<Vec<(usize, Vec<Vec2>)>> {
        let mut now = places.to_vec();
        let (mut inside, mut left) = (self.movers.to_vec(), Vec::new());
        while !inside.is_empty() {
            let leaves = |&robot: &usize| {
                let others = self.movers.iter().filter(|&&other| other != robot).map(|&other| now[other]);
                let discs: Vec<Vec2> = others.chain(self.standing.iter().copied()).collect();
                Some((robot, way(robot, &discs)?))
            };
            let (robot, way) = inside.iter().find_map(leaves)?;
            inside.retain(|&other| other != robot);
            now[robot] = *way.last()?;
            left.push((robot, way));
        }
        Some(left)
    }
}

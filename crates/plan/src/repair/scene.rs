//! What the repair must respect: ends of ways, the floor, what stands on it.

use lightbots_base::{Limits, Vec2};
use lightbots_show::Obstacle;

use crate::TransitionProblem;

/// Robots keep this much more than contact wherever their ends allow, metres.
const LEAST_MARGIN_M: f64 = 0.0031;

/// A transition whose assignment is settled.
pub(super) struct Scene {
    /// Where each robot starts, stage metres.
    pub starts: Vec<Vec2>,
    /// Where each robot ends; `None`: it is spare and may end anywhere.
    pub ends: Vec<Option<Vec2>>,
    /// What does not move: obstacles and standing robots.
    pub walls: Vec<Obstacle>,
    /// Half the extents of the rectangle that centres stay in, metres.
    pub inner: Vec2,
    /// What the robots can do.
    pub limits: Limits,
}

impl Scene {
    /// The scene of a problem; `None` where the assignment does not fit it or something is not a number.
    pub fn new(problem: &TransitionProblem, goal_of: &[Option<usize>]) -> Option<Self> {
        if goal_of.len() != problem.starts.len() {
            return None;
        }
        let limits = problem.limits;
        let mut ends = Vec::with_capacity(goal_of.len());
        for goal in goal_of {
            ends.push(match goal {
                Some(goal) => Some(*problem.goals.get(*goal)?),
                None => None,
            });
        }
        let standing = problem.standing.iter().map(|&at| Obstacle::Disc { at, radius_m: limits.radius_m });
        let scene = Self {
            starts: problem.starts.clone(),
            ends,
            walls: problem.obstacles.iter().copied().chain(standing).collect(),
            inner: problem.half_floor - Vec2::new(limits.radius_m, limits.radius_m),
            limits,
        };
        let places = scene.starts.iter().chain(scene.ends.iter().flatten());
        let sane = limits.speed_mps > 0.0 && limits.accel_mps2 > 0.0 && limits.radius_m > 0.0;
        (sane && scene.inner.x > 0.0 && scene.inner.y > 0.0 && places.copied().all(Vec2::is_finite))
            .then_some(scene)
    }

    /// How many robots.
    pub fn robots(&self) -> usize {
        self.starts.len()
    }

    /// How far two robots' ends let them stay apart all the way, metres.
    pub fn ends_apart(&self, a: usize, b: usize) -> f64 {
        let before = self.starts[a].distance(self.starts[b]);
        match (self.ends[a], self.ends[b]) {
            (Some(one), Some(other)) => before.min(one.distance(other)),
            _ => before,
        }
    }

    /// The centre distance two robots must keep, metres.
    pub fn least_gap(&self, a: usize, b: usize) -> f64 {
        self.widest_gap_m().min(self.ends_apart(a, b) - 1e-6)
    }

    /// The most of any two's, metres: who is farther apart keeps it whoever they are.
    pub fn widest_gap_m(&self) -> f64 {
        self.limits.contact_m() + LEAST_MARGIN_M
    }

    /// How far a robot's ends let it stay off a wall, at most `wish`, metres.
    pub fn wall_gap(&self, robot: usize, wall: usize, wish: f64) -> f64 {
        let at = |place| self.off_wall(wall, place).0;
        let end = self.ends[robot].map_or(wish, at);
        wish.min(at(self.starts[robot])).min(end)
    }

    /// The gap between a robot's rim at `place` and a wall, and the direction away from it.
    pub fn off_wall(&self, wall: usize, place: Vec2) -> (f64, Vec2) {
        let (gap, away) = off_shape(&self.walls[wall], place);
        (gap - self.limits.radius_m, away)
    }

    /// Whether a robot at `place` is on the floor and `margin_m` off every wall.
    pub fn is_free(&self, place: Vec2, margin_m: f64) -> bool {
        let on_floor = place.x.abs() <= self.inner.x && place.y.abs() <= self.inner.y;
        on_floor && (0..self.walls.len()).all(|wall| self.off_wall(wall, place).0 >= margin_m)
    }

    /// Whether a robot may drive straight from one place to another, `margin_m` off every wall except where an end
    /// itself is closer.
    pub fn is_way_free(&self, from: Vec2, to: Vec2, margin_m: f64) -> bool {
        let samples = (from.distance(to) / 0.01).min(4000.0) as usize + 1;
        (0..self.walls.len()).all(|wall| {
            let ends = self.off_wall(wall, from).0.min(self.off_wall(wall, to).0);
            let margin = margin_m.min(ends - 1e-9);
            (1..samples).all(|i| self.off_wall(wall, from.lerp(to, i as f64 / samples as f64)).0 >= margin)
        })
    }

    /// The nearest place on the floor for a robot, which may be as far out as its own ends are.
    pub fn on_floor(&self, robot: usize, place: Vec2) -> Vec2 {
        if place.x.abs() <= self.inner.x && place.y.abs() <= self.inner.y {
            return place;
        }
        let (start, end) = (self.starts[robot], self.ends[robot].unwrap_or(Vec2::ZERO));
        let x = self.inner.x.max(start.x.abs()).max(end.x.abs());
        let y = self.inner.y.max(start.y.abs()).max(end.y.abs());
        Vec2::new(place.x.clamp(-x, x), place.y.clamp(-y, y))
    }
}

/// Distance from a place to a shape's rim, negative inside, and the unit vector away from it.
fn off_shape(shape: &Obstacle, place: Vec2) -> (f64, Vec2) {
    match *shape {
        Obstacle::Disc { at, radius_m } => {
            let out = place - at;
            (out.length() - radius_m, out.normalized().unwrap_or(Vec2::new(1.0, 0.0)))
        }
        Obstacle::Rect { min, max } => {
            let nearest = Vec2::new(place.x.max(min.x).min(max.x), place.y.max(min.y).min(max.y));
            if let Some(away) = (place - nearest).normalized() {
                return (place.distance(nearest), away);
            }
            let sides = [
                (place.x - min.x, Vec2::new(-1.0, 0.0)),
                (max.x - place.x, Vec2::new(1.0, 0.0)),
                (place.y - min.y, Vec2::new(0.0, -1.0)),
                (max.y - place.y, Vec2::new(0.0, 1.0)),
            ];
            let nearest = sides.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
            nearest.map_or((0.0, Vec2::new(1.0, 0.0)), |(depth, away)| (-depth, away))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rectangle_is_left_by_its_nearest_side() {
        let shape = Obstacle::Rect { min: Vec2::ZERO, max: Vec2::new(1.0, 2.0) };
        assert_eq!(off_shape(&shape, Vec2::new(0.9, 1.0)).1, Vec2::new(1.0, 0.0));
        assert!((off_shape(&shape, Vec2::new(0.9, 1.0)).0 + 0.1).abs() < 1e-12);
        assert_eq!(off_shape(&shape, Vec2::new(0.5, -0.25)), (0.25, Vec2::new(0.0, -1.0)));
        assert!((off_shape(&shape, Vec2::new(4.0, 6.0)).0 - 5.0).abs() < 1e-12);
    }
}

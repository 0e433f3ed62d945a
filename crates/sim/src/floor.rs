//! The floor: its edge, which acts as a wall, and no-go areas.

use lightbots_base::Vec2;
use lightbots_base::shape::nearest_in_rect;
use lightbots_show::{Obstacle, Stage};

/// The floor's edge and the no-go areas, as obstacles for discs that all have one radius.
#[derive(Clone, Debug)]
pub(crate) struct Floor {
    /// Largest absolute coordinates of a robot's centre, metres: half the floor minus the robot's radius, or more if a
    /// start is farther out.
    half: Vec2,
    radius_m: f64,
    obstacles: Vec<Obstacle>,
}

/// What a disc touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FloorObject {
    /// The wall around the floor: its edge.
    Edge,
    /// A no-go area, by its index in the stage, counted from 0.
    Obstacle(usize),
}

impl Floor {
    /// The floor of a stage. A start outside the floor moves the edge out to it, so that the robot is not pushed
    /// inside.
    pub fn new(stage: &Stage, starts: &[Vec2]) -> Self {
        let radius_m = stage.limits.radius_m;
        let half = Vec2::new(0.5 * stage.width_m - radius_m, 0.5 * stage.depth_m - radius_m);
        let half = starts
            .iter()
            .filter(|start| start.is_finite())
            .fold(half, |half, start| Vec2::new(half.x.max(start.x.abs()), half.y.max(start.y.abs())));
        Self { half, radius_m, obstacles: stage.obstacles.clone() }
    }

    /// Moves a disc at `place` out of walls and no-go areas. Returns the last wall or area that it was moved out of,
    /// and by what distance in metres. `None` if the disc was in none.
    #[inline]
    pub fn keep_out(&self, place: &mut Vec2) -> Option<(FloorObject, f64)> {
        let inside = self.inside(*place);
        let mut bump = (inside != *place).then(|| (FloorObject::Edge, inside.distance(*place)));
        *place = inside;
        for (index, obstacle) in self.obstacles.iter().enumerate() {
            if let Some(out) = self.out_of(obstacle, *place) {
                bump = Some((FloorObject::Obstacle(index), out.distance(*place)));
                *place = out;
            }
        }
        bump
    }

    /// The place nearest to `place` at which a disc is inside the floor's edge.
    #[inline]
    fn inside(&self, place: Vec2) -> Vec2 {
        Vec2::new(place.x.clamp(-self.half.x, self.half.x), place.y.clamp(-self.half.y, self.half.y))
    }

    /// Gap from the rim of a disc at `place` to the edge or a no-go area, metres; 0 or less where they touch.
    pub fn off_m(&self, place: Vec2, thing: FloorObject) -> f64 {
        match thing {
            FloorObject::Edge => (self.half.x - place.x.abs()).min(self.half.y - place.y.abs()),
            FloorObject::Obstacle(index) => self.obstacles[index].gap_m(place) - self.radius_m,
        }
    }

    /// The nearest place at which a disc at `place` no longer overlaps an obstacle; `None` if it does not overlap it
    /// now.
    fn out_of(&self, obstacle: &Obstacle, place: Vec2) -> Option<Vec2> {
        let (nearest, reach) = match *obstacle {
            Obstacle::Disc { at, radius_m } => (at, radius_m + self.radius_m),
            Obstacle::Rect { min, max } => (nearest_in_rect(place, min, max), self.radius_m),
        };
        let gap = place - nearest;
        if gap.length_squared() >= reach * reach {
            return None;
        }
        match (gap.normalized(), *obstacle) {
            (Some(normal), _) => Some(nearest + normal * reach),
            (None, Obstacle::Disc { .. }) => Some(nearest + Vec2::new(reach, 0.0)),
            (None, Obstacle::Rect { min, max }) => Some(self.out_of_rect(place, min, max)),
        }
    }

    /// The place to which a disc is moved if its centre is inside a rectangle: there its rim touches the rectangle's
    /// nearest side from outside.
    fn out_of_rect(&self, place: Vec2, min: Vec2, max: Vec2) -> Vec2 {
        let ways = [
            (place.x - min.x, Vec2::new(min.x - self.radius_m, place.y)),
            (max.x - place.x, Vec2::new(max.x + self.radius_m, place.y)),
            (place.y - min.y, Vec2::new(place.x, min.y - self.radius_m)),
            (max.y - place.y, Vec2::new(place.x, max.y + self.radius_m)),
        ];
        ways.iter().fold(ways[0], |best, &way| if way.0 < best.0 { way } else { best }).1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn floor(obstacles: Vec<Obstacle>) -> Floor {
        Floor::new(&Stage { obstacles, ..Stage::default() }, &[])
    }

    fn kept_out(floor: &Floor, x: f64, y: f64) -> (Vec2, Option<FloorObject>) {
        let mut place = Vec2::new(x, y);
        let bump = floor.keep_out(&mut place);
        (place, bump.map(|bump| bump.0))
    }

    #[test]
    fn a_robot_stands_a_radius_from_the_wall() {
        assert_eq!(kept_out(&floor(vec![]), 1.6, 0.0), (Vec2::new(1.473, 0.0), Some(FloorObject::Edge)));
        assert_eq!(kept_out(&floor(vec![]), 1.4, -0.3), (Vec2::new(1.4, -0.3), None));
    }

    #[test]
    fn obstacles_push_out_by_the_shortest_way() {
        let disc = floor(vec![Obstacle::Disc { at: Vec2::ZERO, radius_m: 0.1 }]);
        let (place, bump) = kept_out(&disc, 0.0, 0.12);
        assert!((place - Vec2::new(0.0, 0.127)).length() < 1e-12 && bump == Some(FloorObject::Obstacle(0)));
        let rect = floor(vec![Obstacle::Rect { min: Vec2::ZERO, max: Vec2::new(1.0, 0.5) }]);
        assert_eq!(kept_out(&rect, 0.5, 0.45).0, Vec2::new(0.5, 0.527));
        assert_eq!(kept_out(&rect, 0.5, 0.6), (Vec2::new(0.5, 0.6), None));
    }

    #[test]
    fn a_robot_that_starts_outside_may_stay_there() {
        let floor = Floor::new(&Stage::default(), &[Vec2::new(1.49, 0.0)]);
        assert_eq!(kept_out(&floor, 1.49, 0.0).1, None);
    }
}

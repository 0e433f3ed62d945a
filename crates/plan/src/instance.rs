//! One transition with a given assignment, in the form that solvers use: starts, ends, floor and walls.

use lightbots_base::shape::nearest_in_rect;
use lightbots_base::{Limits, Vec2};
use lightbots_show::Obstacle;

use crate::TransitionProblem;
use crate::cancel::Cancel;
use crate::margins::{EDGE_M, SPLINE_M};

/// A transition with a given assignment.
pub(crate) struct Instance<'a> {
    /// Cancellation of the search.
    pub cancel: Cancel<'a>,
    /// `[robot]`: its start, stage metres.
    pub starts: Vec<Vec2>,
    /// `[robot]`: its end, stage metres; `None` if the robot is spare and may end anywhere.
    pub ends: Vec<Option<Vec2>>,
    /// Obstacles and standing robots.
    pub walls: Vec<Obstacle>,
    /// Half the extents, metres, of the rectangle in which centres of robots stay: half the floor less a robot's
    /// radius.
    pub inner: Vec2,
    /// Distance that rims keep from the floor's edge, metres. A robot that starts or ends closer to the edge need not
    /// keep it.
    pub off_edge_m: f64,
    /// Limits of the robots.
    pub limits: Limits,
}

impl Instance<'_> {
    /// The instance of a problem with the assignment `goal_of[robot]`. `None` if the assignment does not fit the
    /// problem, or a place is not finite. `None` also if the robots' speed, acceleration or radius is not positive, or
    /// the floor is not wider and deeper than a robot.
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
        assert_eq!(ends.len(), problem.starts.len(), "each robot has an end or is spare");
        let standing = problem.standing.iter().map(|&at| Obstacle::Disc { at, radius_m: limits.radius_m });
        let mut instance = Self {
            cancel: Cancel::NEVER,
            starts: problem.starts.clone(),
            ends,
            walls: problem.obstacles.iter().copied().chain(standing).collect(),
            inner: problem.half_floor - Vec2::new(limits.radius_m, limits.radius_m),
            off_edge_m: EDGE_M,
            limits,
        };
        instance.off_edge_m = instance.room_at_edge_m();
        let places = instance.starts.iter().chain(instance.ends.iter().flatten());
        let sane = limits.speed_mps > 0.0 && limits.accel_mps2 > 0.0 && limits.radius_m > 0.0;
        (sane && instance.inner.x > 0.0 && instance.inner.y > 0.0 && places.copied().all(Vec2::is_finite))
            .then_some(instance)
    }

    /// Number of robots.
    pub fn robots(&self) -> usize {
        self.starts.len()
    }

    /// Distance between the starts of robots `a` and `b`, or between their ends if that is smaller, metres. If one of
    /// them is spare, only the starts count.
    pub fn ends_apart(&self, a: usize, b: usize) -> f64 {
        let before = self.starts[a].distance(self.starts[b]);
        match (self.ends[a], self.ends[b]) {
            (Some(one), Some(other)) => before.min(one.distance(other)),
            _ => before,
        }
    }

    /// Distance that the centres of robots `a` and `b` must keep, metres. It is [`Self::widest_gap_m`], or 1 µm less
    /// than the distance of their starts or ends if these are closer.
    pub fn least_gap(&self, a: usize, b: usize) -> f64 {
        self.widest_gap_m().min(self.ends_apart(a, b) - 1e-6)
    }

    /// Distance that two centres must keep, metres, unless their starts or ends are closer. Pairs that are farther
    /// apart need no further check.
    pub fn widest_gap_m(&self) -> f64 {
        self.limits.contact_m() + SPLINE_M
    }

    /// Distance that a robot's rim must keep from a wall, metres: `wish`, or the distance at the robot's start or end
    /// if that is smaller. It is negative if the robot overlaps the wall at its start or end.
    pub fn wall_gap(&self, robot: usize, wall: usize, wish: f64) -> f64 {
        let at = |place| self.off_wall(wall, place).0;
        let end = self.ends[robot].map_or(wish, at);
        wish.min(at(self.starts[robot])).min(end)
    }

    /// Gap between the rim of a robot at `place` and a wall, metres, negative if they overlap, and the unit vector away
    /// from the wall.
    pub fn off_wall(&self, wall: usize, place: Vec2) -> (f64, Vec2) {
        let (gap, away) = off_shape(&self.walls[wall], place);
        (gap - self.limits.radius_m, away)
    }

    /// Whether a robot at `place` is wholly on the floor, with its rim at least `margin_m` from every wall, metres.
    pub fn is_free(&self, place: Vec2, margin_m: f64) -> bool {
        let on_floor = place.x.abs() <= self.inner.x && place.y.abs() <= self.inner.y;
        on_floor && (0..self.walls.len()).all(|wall| self.off_wall(wall, place).0 >= margin_m)
    }

    /// Whether a robot can drive straight from one place to another with its rim `margin_m` from every wall, metres. If
    /// the robot is closer to a wall at an end of the line, the line only has to keep that smaller distance. The line
    /// is sampled in steps of at most 10 mm, or in 4,000 steps if it is longer than 40 m. The floor's edge is not
    /// checked.
    pub fn is_way_free(&self, from: Vec2, to: Vec2, margin_m: f64) -> bool {
        let samples = (from.distance(to) / 0.01).min(4000.0) as usize + 1;
        (0..self.walls.len()).all(|wall| {
            let ends = self.off_wall(wall, from).0.min(self.off_wall(wall, to).0);
            let margin = margin_m.min(ends - 1e-9);
            (1..samples).all(|i| self.off_wall(wall, from.lerp(to, i as f64 / samples as f64)).0 >= margin)
        })
    }

    /// Returns the value of `off_edge_m`: [`EDGE_M`] if there is room. It is less if otherwise a robot would not fit
    /// between a wall and the edge, or two robots side by side on the floor. Gaps that are too narrow even for distance
    /// 0 do not count.
    fn room_at_edge_m(&self) -> f64 {
        let least_m = 2.0 * self.limits.radius_m + SPLINE_M;
        let gaps = self.walls.iter().flat_map(|wall| self.off_edges(wall)).map(|gap_m| gap_m - least_m);
        let abreast = |room_m: f64| [room_m, room_m - self.widest_gap_m() / 2.0];
        let to_spare = gaps.chain([self.inner.x, self.inner.y].into_iter().flat_map(abreast));
        to_spare.filter(|&room_m| room_m >= 0.0).fold(EDGE_M, f64::min)
    }

    /// Distances of a shape from the left, right, lower and upper edge of the floor, metres.
    fn off_edges(&self, shape: &Obstacle) -> [f64; 4] {
        let (min, max) = match *shape {
            Obstacle::Disc { at, radius_m } => {
                (at - Vec2::new(radius_m, radius_m), at + Vec2::new(radius_m, radius_m))
            }
            Obstacle::Rect { min, max } => (min, max),
        };
        let half = self.inner + Vec2::new(self.limits.radius_m, self.limits.radius_m);
        [min.x + half.x, half.x - max.x, min.y + half.y, half.y - max.y]
    }

    /// Returns the place nearest to `place` at which the robot's rim is at least `off_edge_m` metres from the floor's
    /// edge. A robot with a start or end closer to the edge may be as close to the edge as that start or end.
    pub fn on_floor(&self, robot: usize, place: Vec2, off_edge_m: f64) -> Vec2 {
        let room = self.inner - Vec2::new(off_edge_m, off_edge_m);
        if place.x.abs() <= room.x && place.y.abs() <= room.y {
            return place;
        }
        let start = self.starts[robot];
        let end = self.ends[robot].unwrap_or(start);
        let within =
            |at: f64, room: f64, (a, b): (f64, f64)| at.clamp(a.min(b).min(-room), a.max(b).max(room));
        Vec2::new(within(place.x, room.x, (start.x, end.x)), within(place.y, room.y, (start.y, end.y)))
    }
}

/// Returns the distance of a place from a shape's rim, metres (negative inside), and the unit vector away from the
/// shape.
fn off_shape(shape: &Obstacle, place: Vec2) -> (f64, Vec2) {
    match *shape {
        Obstacle::Disc { at, radius_m } => {
            let out = place - at;
            (out.length() - radius_m, out.normalized().unwrap_or(Vec2::new(1.0, 0.0)))
        }
        Obstacle::Rect { min, max } => {
            let nearest = nearest_in_rect(place, min, max);
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

    /// An instance of one robot on a floor of this half size.
    fn instance(
        start: (f64, f64),
        end: (f64, f64),
        obstacles: Vec<Obstacle>,
        half: Vec2,
    ) -> Instance<'static> {
        let at = |(x, y)| vec![Vec2::new(x, y)];
        let floor = TransitionProblem::on_floor(half, Limits::ELISA_3);
        let problem = TransitionProblem { starts: at(start), goals: at(end), obstacles, ..floor };
        Instance::new(&problem, &[Some(0)]).unwrap()
    }

    #[test]
    fn places_are_brought_off_each_side_but_for_ends_there() {
        let half = Vec2::new(0.527, 0.527);
        let instance = instance((-0.499, 0.2), (0.0, 0.51), Vec::new(), half);
        let moved = |x: f64, y: f64| instance.on_floor(0, Vec2::new(x, y), 0.003);
        assert_eq!(moved(-0.4999, -0.4999), Vec2::new(-0.499, -0.497));
        assert_eq!(moved(0.499, 0.52), Vec2::new(0.497, 0.51));
        assert_eq!(moved(-0.4985, 0.3), Vec2::new(-0.4985, 0.3));
    }

    #[test]
    fn gaps_to_the_edge_that_are_just_wide_enough_stay_open() {
        let wall = |gap_m: f64| {
            vec![Obstacle::Rect { min: Vec2::new(-0.1, -0.2), max: Vec2::new(0.1, 0.5 - gap_m) }]
        };
        let off_edge_mm = |gap_m: f64, half: Vec2| {
            let room_m = instance((-0.3, 0.0), (0.3, 0.0), wall(gap_m), half).off_edge_m;
            (room_m * 1e5).round() / 1e2
        };
        let half = Vec2::new(0.5, 0.5);
        assert_eq!(off_edge_mm(0.2, half), 3.5);
        assert_eq!(off_edge_mm(0.059, half), 1.9);
        assert_eq!(off_edge_mm(0.056, half), 3.5);
        // Two robots pass each other on a floor that is 114 mm deep, with 1.45 mm to spare on either side.
        assert_eq!(off_edge_mm(0.056, Vec2::new(0.5, 0.057)), 1.45);
    }
}

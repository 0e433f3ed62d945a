//! Moves robots apart that stand too close to each other for a plan, each by a short distance.
//!
//! Two robots that begin a drive close to each other may stay that close on the whole drive. The proof demands only
//! their clearance at the start. After a robot fails in a queue, rows of robots stand rim to rim. Without this module
//! they would touch again and again.

use crate::floor_cells::FloorCells;
use lightbots_base::Vec2;
use lightbots_show::Obstacle;

/// Clearance to which robots are moved apart, metres. It is the 8 mm that the planner keeps if there is space, plus the
/// errors of two position fixes. With less, the next drive has too little clearance. With more, dense robots are moved
/// without need.
pub(crate) const CLEARANCE_M: f64 = 0.010;
/// Clearance below which a drive moves robots apart, metres. It is the least clearance that the planner keeps, 3 mm,
/// plus the errors of two position fixes.
const TOO_CLOSE_M: f64 = 0.006;
/// Largest number of sweeps over all pairs of close robots. A row of twenty robots rim to rim takes a hundred sweeps.
const SWEEPS: usize = 400;
/// A robot that would be moved by less than this stays where it is, metres. A robot follows its path only within 2 mm.
const SHORT_M: f64 = 0.001;
/// Added to [`CLEARANCE_M`] in the sweeps, metres. Sweeps approach their aim only gradually, and with this addition
/// they reach [`CLEARANCE_M`] after finitely many.
const SLACK_M: f64 = 0.000_2;

/// The floor on which robots are moved apart, and what stands on it.
pub(crate) struct Place<'a> {
    /// Half the floor's width and depth, metres.
    pub half_floor: Vec2,
    pub obstacles: &'a [Obstacle],
    /// Centres of discs that do not move, stage metres.
    pub standing: &'a [Vec2],
    pub radius_m: f64,
    pub contact_m: f64,
}

impl Place<'_> {
    /// Returns places near the places in `robots`, in the same order. Robots there have a clearance of about
    /// [`CLEARANCE_M`], and at least [`TOO_CLOSE_M`], to other robots and to standing discs. `None` if no robot was
    /// closer than [`TOO_CLOSE_M`] to another robot or disc, or if one still would be.
    pub fn separated(&self, robots: &[Vec2]) -> Option<Vec<Vec2>> {
        if !self.has_pair_within(robots, self.contact_m + TOO_CLOSE_M) {
            return None;
        }
        let apart_m = self.contact_m + CLEARANCE_M;
        let mut places = robots.to_vec();
        for _ in 0..SWEEPS {
            if !self.push_apart(&mut places, apart_m + SLACK_M) {
                break;
            }
            for (place, from) in places.iter_mut().zip(robots) {
                *place = self.inside(*place, *from);
            }
        }
        for (place, from) in places.iter_mut().zip(robots) {
            if place.distance(*from) < SHORT_M {
                *place = *from;
            }
        }
        (!self.has_pair_within(&places, self.contact_m + TOO_CLOSE_M)).then_some(places)
    }

    /// Whether the centres of two robots, or of a robot and a standing disc, are closer than `apart_m`.
    fn has_pair_within(&self, robots: &[Vec2], apart_m: f64) -> bool {
        let cells = FloorCells::new(robots, self.standing, apart_m);
        let close = |(a, b): (usize, usize)| cells.all[a].distance(cells.all[b]) < apart_m;
        (0..robots.len()).any(|robot| cells.near(robot).any(|other| close((robot, other))))
    }

    /// Moves the robots of each pair with centres closer than `apart_m` away from each other, once, along the line
    /// between the centres. Standing discs do not move. Pairs that are at most half of [`SLACK_M`] too close stay.
    /// Returns whether any robot was moved.
    fn push_apart(&self, robots: &mut [Vec2], apart_m: f64) -> bool {
        let mut cells = FloorCells::new(robots, self.standing, apart_m);
        let mut pushed = false;
        for robot in 0..robots.len() {
            let near: Vec<usize> = cells.near(robot).collect();
            for other in near {
                let (at, there) = (cells.all[robot], cells.all[other]);
                let missing_m = apart_m - at.distance(there);
                if missing_m <= SLACK_M / 2.0 || (other < robot && other < robots.len()) {
                    continue;
                }
                pushed = true;
                // Two robots at one place part in a direction given by the index of the first.
                let away = (at - there).normalized().unwrap_or(Vec2::unit(robot as f64));
                if other < robots.len() {
                    cells.all[robot] += away * (missing_m / 2.0);
                    cells.all[other] -= away * (missing_m / 2.0);
                } else {
                    cells.all[robot] += away * missing_m;
                }
            }
        }
        robots.copy_from_slice(&cells.all[..robots.len()]);
        pushed
    }

    /// Returns `place`, moved inside the floor if it is too close to the edge. A robot that stood at `from` nearer to
    /// the edge may stay that near. If the result is too close to an obstacle, returns `from`.
    fn inside(&self, place: Vec2, from: Vec2) -> Vec2 {
        if place == from {
            return place;
        }
        let most = self.half_floor - Vec2::new(self.radius_m, self.radius_m) * 1.15;
        let keep = |value: f64, from: f64, most: f64| {
            let most = most.max(from.abs());
            value.clamp(-most, most)
        };
        let place = Vec2::new(keep(place.x, from.x, most.x), keep(place.y, from.y, most.y));
        let gap_m = self.radius_m * 1.15;
        let is_in = |obstacle: &Obstacle| match *obstacle {
            Obstacle::Disc { at, radius_m } => place.distance(at) < radius_m + gap_m,
            Obstacle::Rect { min, max } => {
                let nearest = Vec2::new(place.x.clamp(min.x, max.x), place.y.clamp(min.y, max.y));
                place.distance(nearest) < gap_m
            }
        };
        if self.obstacles.iter().any(is_in) { from } else { place }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Distance between the centres of two robots that touch in these tests, metres.
    const CONTACT_M: f64 = 0.0544;

    fn place<'a>(standing: &'a [Vec2], obstacles: &'a [Obstacle]) -> Place<'a> {
        let half_floor = Vec2::new(1.0, 1.0);
        Place { half_floor, obstacles, standing, radius_m: CONTACT_M / 2.0, contact_m: CONTACT_M }
    }

    fn closest_m(places: &[Vec2]) -> f64 {
        let pairs = (0..places.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.map(|(a, b)| places[a].distance(places[b])).fold(f64::MAX, f64::min)
    }

    #[test]
    fn robots_with_clearance_stay_where_they_are() {
        let row: Vec<Vec2> = (0..9).map(|i| Vec2::new(0.062 * f64::from(i), 0.0)).collect();
        assert_eq!(place(&[], &[]).separated(&row), None);
    }

    #[test]
    fn a_row_that_stands_rim_to_rim_behind_a_dead_robot_spreads_away_from_it() {
        let row: Vec<Vec2> = (1..=12).map(|i| Vec2::new(0.0546 * f64::from(i), 0.0)).collect();
        let dead = [Vec2::ZERO];
        let places = place(&dead, &[]).separated(&row).unwrap();
        assert!(closest_m(&places) > CONTACT_M + TOO_CLOSE_M, "{places:?}");
        assert!(places[0].x > CONTACT_M + TOO_CLOSE_M, "{places:?}");
        assert!(places.iter().zip(&row).all(|(to, from)| to.distance(*from) < 0.15), "{places:?}");
    }

    #[test]
    fn robots_at_one_place_part_and_far_ones_do_not_move() {
        let robots = [Vec2::ZERO, Vec2::ZERO, Vec2::new(0.5, 0.5)];
        let places = place(&[], &[]).separated(&robots).unwrap();
        assert!(closest_m(&places) > CONTACT_M + TOO_CLOSE_M);
        assert_eq!(places[2], robots[2]);
    }

    #[test]
    fn no_robot_is_moved_off_the_floor_or_into_an_obstacle() {
        let edge = 1.0 - CONTACT_M / 2.0;
        let robots = [Vec2::new(edge, 0.0), Vec2::new(edge - 0.055, 0.0)];
        let places = place(&[], &[]).separated(&robots).unwrap();
        assert!(places.iter().all(|at| at.x <= edge), "{places:?}");
        let wall = [Obstacle::Rect { min: Vec2::new(0.04, -1.0), max: Vec2::new(1.0, 1.0) }];
        let robots = [Vec2::ZERO, Vec2::new(-0.055, 0.0)];
        let places = place(&[], &wall).separated(&robots).unwrap();
        assert!(places.iter().all(|at| at.x < 0.009), "{places:?}");
    }
}

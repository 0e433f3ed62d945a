//! Chooses the direction in which each robot drives out, and the robots that drive in the same round.
//!
//! The robots are not tested yet: a robot may not stop, or may drive too far. So the lines of robots that drive in one
//! round keep a gap from each other and from all standing robots, along their whole lengths. At any place on its line,
//! a robot meets no other robot. Robots that already stand closer than the gap keep about their distance.

use crate::floor_cells::FloorCells;
use lightbots_base::Vec2;
use lightbots_base::shape::segment_to_segment;
use lightbots_plan::unsynchronised::FreeSpace;
use lightbots_show::Stage;
use std::f64::consts::FRAC_PI_4;

/// How far each robot drives out, metres.
pub(crate) const OUT_M: f64 = 0.05;
/// Least gap between the rims of two robots, wherever they are on their lines, metres. It is twice the 5 mm by which a
/// robot may be off its place and still pass.
const GAP_M: f64 = 0.01;
/// Least gap between a robot's rim and the floor's edge at its goal, metres: the planner's gap at goals, and its
/// rounding.
const EDGE_M: f64 = 0.004;
/// Directions to try, the preferred one first. Unit: eighths of a turn, counter-clockwise from the robot's heading.
/// Ahead, back, left and right come before the diagonals.
const DIRECTIONS: [i32; 8] = [0, 4, 2, 6, 1, 7, 3, 5];
/// Tolerance for two robots that already stand closer than [`GAP_M`], metres: the line of one may come this much closer
/// to the other. Without it, inexact headings would rule out driving away from the other robot.
const NEARER_M: f64 = 0.000_5;
/// Largest number of rounds; more would take minutes. Robots that find no place in these rounds are not tested.
const ROUNDS_MAX: usize = 12;
/// Side of the grid squares in which neighbours of a robot are looked up, metres. Two robots farther apart than this
/// cannot meet on their lines.
const CELL_M: f64 = 0.25;

/// Place and heading of a robot that is to be tested.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TestedRobot {
    /// Its place, stage metres.
    pub at: Vec2,
    /// Its heading in the stage, radians; 0 if it does not report one.
    pub heading: f64,
}

/// Returns `[round][robot]`: the goal of the robot in that round, stage metres; `None` if it stands in that round.
/// Robots without enough free floor have no goal in any round. `standing`: centres of discs of robots that are not
/// tested, stage metres.
pub(crate) fn rounds(stage: &Stage, robots: &[TestedRobot], standing: &[Vec2]) -> Vec<Vec<Option<Vec2>>> {
    let floor = TestFloor::new(stage, robots, standing);
    let mut left: Vec<(usize, Vec<Vec2>)> =
        (0..robots.len()).map(|robot| (robot, floor.free_goals(robot))).collect();
    left.retain(|(_, goals)| !goals.is_empty());
    let mut rounds = Vec::new();
    while !left.is_empty() && rounds.len() < ROUNDS_MAX {
        let mut goals_of: Vec<Option<Vec2>> = vec![None; robots.len()];
        left.retain(|(robot, goals)| {
            goals_of[*robot] = goals.iter().copied().find(|&goal| floor.is_apart(*robot, goal, &goals_of));
            goals_of[*robot].is_none()
        });
        rounds.push(goals_of);
    }
    rounds
}

/// The floor with its obstacles, and what is near each robot.
struct TestFloor<'a> {
    space: FreeSpace<'a>,
    gap_m: f64,
    robots: &'a [TestedRobot],
    /// For each robot, the indices of the other tested robots within [`CELL_M`] of it.
    near: Vec<Vec<usize>>,
    /// For each robot, the centres of standing discs within [`CELL_M`] of it, stage metres.
    near_standing: Vec<Vec<Vec2>>,
}

impl<'a> TestFloor<'a> {
    fn new(stage: &'a Stage, robots: &'a [TestedRobot], standing: &[Vec2]) -> Self {
        let half_floor = Vec2::new(stage.width_m, stage.depth_m) / 2.0;
        let places: Vec<Vec2> = robots.iter().map(|robot| robot.at).collect();
        let cells = FloorCells::new(&places, standing, CELL_M);
        let (mut near, mut near_standing) = (Vec::new(), Vec::new());
        for (robot, at) in places.iter().enumerate() {
            let is_near = |&other: &usize| cells.all[other].distance(*at) < CELL_M;
            let mut around: Vec<usize> = cells.near(robot).filter(is_near).collect();
            around.sort_unstable();
            let discs = around.split_off(around.partition_point(|&other| other < places.len()));
            near.push(around);
            near_standing.push(discs.into_iter().map(|disc| cells.all[disc]).collect());
        }
        Self {
            space: FreeSpace::new(half_floor, &stage.obstacles, &stage.limits),
            gap_m: stage.limits.contact_m() + GAP_M,
            robots,
            near,
            near_standing,
        }
    }

    /// Returns the goals to which a robot can drive while all other robots stand, in the order of [`DIRECTIONS`]. The
    /// robot's line to a goal keeps its gap from the other robots, leads through no obstacle, and ends inside the
    /// floor.
    fn free_goals(&self, robot: usize) -> Vec<Vec2> {
        let TestedRobot { at, heading } = self.robots[robot];
        let goal = |eighths: &i32| at + Vec2::unit(heading + f64::from(*eighths) * FRAC_PI_4) * OUT_M;
        let near = self.near[robot].iter().map(|&other| self.robots[other].at);
        let stands: Vec<Vec2> = near.chain(self.near_standing[robot].iter().copied()).collect();
        let is_free = |goal: &Vec2| {
            let is_clear = stands.iter().all(|&disc| self.are_apart((at, *goal), (disc, disc)));
            is_clear && self.is_inside(*goal) && self.space.clears_obstacles(at, *goal)
        };
        DIRECTIONS.iter().map(goal).filter(is_free).collect()
    }

    fn is_inside(&self, at: Vec2) -> bool {
        let most = self.space.half_floor - Vec2::new(1.0, 1.0) * (self.space.radius_m + EDGE_M);
        at.x.abs() <= most.x && at.y.abs() <= most.y
    }

    /// Whether the line of a robot to `goal` keeps its gap from the lines of robots that already drive in the same
    /// round. `goals_of[robot]`: goal of a robot that drives in the round; `None` if it does not drive yet.
    fn is_apart(&self, robot: usize, goal: Vec2, goals_of: &[Option<Vec2>]) -> bool {
        let at = self.robots[robot].at;
        self.near[robot].iter().all(|&other| {
            goals_of[other].is_none_or(|to| self.are_apart((at, goal), (self.robots[other].at, to)))
        })
    }

    /// Whether two lines keep the gap; each is given by start and end. Robots that already stand closer only have to
    /// keep their present distance, less [`NEARER_M`].
    fn are_apart(&self, one: (Vec2, Vec2), other: (Vec2, Vec2)) -> bool {
        let needed_m = self.gap_m.min(one.0.distance(other.0) - NEARER_M);
        segment_to_segment(one, other) >= needed_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn grid(side: usize, spacing_m: f64) -> Vec<TestedRobot> {
        let centred = |index: usize| (index as f64 - 0.5 * (side as f64 - 1.0)) * spacing_m;
        let place = |index: usize| Vec2::new(centred(index % side), centred(index / side));
        (0..side * side).map(|index| TestedRobot { at: place(index), heading: FRAC_PI_2 }).collect()
    }

    fn driven(rounds: &[Vec<Option<Vec2>>], robot: usize) -> usize {
        rounds.iter().filter(|goals| goals[robot].is_some()).count()
    }

    #[test]
    fn robots_with_room_drive_straight_ahead_together() {
        let robots = grid(4, 0.2);
        let rounds = rounds(&Stage::default(), &robots, &[]);
        assert_eq!(rounds.len(), 1);
        for (robot, goal) in robots.iter().zip(&rounds[0]) {
            assert!(goal.unwrap().distance(robot.at + Vec2::new(0.0, OUT_M)) < 1e-12);
        }
    }

    #[test]
    fn lines_of_a_round_never_come_near_whatever_robots_do_on_them() {
        let contact_m = Stage::default().limits.contact_m();
        for spacing_mm in (56..200).step_by(4) {
            let robots = grid(5, f64::from(spacing_mm) / 1000.0);
            let rounds = rounds(&Stage::default(), &robots, &[]);
            for goals in &rounds {
                let line = |robot: usize| (robots[robot].at, goals[robot].unwrap_or(robots[robot].at));
                for (one, other) in (0..25).flat_map(|one| (0..one).map(move |other| (one, other))) {
                    let moves = goals[one].is_some() || goals[other].is_some();
                    let needed_m =
                        (contact_m + GAP_M).min(robots[one].at.distance(robots[other].at) - NEARER_M);
                    let apart_m = segment_to_segment(line(one), line(other));
                    assert!(!moves || apart_m >= needed_m, "{spacing_mm} mm: {apart_m}");
                }
            }
            let most = (0..25).map(|robot| driven(&rounds, robot)).max();
            assert!(most <= Some(1), "no robot is tested twice");
            let tested = (0..25).filter(|&robot| driven(&rounds, robot) == 1).count();
            assert!(tested >= 4, "the corners have room outside: {tested} at {spacing_mm} mm");
            assert!(spacing_mm < 92 || tested == 25, "{tested} at {spacing_mm} mm");
        }
    }

    #[test]
    fn robots_in_each_others_way_take_turns() {
        let at = |x, heading| TestedRobot { at: Vec2::new(x, 0.0), heading };
        let facing = [at(-0.08, 0.0), at(0.08, std::f64::consts::PI)];
        let free = rounds(&Stage::default(), &facing, &[]);
        assert_eq!(free.len(), 1, "one of them finds another direction");
        let stage = Stage { depth_m: 0.07, ..Stage::default() };
        let narrow =
            rounds(&stage, &[at(-0.08, 0.0), at(0.08, 0.0)], &[Vec2::new(-0.15, 0.0), Vec2::new(0.15, 0.0)]);
        assert_eq!(narrow.len(), 2, "{narrow:?}");
    }

    #[test]
    fn neither_walls_nor_no_go_areas_nor_strangers_are_driven_into() {
        let stage = Stage { width_m: 1.0, depth_m: 1.0, ..Stage::default() };
        let corner = TestedRobot { at: Vec2::new(0.46, 0.46), heading: FRAC_PI_2 };
        let goal = rounds(&stage, &[corner], &[])[0][0].unwrap();
        assert!(goal.y < 0.42, "back from the wall: {goal:?}");
        let stranger = Vec2::new(0.46, 0.39);
        let goal = rounds(&stage, &[corner], &[stranger])[0][0].unwrap();
        assert!(goal.x < 0.42, "aside: {goal:?}");
        let boxed = Stage { width_m: 0.08, depth_m: 0.08, ..Stage::default() };
        assert!(rounds(&boxed, &[TestedRobot { at: Vec2::ZERO, heading: 0.3 }], &[]).is_empty());
    }
}

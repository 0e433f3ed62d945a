//! The search for an order of straight drives in which no robot meets another.

use super::free_space::FreeSpace;
use super::problem::{DriveStage, UnsynchronisedProblem};
use super::rearrange::Rearrangement;
use super::straight::{StraightDrive, add_yields};
use crate::Path;
use lightbots_base::Vec2;

/// Number of robots for which a detour is searched, or more until one is found. The robot with the cheapest detour
/// drives first.
const DETOURS_TRIED: usize = 12;
/// Cost of each stop on a detour, as metres of path.
const STOP_M: f64 = 0.15;
/// Cost of a detour for each waiting robot that it blocks, as metres of path. A robot at the end of the detour would
/// block the waiting robot's straight line.
const BLOCKS_M: f64 = 0.3;
/// Side of a grid cell in the search for paths through narrow gaps, metres.
const FINE_CELL_M: f64 = 0.012;

/// The state of the search for an order.
pub(super) struct Order<'a, 'b> {
    problem: &'a UnsynchronisedProblem<'b>,
    /// `[robot]`: its place after all drives that have been ordered, stage metres.
    places: Vec<Vec2>,
    /// `[robot]`: whether it is unsynchronised and not at its goal.
    pub waiting: Vec<bool>,
    /// `[robot]`: number of robots, discs and obstacles on its straight line to its goal. Obstacles count as one. Up to
    /// date only while the robot waits.
    blockers: Vec<usize>,
    /// `[robot]`: number of waiting robots with a straight line that the robot would block if it stood at its own goal.
    blocked: Vec<usize>,
    /// Drives of the current stage, in order.
    drives: Vec<StraightDrive>,
    /// Finished stages.
    stages: Vec<DriveStage>,
}

impl<'a, 'b> Order<'a, 'b> {
    /// Begins the search, with no drive ordered yet.
    pub fn new(problem: &'a UnsynchronisedProblem<'b>) -> Self {
        let mut order = Self {
            problem,
            places: problem.starts.to_vec(),
            waiting: Vec::new(),
            blockers: Vec::new(),
            blocked: Vec::new(),
            drives: Vec::new(),
            stages: Vec::new(),
        };
        order.look_around();
        order
    }

    /// Counts anew which robots wait, and what blocks each straight line.
    fn look_around(&mut self) {
        let robots = 0..self.places.len();
        let waits =
            |robot| self.problem.unsynchronised[robot] && self.places[robot] != self.problem.goals[robot];
        self.waiting = robots.clone().map(waits).collect();
        self.blockers = robots.clone().map(|robot| self.count_blockers(robot)).collect();
        self.blocked = robots.map(|robot| self.count_blocked(robot)).collect();
    }

    fn count_blockers(&self, robot: usize) -> usize {
        let (from, to) = (self.places[robot], self.problem.goals[robot]);
        let space = &self.problem.space;
        let fixed = self.problem.standing.iter().filter(|&&disc| !space.clears_disc(from, to, disc)).count();
        let robots = (0..self.places.len()).filter(|&other| self.blocks(robot, other)).count();
        fixed + robots + usize::from(!space.clears_obstacles(from, to))
    }

    fn count_blocked(&self, robot: usize) -> usize {
        (0..self.places.len()).filter(|&other| self.waiting[other] && self.would_block(robot, other)).count()
    }

    /// Whether robot `other`, at its present place, blocks the straight line of `robot` to its goal.
    fn blocks(&self, robot: usize, other: usize) -> bool {
        let (space, goal) = (&self.problem.space, self.problem.goals[robot]);
        let at = self.places[other];
        // If robot `other` must still leave its place, it needs the gap too: no robot may stop closer to it.
        let near = at != self.problem.goals[other] && goal.distance(at) < space.gap_m;
        other != robot && (near || !space.clears_disc(self.places[robot], goal, at))
    }

    /// Whether `robot`, once at its goal, would block the straight line of robot `other` to the goal of `other`.
    fn would_block(&self, robot: usize, other: usize) -> bool {
        let goals = self.problem.goals;
        other != robot && !self.problem.space.clears_disc(self.places[other], goals[other], goals[robot])
    }

    /// Returns the robot that drives next, straight to its goal; `None` if there is none. Its line must be clear, and
    /// its goal must block no other line. Of all such robots, it has the longest line.
    pub fn next(&self) -> Option<usize> {
        let is_free = |&robot: &usize| self.waiting[robot] && self.blockers[robot] + self.blocked[robot] == 0;
        let way_m = |robot: usize| self.places[robot].distance(self.problem.goals[robot]);
        let shorter = |a: &usize, b: &usize| way_m(*a).total_cmp(&way_m(*b)).then(b.cmp(a));
        (0..self.places.len()).filter(is_free).max_by(shorter)
    }

    /// Adds a straight drive of a robot to `to`, and updates the counts.
    pub fn go(&mut self, robot: usize, to: Vec2) {
        let others = |order: &Self| -> Vec<usize> {
            (0..order.places.len()).filter(|&other| other != robot && order.waiting[other]).collect()
        };
        for other in others(self) {
            self.blockers[other] -= usize::from(self.blocks(other, robot));
        }
        if self.waiting[robot] {
            for other in (0..self.places.len()).filter(|&other| other != robot) {
                self.blocked[other] -= usize::from(self.would_block(other, robot));
            }
        }
        self.drives.push(StraightDrive::new(robot, self.places[robot], to));
        self.places[robot] = to;
        self.waiting[robot] = to != self.problem.goals[robot];
        for other in others(self) {
            self.blockers[other] += usize::from(self.blocks(other, robot));
        }
        if self.waiting[robot] {
            for other in (0..self.places.len()).filter(|&other| other != robot) {
                self.blocked[other] += usize::from(self.would_block(other, robot));
            }
            self.blockers[robot] = self.count_blockers(robot);
        }
    }

    /// Adds drives by which all unsynchronised robots leave their places, so that others can pass. With `return_too`,
    /// they then drive to their goals. `None` if no such drives are found.
    pub fn clear_out(&mut self, return_too: bool) -> Option<()> {
        let UnsynchronisedProblem { space, goals, unsynchronised, standing, .. } = self.problem;
        let (movers, others): (Vec<usize>, Vec<usize>) =
            (0..self.places.len()).partition(|&robot| unsynchronised[robot]);
        let discs: Vec<Vec2> =
            others.into_iter().map(|robot| self.places[robot]).chain(standing.iter().copied()).collect();
        let keep_free: Vec<Vec2> = self.places.iter().chain(*goals).copied().collect();
        let space = FreeSpace { cell_m: FINE_CELL_M, ..*space };
        let rearrangement = Rearrangement { space: &space, movers: &movers, standing: &discs };
        rearrangement.leave(&self.places, &keep_free)?.into_iter().for_each(|(robot, to)| self.go(robot, to));
        if return_too {
            rearrangement
                .come_back(&self.places, goals)?
                .into_iter()
                .for_each(|(robot, to)| self.go(robot, to));
        }
        Some(())
    }

    /// Adds the stage in which the synchronised robots drive `paths`, each with the index of its robot.
    pub fn follow(&mut self, paths: Vec<(usize, Path)>) {
        self.end_drives();
        paths.iter().for_each(|(robot, path)| self.places[*robot] = path.as_ref().end());
        self.stages.push(DriveStage::Routes(paths));
        self.look_around();
    }

    fn end_drives(&mut self) {
        let mut drives = std::mem::take(&mut self.drives);
        if !drives.is_empty() {
            add_yields(&mut drives, self.problem.space.gap_m);
            self.stages.push(DriveStage::Targets(drives));
        }
    }

    /// Ends the search, and returns all stages.
    pub fn finish(mut self) -> Vec<DriveStage> {
        self.end_drives();
        self.stages
    }

    /// Returns the places of all unsynchronised robots and standing discs, which stand while the synchronised robots
    /// drive, stage metres.
    pub fn unsynchronised_and_standing(&self) -> Vec<Vec2> {
        let waiting = (0..self.places.len()).filter(|&robot| self.problem.unsynchronised[robot]);
        waiting.map(|robot| self.places[robot]).chain(self.problem.standing.iter().copied()).collect()
    }

    /// Finds a path around others to a robot's goal, or else a path aside for a robot that stands in the way. Returns
    /// `(robot, waypoints, whether the path is only aside)`; `None` if there is neither.
    pub fn detour(&self) -> Option<(usize, Vec<Vec2>, bool)> {
        let UnsynchronisedProblem { space, goals, unsynchronised, standing, .. } = self.problem;
        let discs_of = |robot: usize| -> Vec<Vec2> {
            let others = (0..self.places.len()).filter(|&other| other != robot);
            others.map(|other| self.places[other]).chain(standing.iter().copied()).collect()
        };
        let has_room = |robot: usize| {
            let near = |other: usize| {
                let stays = self.places[other] == goals[other];
                let needed_m = if stays { 2.0 * space.radius_m } else { space.gap_m };
                other != robot && self.places[other].distance(goals[robot]) < needed_m
            };
            !(0..self.places.len()).any(near)
        };
        let waiting = || (0..self.places.len()).filter(|&robot| self.waiting[robot]);
        let mut best: Option<(f64, usize, Vec<Vec2>)> = None;
        for (tried, robot) in waiting().filter(|&robot| has_room(robot)).enumerate() {
            if best.is_some() && tried >= DETOURS_TRIED {
                break;
            }
            let Some(path) = space.path(self.places[robot], goals[robot], &discs_of(robot)) else { continue };
            let longer_m = length_m(self.places[robot], &path) - self.places[robot].distance(goals[robot]);
            let cost_m = longer_m + STOP_M * (path.len() - 1) as f64 + BLOCKS_M * self.blocked[robot] as f64;
            if best.as_ref().is_none_or(|(least_m, ..)| cost_m < *least_m) {
                best = Some((cost_m, robot, path));
            }
        }
        if let Some((_, robot, path)) = best {
            return Some((robot, path, false));
        }
        let occupies_goal = |robot: &usize| {
            let (robot, at) = (*robot, self.places[*robot]);
            (0..self.places.len()).any(|other| other != robot && goals[other].distance(at) < space.gap_m)
        };
        let all_unsynchronised = (0..self.places.len()).filter(|&robot| unsynchronised[robot]);
        let first = waiting().filter(occupies_goal).chain(all_unsynchronised.filter(occupies_goal));
        for robot in first {
            if let Some(path) = space.path_aside(self.places[robot], &discs_of(robot), goals, space.gap_m) {
                return Some((robot, path, true));
            }
        }
        None
    }
}

fn length_m(from: Vec2, path: &[Vec2]) -> f64 {
    let froms = std::iter::once(&from).chain(path);
    froms.zip(path).map(|(a, b)| a.distance(*b)).sum()
}

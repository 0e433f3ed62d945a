//! Builds a plan, which consists of legs. In a leg, robots follow timed paths, or TARGET-only robots make straight
//! drives. TARGET-only robots understand TARGET and COLOR but no routes.

use crate::frame_cursor::FrameCursor;
use crate::leg::{Leg, LegKind, RobotLeg, Task};
use crate::mapping::Roles;
use crate::plan_request::{PlanProblem, PlanRequest, PlanResult};
use crate::separation;
use crate::surroundings::{Surroundings, surroundings};
use crate::unsure_places::{self, REST_CLEARANCE_M};
use lightbots_base::{Span, Vec2};
use lightbots_plan::unsynchronised::{self, DriveStage, FreeSpace, StraightDrive, UnsynchronisedProblem};
use lightbots_plan::{
    BoundFrame, Cancelled, Infeasible, Path, Transition, TransitionProblem, planned_unless, transition_unless,
};
use lightbots_show::{Frame, Pixel};
use lightbots_wire::MAX_PIECES;
use std::cell::Cell;
use std::sync::Arc;

/// Least clearance between a robot on a pixel and a disc whose place is inferred, metres; with less, the pixel stays
/// dark.
const INFERRED_MARGIN_M: f64 = unsure_places::OFF_M + REST_CLEARANCE_M;
/// Largest number of attempts to plan a frame, each with fewer pixels than the attempt before. If all fail, planning of
/// the frame fails.
const LENIENT_TRIES: usize = 8;

impl PlanRequest {
    /// Makes the plan, however long planning takes: milliseconds for small fleets, seconds for the largest.
    pub fn run(self) -> PlanResult {
        self.run_unless(&|| false)
    }

    /// Like [`run`](Self::run), but planning is cancelled once `is_over` returns `true`. From then on `is_over` must
    /// always return `true`. The planner calls it about every tenth of a second. The result keeps the frames that were
    /// planned before.
    pub fn run_unless(self, is_over: &dyn Fn() -> bool) -> PlanResult {
        let questions = Questions { is_over, asked: Cell::new(0), cancelled_at: Cell::new(None) };
        let is_over = || questions.ask();
        let mut builder = PlanBuilder::new(&self.problem, &is_over);
        let mut failed = None;
        for &at in &self.problem.frames {
            if let Err(why) = builder.frame(at) {
                failed = Some((at.frame, why));
                break;
            }
        }
        PlanResult {
            number: self.number,
            cancelled_at: questions.cancelled_at.get(),
            legs: builder.legs,
            stopped: self.problem.stopped,
            frames: builder.frames,
            dark: builder.dark,
            failed,
            mapping: builder.roles.mapping,
        }
    }
}

/// Counts the planner's checks for cancellation. For equal problems the planner checks at the same points of its work,
/// so the number of a check identifies the point.
struct Questions<'a> {
    is_over: &'a dyn Fn() -> bool,
    asked: Cell<u64>,
    cancelled_at: Cell<Option<u64>>,
}

impl Questions<'_> {
    fn ask(&self) -> bool {
        self.asked.set(self.asked.get() + 1);
        let is_over = (self.is_over)();
        if is_over && self.cancelled_at.get().is_none() {
            self.cancelled_at.set(Some(self.asked.get()));
        }
        is_over
    }
}

/// Builds the legs of a plan, frame after frame.
struct PlanBuilder<'a> {
    problem: &'a PlanProblem,
    is_over: &'a dyn Fn() -> bool,
    places: Vec<Vec2>,
    roles: Roles,
    legs: Vec<Leg>,
    frames: usize,
    dark: Vec<(usize, Vec<u32>)>,
}

impl<'a> PlanBuilder<'a> {
    fn new(problem: &'a PlanProblem, is_over: &'a dyn Fn() -> bool) -> Self {
        let names = problem.robots.iter().map(|robot| robot.id).collect();
        Self {
            problem,
            is_over,
            places: problem.robots.iter().map(|robot| robot.at).collect(),
            roles: Roles::new(names, problem.mapping.clone()),
            legs: Vec::new(),
            frames: 0,
            dark: Vec::new(),
        }
    }

    /// Plans the drive to one frame, and adds its legs to the plan. `Err` holds the reason for a failure, for people.
    fn frame(&mut self, FrameCursor { frame: index, round, pass }: FrameCursor) -> Result<(), String> {
        let show = &self.problem.show;
        let frame = show.frames.get(index).ok_or_else(|| "there is no such frame".to_string())?;
        let identity = frame.identity.unwrap_or(show.identity);
        let contact_m = show.stage.limits.contact_m();
        let near = |discs: &[Vec2], pixel: &Pixel, margin_m: f64| {
            discs.iter().any(|at| at.distance(pixel.at) < contact_m + margin_m)
        };
        let PlanProblem { standing, inferred, .. } = self.problem;
        let blocked = |pixel: &Pixel| {
            near(standing, pixel, REST_CLEARANCE_M) || near(inferred, pixel, INFERRED_MARGIN_M)
        };
        let apart = self.separate();
        let mut bound = self.roles.bind(frame, identity, &self.places, blocked);
        let plan = self.solve(index, &mut bound)?;
        self.roles.remember(&bound, identity, &plan.goal_of);
        let rests = self.rests(&bound, &plan);
        let legs = if self.problem.has_originals() {
            self.staged(frame, &rests)?
        } else {
            let last = self.synchronised(plan, &rests)?;
            let first = apart.map(|apart| self.synchronised(apart, &rests));
            first.transpose()?.into_iter().chain([last]).collect()
        };
        if !bound.dark.is_empty() {
            self.dark.push((index, bound.dark));
        }
        let last = legs.len() - 1;
        for (number, leg) in legs.into_iter().enumerate() {
            self.legs.push(Leg { frame: index, round, pass, reaches_frame: number == last, ..leg });
        }
        self.places = rests.iter().map(|rest| rest.goal).collect();
        self.frames += 1;
        Ok(())
    }

    /// Plans a drive that moves robots apart that were stopped too close to each other. The frame is then planned from
    /// where this drive ends. `None` if no drive is needed or possible. Only the first frame of a plan for stopped
    /// robots can have one, and only without TARGET-only robots.
    fn separate(&mut self) -> Option<Transition> {
        let PlanProblem { standing, stopped, .. } = self.problem;
        let problem = TransitionProblem::on_stage(&self.problem.show.stage);
        if !stopped || !self.legs.is_empty() || self.problem.has_originals() {
            return None;
        }
        let place = separation::Place {
            half_floor: problem.half_floor,
            obstacles: &problem.obstacles,
            standing,
            radius_m: problem.limits.radius_m,
            contact_m: problem.limits.contact_m(),
        };
        let goals = place.separated(&self.places)?;
        let problem = TransitionProblem {
            starts: self.places.clone(),
            goals: goals.clone(),
            pinned: (0..goals.len()).map(Some).collect(),
            standing: standing.clone(),
            ..problem
        };
        let apart = transition_unless(&problem, self.is_over).ok()?;
        let apart = apart.ok()?;
        self.places = goals;
        Some(apart)
    }

    /// Plans the transition to the frame at `index`. If [`PlanProblem::lenient`] is set, pixels of `bound` that make
    /// the transition infeasible become dark.
    fn solve(&self, index: usize, bound: &mut BoundFrame<'_>) -> Result<Transition, String> {
        let mut tries = LENIENT_TRIES;
        loop {
            let problem = TransitionProblem {
                standing: self.problem.standing.clone(),
                ..TransitionProblem::of_frame(&self.problem.show, index, self.places.clone(), bound)
            };
            let infeasible = match self.planned(&problem)? {
                Ok(plan) => return Ok(plan),
                Err(infeasible) => infeasible,
            };
            tries -= 1;
            if !self.problem.lenient || tries == 0 || infeasible.goals.is_empty() {
                return Err(infeasible.message);
            }
            // Every second conflicting goal is left out: the others may be feasible then.
            let mut out: Vec<usize> = infeasible.goals.iter().copied().skip(1).step_by(2).collect();
            if out.is_empty() {
                out = infeasible.goals;
            }
            out.sort_unstable();
            out.dedup();
            for goal in out.into_iter().rev().filter(|&goal| goal < problem.goals.len()) {
                bound.dark.push(bound.pixels.remove(goal).id);
                bound.pinned.remove(goal);
            }
        }
    }

    /// Plans a transition that keeps away from inferred places by as much as these may be wrong. If there is none,
    /// plans one without that margin.
    fn planned(&self, problem: &TransitionProblem) -> Result<Result<Transition, Infeasible>, String> {
        if let Some(wide) = unsure_places::kept_away_from(problem, &self.problem.inferred)
            && let Ok(plan) = self.prescribed_or_ordinary(&wide)?
        {
            return Ok(Ok(plan));
        }
        self.prescribed_or_ordinary(problem)
    }

    /// Plans the transition with the paths that the show prescribes, if any. If that is infeasible, for example because
    /// of failed robots, plans the transition without prescribed paths.
    fn prescribed_or_ordinary(
        &self,
        problem: &TransitionProblem,
    ) -> Result<Result<Transition, Infeasible>, String> {
        let found = planned_unless(problem, self.is_over).map_err(given_up)?;
        if found.is_ok() || problem.prescribed.is_none() {
            return Ok(found);
        }
        let ordinary = TransitionProblem { prescribed: None, ..problem.clone() };
        planned_unless(&ordinary, self.is_over).map_err(given_up)
    }

    /// Returns for each robot of the plan where it stands when the frame is reached, and its pixel and colour, if it
    /// has one.
    fn rests(&self, bound: &BoundFrame<'_>, plan: &Transition) -> Vec<RobotLeg> {
        let rest = |robot: usize| match plan.goal_of.get(robot).copied().flatten() {
            Some(goal) => {
                let pixel = bound.pixels[goal];
                RobotLeg {
                    goal: pixel.at,
                    pixel: Some(pixel.id),
                    color: pixel.color,
                    ..RobotLeg::stay(pixel.at)
                }
            }
            None => {
                RobotLeg::stay(plan.paths.get(robot).map_or(self.places[robot], |path| path.as_ref().end()))
            }
        };
        (0..self.places.len()).map(rest).collect()
    }

    /// Plans the legs to a frame if TARGET-only robots take part: legs of TARGETs and legs of routes.
    fn staged(&self, frame: &Frame, rests: &[RobotLeg]) -> Result<Vec<Leg>, String> {
        let stage = &self.problem.show.stage;
        let goals: Vec<Vec2> = rests.iter().map(|rest| rest.goal).collect();
        let original: Vec<bool> = self.problem.robots.iter().map(|robot| robot.original).collect();
        let space =
            FreeSpace::new(Vec2::new(stage.width_m, stage.depth_m) / 2.0, &stage.obstacles, &stage.limits);
        let starts = &self.places;
        let problem = UnsynchronisedProblem {
            space,
            starts,
            goals: &goals,
            unsynchronised: &original,
            standing: &self.problem.standing,
        };
        let drivers: Vec<usize> = (0..starts.len()).filter(|&robot| !original[robot]).collect();
        let drive = |standing: &[Vec2]| self.drive(frame, &drivers, &goals, standing);
        let stages = unsynchronised::stages(&problem, drive)
            .ok_or("robots that only know TARGET cannot be brought there one after the other")?;
        let mut legs = Vec::new();
        let mut places = starts.clone();
        for stage in stages {
            let mut leg = match stage {
                DriveStage::Targets(drives) => self.targets(drives, rests),
                DriveStage::Routes(paths) => {
                    let duration = paths.first().map_or(Span::ZERO, |(_, path)| path.as_ref().duration());
                    let originals = places.iter().zip(&original).filter(|(_, original)| **original);
                    let mut standing = self.problem.standing.clone();
                    standing.extend(originals.map(|(at, _)| *at));
                    self.routes(paths, rests, duration, (None, &standing))?
                }
            };
            for (robot, place) in self.problem.robots.iter().zip(&mut places) {
                let step = &mut leg.robots[robot.participant];
                match step.task {
                    Task::Stay => (step.settles, step.goal) = (step.goal == *place, *place),
                    _ => *place = step.goal,
                }
            }
            legs.push(leg);
        }
        if legs.is_empty() {
            legs.push(self.targets(Vec::new(), rests));
        }
        Ok(legs)
    }

    /// Plans the paths of `drivers`, the robots that follow routes, while TARGET-only robots stand. `None` if there is
    /// no plan.
    fn drive(
        &self,
        frame: &Frame,
        drivers: &[usize],
        goals: &[Vec2],
        standing: &[Vec2],
    ) -> Option<Vec<(usize, Path)>> {
        let problem = TransitionProblem {
            starts: drivers.iter().map(|&robot| self.places[robot]).collect(),
            goals: drivers.iter().map(|&robot| goals[robot]).collect(),
            pinned: (0..drivers.len()).map(Some).collect(),
            standing: standing.to_vec(),
            ..TransitionProblem::timed_as(&self.problem.show.stage, frame)
        };
        let plan = self.planned(&problem).ok()?.ok()?;
        Some(drivers.iter().copied().zip(plan.paths).collect())
    }

    /// Returns the leg of a transition in which all robots follow paths.
    fn synchronised(&self, plan: Transition, rests: &[RobotLeg]) -> Result<Leg, String> {
        let closest_m = plan.closest.map_or(f64::INFINITY, |closest| closest.distance_m);
        let room_m = closest_m - self.problem.show.stage.limits.contact_m();
        let around = (Some(room_m), &self.problem.standing[..]);
        self.routes(plan.paths.into_iter().enumerate().collect(), rests, plan.duration, around)
    }

    fn routes(
        &self,
        paths: Vec<(usize, Path)>,
        rests: &[RobotLeg],
        duration: Span,
        (room_m, standing): (Option<f64>, &[Vec2]),
    ) -> Result<Leg, String> {
        if paths.iter().any(|(_, path)| path.pieces.len() > MAX_PIECES) {
            return Err(format!("a path has more than the {MAX_PIECES} pieces a robot can keep"));
        }
        let mut leg = self.leg(LegKind::Routes, rests, paths.len(), duration, room_m.unwrap_or(0.0));
        let contact_m = self.problem.show.stage.limits.contact_m();
        let around = surroundings(&paths, standing, room_m, contact_m);
        for ((robot, path), Surroundings { room_m, neighbours }) in paths.into_iter().zip(around) {
            let goal = path.as_ref().end();
            let step = &mut leg.robots[self.problem.robots[robot].participant];
            let settles = goal == step.goal;
            *step = RobotLeg { task: Task::Path(path), room_m, neighbours, goal, settles, ..step.clone() };
        }
        Ok(leg)
    }

    fn targets(&self, mut drives: Vec<StraightDrive>, rests: &[RobotLeg]) -> Leg {
        let mut leg =
            self.leg(LegKind::Targets, rests, 0, Span::from_secs(unsynchronised::expected_s(&drives)), 0.0);
        for drive in &mut drives {
            let settles = rests[drive.robot].goal == drive.to;
            drive.robot = self.problem.robots[drive.robot].participant;
            let step = &mut leg.robots[drive.robot];
            leg.drivers += usize::from(matches!(step.task, Task::Stay));
            *step = RobotLeg { task: Task::Drives, goal: drive.to, settles, ..step.clone() };
        }
        Leg { drives, ..leg }
    }

    /// Returns a leg in which all robots stand; the caller adds paths or straight drives.
    fn leg(&self, kind: LegKind, rests: &[RobotLeg], drivers: usize, duration: Span, room_m: f64) -> Leg {
        let mut robots = vec![RobotLeg::stay(Vec2::ZERO); self.problem.participants];
        for (robot, rest) in self.problem.robots.iter().zip(rests) {
            robots[robot.participant] = rest.clone();
        }
        Leg {
            frame: 0,
            round: 0,
            pass: 0,
            seq: 0,
            kind,
            robots,
            drives: Vec::new(),
            drivers,
            duration,
            reaches_frame: false,
            room_m,
            around: Arc::default(),
        }
    }
}

fn given_up(_: Cancelled) -> String {
    "planning took longer than robots may wait".into()
}

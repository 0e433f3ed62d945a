//! Planning, as a job that any thread may run.

use crate::leg::{Leg, LegKind, RobotLeg, Task};
use crate::mapping::{Mapping, Roles};
use crate::separation;
use crate::surroundings::{Surroundings, surroundings};
use lightbots_base::{RobotId, Span, Vec2};
use lightbots_plan::unsynchronised::{self, DriveStage, FreeSpace, StraightDrive, UnsynchronisedProblem};
use lightbots_plan::{
    BoundFrame, Cancelled, Path, Transition, TransitionProblem, planned_unless, transition_unless,
};
use lightbots_show::{Frame, Pixel, Show};
use lightbots_wire::MAX_PIECES;
use std::sync::Arc;

/// A goal closer than this to a disc that does not move cannot be reached, metres more than contact.
const BLOCKED_MARGIN_M: f64 = 0.001;
/// The same for discs whose places are inferred, metres: what others see of a dead robot is off by 5 mm.
const INFERRED_MARGIN_M: f64 = 0.008;
/// How often conflicting pixels are left out before a frame is given up.
const LENIENT_TRIES: usize = 8;

/// A replan may take this long for up to [`FEW`] robots, …
const BUDGET: Span = Span::from_millis(1_000);
/// … and this much longer for each robot more: 5 s for 1,000.
const BUDGET_PER_ROBOT: Span = Span(4_445);
const FEW: usize = 100;

/// A plan to be made. Pure: the same job gives the same answer, wherever it runs.
#[derive(Clone, Debug)]
pub struct PlanRequest {
    pub(crate) number: u64,
    pub(crate) problem: PlanProblem,
}

/// What is to be planned.
#[derive(Clone, Debug)]
pub(crate) struct PlanProblem {
    pub show: Arc<Show>,
    /// Frames in the order they are played, each with the round it belongs to.
    pub frames: Vec<(usize, u32)>,
    pub robots: Vec<PlannedRobot>,
    /// How many seats there are, taken or not.
    pub participants: usize,
    /// Discs that do not move, stage metres.
    pub standing: Vec<Vec2>,
    /// Those of them whose places nobody reported: of silent robots, and of what blocked others.
    pub inferred: Vec<Vec2>,
    pub mapping: Mapping,
    /// Pixels in each other's way are left out rather than the frame given up.
    pub lenient: bool,
    /// Robots were stopped on their way and may stand closer to each other than is ever planned.
    pub stopped: bool,
}

/// A robot that takes part.
#[derive(Clone, Debug)]
pub(crate) struct PlannedRobot {
    pub participant: usize,
    pub id: RobotId,
    /// Where it starts, stage metres.
    pub at: Vec2,
    pub original: bool,
}

/// A plan that was made; give it to [`crate::Controller::planned`].
#[derive(Clone, Debug)]
pub struct PlanResult {
    pub(crate) number: u64,
    pub(crate) legs: Vec<Leg>,
    /// It begins where robots were stopped on their way.
    pub(crate) stopped: bool,
    /// Frames planned.
    pub(crate) frames: usize,
    /// Pixels that stay dark, by frame.
    pub(crate) dark: Vec<(usize, Vec<u32>)>,
    /// The first frame without a plan, and why.
    pub(crate) failed: Option<(usize, String)>,
    pub(crate) mapping: Mapping,
}

impl PlanRequest {
    /// How long it may take while robots wait for it; `None`: they do not. The caller measures that, as there is no clock
    /// in here, and gives the job up with [`run_unless`](Self::run_unless).
    pub fn budget(&self) -> Option<Span> {
        let more = self.problem.robots.len().saturating_sub(FEW);
        self.problem.stopped.then_some(BUDGET + BUDGET_PER_ROBOT * more as i64)
    }

    /// Makes the plan, however long that takes: milliseconds for small fleets, seconds for the largest; never panics.
    pub fn run(self) -> PlanResult {
        self.run_unless(&|| false)
    }

    /// The same, given up as soon as `is_over` says so: it is asked at least every tenth of a second or so, and must go
    /// on saying so. What is planned until then counts.
    pub fn run_unless(self, is_over: &dyn Fn() -> bool) -> PlanResult {
        let mut draft = Draft::new(&self.problem, is_over);
        let mut failed = None;
        for &(frame, round) in &self.problem.frames {
            if let Err(why) = draft.frame(frame, round) {
                failed = Some((frame, why));
                break;
            }
        }
        PlanResult {
            number: self.number,
            legs: draft.legs,
            stopped: self.problem.stopped,
            frames: draft.frames,
            dark: draft.dark,
            failed,
            mapping: draft.roles.mapping,
        }
    }
}

/// A plan being made.
struct Draft<'a> {
    problem: &'a PlanProblem,
    is_over: &'a dyn Fn() -> bool,
    places: Vec<Vec2>,
    roles: Roles,
    legs: Vec<Leg>,
    frames: usize,
    dark: Vec<(usize, Vec<u32>)>,
}

impl<'a> Draft<'a> {
    fn new(problem: &'a PlanProblem, is_over: &'a dyn Fn() -> bool) -> Self {
        let names = problem.robots.iter().map(|rider| rider.id).collect();
        Self {
            problem,
            is_over,
            places: problem.robots.iter().map(|rider| rider.at).collect(),
            roles: Roles::new(names, problem.mapping.clone()),
            legs: Vec::new(),
            frames: 0,
            dark: Vec::new(),
        }
    }

    /// Adds the legs to one frame.
    fn frame(&mut self, index: usize, round: u32) -> Result<(), String> {
        let show = &self.problem.show;
        let frame = show.frames.get(index).ok_or_else(|| "there is no such frame".to_string())?;
        let identity = frame.identity.unwrap_or(show.identity);
        let contact_m = show.stage.limits.contact_m();
        let near = |discs: &[Vec2], pixel: &Pixel, margin_m: f64| {
            discs.iter().any(|at| at.distance(pixel.at) < contact_m + margin_m)
        };
        let PlanProblem { standing, inferred, .. } = self.problem;
        let blocked = |pixel: &Pixel| {
            near(standing, pixel, BLOCKED_MARGIN_M) || near(inferred, pixel, INFERRED_MARGIN_M)
        };
        let apart = self.separate();
        let mut cast = self.roles.cast(frame, identity, &self.places, blocked);
        let plan = self.solve(frame, &mut cast)?;
        self.roles.remember(&cast, identity, &plan.goal_of);
        let rests = self.rests(&cast, &plan);
        let legs = if self.problem.robots.iter().any(|rider| rider.original) {
            self.staged(frame, &rests)?
        } else {
            let room_m = room(&plan, show.stage.limits.contact_m());
            let last = self.routes(numbered(plan.paths), &rests, plan.duration, room_m)?;
            let first = apart.map(|apart| {
                let room_m = room(&apart, show.stage.limits.contact_m());
                self.routes(numbered(apart.paths), &rests, apart.duration, room_m)
            });
            first.transpose()?.into_iter().chain([last]).collect()
        };
        if !cast.dark.is_empty() {
            self.dark.push((index, cast.dark));
        }
        let last = legs.len() - 1;
        for (number, leg) in legs.into_iter().enumerate() {
            self.legs.push(Leg { frame: index, round, reaches_frame: number == last, ..leg });
        }
        self.places = rests.iter().map(|rest| rest.goal).collect();
        self.frames += 1;
        Ok(())
    }

    /// A drive that moves robots apart that were stopped too close to each other, if there are any. The frame is then
    /// planned from its end.
    fn separate(&mut self) -> Option<Transition> {
        let PlanProblem { robots: riders, standing, stopped, .. } = self.problem;
        let problem = self.empty_problem();
        if !stopped || !self.legs.is_empty() || riders.iter().any(|rider| rider.original) {
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

    /// The transition, without the pixels that make it impossible where that is allowed.
    fn solve(&self, frame: &Frame, cast: &mut BoundFrame<'_>) -> Result<Transition, String> {
        let mut tries = LENIENT_TRIES;
        loop {
            let stage = &self.problem.show.stage;
            let problem = TransitionProblem {
                standing: self.problem.standing.clone(),
                ..TransitionProblem::of_frame(stage, frame, self.places.clone(), cast)
            };
            let stuck = match planned_unless(&problem, self.is_over).map_err(given_up)? {
                Ok(plan) => return Ok(plan),
                Err(stuck) => stuck,
            };
            tries -= 1;
            if !self.problem.lenient || tries == 0 || stuck.goals.is_empty() {
                return Err(stuck.message);
            }
            // Every second one of those in each other's way: the others may then do.
            let mut out: Vec<usize> = stuck.goals.iter().copied().skip(1).step_by(2).collect();
            if out.is_empty() {
                out = stuck.goals;
            }
            out.sort_unstable();
            out.dedup();
            for goal in out.into_iter().rev().filter(|&goal| goal < problem.goals.len()) {
                cast.dark.push(cast.pixels.remove(goal).id);
                cast.pinned.remove(goal);
            }
        }
    }

    fn empty_problem(&self) -> TransitionProblem {
        let stage = &self.problem.show.stage;
        let half_floor = Vec2::new(stage.width_m / 2.0, stage.depth_m / 2.0);
        TransitionProblem {
            obstacles: stage.obstacles.clone(),
            ..TransitionProblem::on_floor(half_floor, stage.limits)
        }
    }

    /// `[rider]`: where each stands when the frame is reached, and its light.
    fn rests(&self, cast: &BoundFrame<'_>, plan: &Transition) -> Vec<RobotLeg> {
        let rest = |rider: usize| match plan.goal_of.get(rider).copied().flatten() {
            Some(goal) => {
                let pixel = cast.pixels[goal];
                RobotLeg {
                    goal: pixel.at,
                    pixel: Some(pixel.id),
                    color: pixel.color,
                    ..RobotLeg::stay(pixel.at)
                }
            }
            None => {
                RobotLeg::stay(plan.paths.get(rider).map_or(self.places[rider], |path| path.as_ref().end()))
            }
        };
        (0..self.places.len()).map(rest).collect()
    }

    /// The legs of a frame in which original robots take part.
    fn staged(&self, frame: &Frame, rests: &[RobotLeg]) -> Result<Vec<Leg>, String> {
        let stage = &self.problem.show.stage;
        let goals: Vec<Vec2> = rests.iter().map(|rest| rest.goal).collect();
        let original: Vec<bool> = self.problem.robots.iter().map(|rider| rider.original).collect();
        let half_floor = Vec2::new(stage.width_m / 2.0, stage.depth_m / 2.0);
        let space = FreeSpace::new(half_floor, &stage.obstacles, &stage.limits);
        let starts = &self.places;
        let problem = UnsynchronisedProblem {
            space,
            starts,
            goals: &goals,
            unsynchronised: &original,
            standing: &self.problem.standing,
        };
        let drivers: Vec<usize> = (0..starts.len()).filter(|&rider| !original[rider]).collect();
        let drive = |standing: &[Vec2]| self.drive(frame, &drivers, &goals, standing);
        let stages = unsynchronised::stages(&problem, drive)
            .ok_or("robots that only know TARGET cannot be brought there one after the other")?;
        let mut legs = Vec::new();
        let mut places = starts.clone();
        for stage in stages {
            let mut leg = match stage {
                DriveStage::Targets(hops) => self.targets(hops, rests),
                DriveStage::Routes(paths) => {
                    let duration = paths.first().map_or(Span::ZERO, |(_, path)| path.as_ref().duration());
                    self.routes(paths, rests, duration, 0.0)?
                }
            };
            for (rider, place) in self.problem.robots.iter().zip(&mut places) {
                let step = &mut leg.robots[rider.participant];
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

    /// Paths of the robots that follow paths, while the originals stand.
    fn drive(
        &self,
        frame: &Frame,
        drivers: &[usize],
        goals: &[Vec2],
        standing: &[Vec2],
    ) -> Option<Vec<(usize, Path)>> {
        let problem = TransitionProblem {
            starts: drivers.iter().map(|&rider| self.places[rider]).collect(),
            goals: drivers.iter().map(|&rider| goals[rider]).collect(),
            pinned: (0..drivers.len()).map(Some).collect(),
            standing: standing.to_vec(),
            duration: frame.transition_s.map(Span::from_secs),
            easing: frame.easing,
            ..self.empty_problem()
        };
        let plan = transition_unless(&problem, self.is_over).ok()?.ok()?;
        Some(drivers.iter().copied().zip(plan.paths).collect())
    }

    fn routes(
        &self,
        paths: Vec<(usize, Path)>,
        rests: &[RobotLeg],
        duration: Span,
        room_m: f64,
    ) -> Result<Leg, String> {
        if paths.iter().any(|(_, path)| path.pieces.len() > MAX_PIECES) {
            return Err(format!("a path has more than the {MAX_PIECES} pieces a robot can keep"));
        }
        let mut leg = self.leg(LegKind::Routes, rests, paths.len(), duration, room_m);
        let contact_m = self.problem.show.stage.limits.contact_m();
        let around = surroundings(&paths, &self.problem.standing, room_m, contact_m);
        for ((rider, path), Surroundings { room_m, neighbours }) in paths.into_iter().zip(around) {
            let goal = path.as_ref().end();
            let step = &mut leg.robots[self.problem.robots[rider].participant];
            let settles = goal == step.goal;
            *step = RobotLeg { task: Task::Path(path), room_m, neighbours, goal, settles, ..step.clone() };
        }
        Ok(leg)
    }

    fn targets(&self, mut hops: Vec<StraightDrive>, rests: &[RobotLeg]) -> Leg {
        let mut leg =
            self.leg(LegKind::Targets, rests, 0, Span::from_secs(unsynchronised::expected_s(&hops)), 0.0);
        for hop in &mut hops {
            let settles = rests[hop.robot].goal == hop.to;
            hop.robot = self.problem.robots[hop.robot].participant;
            let step = &mut leg.robots[hop.robot];
            leg.drivers += usize::from(matches!(step.task, Task::Stay));
            *step = RobotLeg { task: Task::Drives, goal: hop.to, settles, ..step.clone() };
        }
        Leg { drives: hops, ..leg }
    }

    /// A leg in which nobody moves yet.
    fn leg(&self, kind: LegKind, rests: &[RobotLeg], drivers: usize, duration: Span, room_m: f64) -> Leg {
        let mut robots = vec![RobotLeg::stay(Vec2::ZERO); self.problem.participants];
        for (rider, rest) in self.problem.robots.iter().zip(rests) {
            robots[rider.participant] = rest.clone();
        }
        Leg {
            frame: 0,
            round: 0,
            seq: 0,
            kind,
            robots,
            drives: Vec::new(),
            drivers,
            duration,
            reaches_frame: false,
            room_m,
        }
    }
}

fn given_up(_: Cancelled) -> String {
    "planning took longer than robots may wait".into()
}

fn numbered(paths: Vec<Path>) -> Vec<(usize, Path)> {
    paths.into_iter().enumerate().collect()
}

fn room(plan: &Transition, contact_m: f64) -> f64 {
    plan.closest.map_or(f64::INFINITY, |closest| closest.distance_m) - contact_m
}

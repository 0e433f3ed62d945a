//! What must hold after each step of a campaign.

use core::fmt;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_control::{Event, EventKind, Trouble};

use super::route_watch::RouteWatch;
use crate::breakdowns::Fate;
use crate::bumps::Bump;
use crate::floor::FloorObject;
use crate::mishap::Mishap;
use crate::robot_set::RobotSet;

/// A robot stands this long after Stop, or after the last message it received (R40 and R43 of docs/protocol.md): its own
/// patience is 2 s, and it brakes within 0.1 s.
const RESTS_AFTER: Span = Span::from_millis(2_200);
/// All is watched for this long after the show is over.
const WATCHED: Span = Span::from_millis(3_500);
/// A robot that dropped out is driven around from this long after: all are held within 0.6 s, and then planned again.
const KNOWN_AFTER: Span = Span::from_millis(1_000);
/// A robot that was put down elsewhere is expected there from this long after: it notices within 0.3 s (R47), reports, and
/// all are held within 0.6 s. Messages may be late and lost.
const EXPECTED_AFTER: Span = Span::from_millis(1_500);
/// Robots that touched and were excused are apart once their rims are at this distance, metres.
const APART_M: f64 = 0.01;
/// A route whose run is gone has ended after this.
const ROUTE_ENDS: Span = Span::from_millis(30_000);
/// Most violations that are kept.
const KEPT: usize = 20;

/// Something that must not happen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// When, after robots were switched on.
    pub at: Instant,
    /// Which invariant, as one word.
    pub invariant: &'static str,
    /// What, for people.
    pub what: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:7.3} s  {}: {}", self.at.as_secs(), self.invariant, self.what)
    }
}

/// What is known of a robot.
#[derive(Clone, Debug)]
struct Watched {
    /// When it received its last message.
    received: Instant,
    /// It has no power, or its wheels are stuck.
    is_broken: bool,
    /// When it dropped out.
    out: Option<Instant>,
    /// There was no plan around all places where it may stand, and the controller gave them up.
    is_place_given_up: bool,
    /// Something happened to it alone, or it knows TARGET only: it may drop out.
    may_drop_out: bool,
    /// It says that it is elsewhere, or shares its name.
    is_false: bool,
    /// When it was put down elsewhere.
    moved: Option<Instant>,
    /// It was seen moving when it should not.
    moves: bool,
}

/// Watches a run.
#[derive(Debug)]
pub(crate) struct Invariants {
    robots: Vec<Watched>,
    /// When the show is to be over.
    limit: Instant,
    /// The frame that stood last.
    reached: Option<usize>,
    /// Frames to which there was no plan.
    given_up: Vec<usize>,
    /// The first and the last frame of the latest loop.
    repeats: Option<(usize, usize)>,
    /// When a person put a foot on the floor.
    stepped: Option<Instant>,
    /// The journal may be older than the run: the disk failed.
    is_journal_old: bool,
    /// When Stop was pressed, or the run ended.
    stopped: Option<Instant>,
    is_over: bool,
    /// Pairs whose contact was excused, and that have not parted.
    together: Vec<(u32, u32)>,
    routes: RouteWatch,
    violations: Vec<Violation>,
}

impl Invariants {
    /// Watches a number of robots whose show is over before `limit`.
    pub fn new(robots: usize, originals: usize, limit: Instant) -> Self {
        let watched = |robot: usize| Watched {
            received: Instant::ZERO,
            is_broken: false,
            out: None,
            is_place_given_up: false,
            may_drop_out: robot + originals >= robots,
            is_false: false,
            moved: None,
            moves: false,
        };
        Self {
            robots: (0..robots).map(watched).collect(),
            reached: None,
            given_up: Vec::new(),
            repeats: None,
            stepped: None,
            is_journal_old: false,
            limit,
            stopped: None,
            is_over: false,
            together: Vec::new(),
            routes: RouteWatch::default(),
            violations: Vec::new(),
        }
    }

    /// Messages are lost at random: every robot may drop out.
    pub fn on_a_bad_link(mut self) -> Self {
        self.robots.iter_mut().for_each(|robot| robot.may_drop_out = true);
        self
    }

    /// What was violated.
    pub fn into_violations(self) -> Vec<Violation> {
        self.violations
    }

    /// Whether nothing is left to watch.
    pub fn are_over(&self, now: Instant) -> bool {
        self.is_over && self.stopped.is_some_and(|at| now - at > WATCHED) || now > self.limit
    }

    /// A controller found no run after a crash: its disk had failed, or the run was over. Robots drive to the end of their
    /// routes at most.
    pub fn run_is_gone(&mut self, now: Instant) {
        if !self.is_over && !self.is_journal_old {
            self.violate(now, "journal", "the run is not found".into());
        }
        self.stopped.get_or_insert(now + ROUTE_ENDS);
        self.is_over = true;
    }

    /// A robot received a message.
    pub fn received(&mut self, robot: usize, now: Instant) {
        self.robots[robot].received = now;
    }

    /// A robot broke down.
    pub fn broke_down(&mut self, robot: usize, fate: Fate) {
        self.robots[robot].is_broken |= matches!(fate, Fate::Killed | Fate::Stuck);
        self.robots[robot].may_drop_out = true;
    }

    /// A mishap came to pass.
    pub fn befell(&mut self, mishap: Mishap, now: Instant) {
        if let Mishap::Off(robot) | Mishap::Moved(robot, _) = mishap {
            self.robots[robot].may_drop_out = true;
        }
        match mishap {
            Mishap::Off(robot) => self.robots[robot].is_broken = true,
            Mishap::On(robot) => self.robots[robot].is_broken = false,
            Mishap::Moved(robot, _) => self.robots[robot].moved = Some(now),
            Mishap::Lies(robot, off) => {
                self.robots[robot].may_drop_out = true;
                self.robots[robot].is_false = off != Vec2::ZERO;
                self.robots[robot].moved = Some(now);
            }
            Mishap::Named(robot, other) => {
                for robot in [robot, other] {
                    (self.robots[robot].may_drop_out, self.robots[robot].is_false) = (true, true);
                }
            }
            Mishap::Person(_) => self.stepped = Some(now),
            Mishap::Floods(robot, _) => self.robots[robot].may_drop_out = true,
            Mishap::DiskFull(_) | Mishap::DiskSlow(..) => self.is_journal_old = true,
            Mishap::Stop | Mishap::Pause | Mishap::Resume | Mishap::ClockSet(_) | Mishap::Sleeps(_) => {}
            Mishap::GoTo(_) | Mishap::Skip | Mishap::Rainbow(_) => {}
        }
    }

    /// An event of the controller.
    pub fn event(&mut self, event: &Event, by_id: &[(RobotId, usize)]) {
        let robot = |id: RobotId| by_id.binary_search_by_key(&id, |entry| entry.0).ok();
        match &event.kind {
            EventKind::Dropout { robot: id, why } => {
                if let Some(place) = robot(*id) {
                    self.dropped_out(event.at, by_id[place].1, *why);
                }
            }
            EventKind::FrameReached { frame, .. } => self.frame_stands(event.at, *frame),
            EventKind::PlanFailed { frame, .. } => {
                self.given_up.push(*frame);
                self.robots.iter_mut().for_each(|robot| robot.is_place_given_up = robot.out.is_some());
            }
            EventKind::Skipped { frame } | EventKind::LeftOutForMusic { frame, .. } => {
                self.given_up.push(*frame)
            }
            EventKind::LoopBegun { first, last } => self.repeats = Some((*first, *last)),
            EventKind::GoesTo { frame } => self.reached = frame.checked_sub(1),
            EventKind::Rejoined(id) => {
                if let Some(place) = robot(*id) {
                    self.robots[by_id[place].1].out = None;
                }
            }
            EventKind::StoppedAll => self.stopped = Some(event.at),
            EventKind::RunEnded { .. } => {
                self.stopped.get_or_insert(event.at);
                self.is_over = true;
            }
            EventKind::RunBegun { .. } => (self.stopped, self.is_over) = (None, false),
            _ => {}
        }
    }

    /// A robot drops out. What others do may make it late or blocked.
    fn dropped_out(&mut self, now: Instant, robot: usize, why: Trouble) {
        self.robots[robot].out = Some(now);
        let by_others = matches!(why, Trouble::Late | Trouble::Blocked | Trouble::Missed | Trouble::Unsure);
        if !self.robots[robot].may_drop_out && !by_others {
            self.violate(
                now,
                "dropout",
                format!("robot {robot} dropped out, and nothing happened to it: {why:?}"),
            );
        }
    }

    /// A frame stands: all before it did, each once, or it begins a loop again.
    fn frame_stands(&mut self, now: Instant, frame: usize) {
        let goes_back =
            self.repeats.is_some_and(|(first, last)| self.reached == Some(last) && frame == first);
        let next = if goes_back { frame } else { self.reached.map_or(0, |reached| reached + 1) };
        self.reached = Some(frame);
        let is_next = frame >= next && (next..frame).all(|skipped| self.given_up.contains(&skipped));
        if !is_next && !self.is_journal_old {
            self.violate(
                now,
                "frames",
                format!("frame {} stands, and frame {} was next", frame + 1, next + 1),
            );
        }
    }

    /// Checks all invariants after a step.
    pub fn check(&mut self, now: Instant, robots: &RobotSet) {
        self.check_contacts(now, robots);
        for &bump in robots.world.bumps().fresh() {
            self.check_bump(now, bump);
        }
        for robot in 0..self.robots.len() {
            self.check_rest(now, robot, robots);
        }
        self.check_routes(now, robots);
        if now > self.limit && !self.is_over {
            self.violate(now, "end", "the show has not ended".into());
        }
    }

    /// No route leads through a robot that dropped out and has no route, if the controller can know where it is: robots that
    /// know TARGET only do not say where they are on the way.
    fn check_routes(&mut self, now: Instant, robots: &RobotSet) {
        let is_out = |robot: &usize| {
            let watched = &self.robots[*robot];
            let stands = robots.is_ours(*robot) && robots.route_place(*robot).is_none();
            watched.out.is_some() && stands && !watched.is_place_given_up && !self.is_unexpected(now, *robot)
        };
        let out: Vec<usize> = (0..self.robots.len()).filter(is_out).collect();
        for (robot, standing) in self.routes.look(now, robots, &out) {
            let at = robots.world.places()[standing];
            let what = format!(
                "the route of robot {robot} leads through robot {standing}, which is out, at ({:.3}, {:.3}) m",
                at.x, at.y
            );
            self.violate(now, "routes", what);
        }
    }

    fn check_contacts(&mut self, now: Instant, robots: &RobotSet) {
        let world = &robots.world;
        for &(a, b) in world.contacts().fresh() {
            let is_foot = b as usize == self.robots.len();
            let what = match is_foot {
                true => self.contact_with_person(now, a as usize, robots),
                false => self.contact(now, (a, b)),
            };
            match what {
                Some(what) => self.violate(now, "contact", what),
                None => self.together.push((a, b)),
            }
        }
        if !self.together.is_empty() {
            let apart_m = world.contacts().contact_m() + APART_M;
            let places = world.places();
            self.together.retain(|&(a, b)| places[a as usize].distance(places[b as usize]) < apart_m);
        }
    }

    /// Why a contact must not be; `None`: it is excused.
    fn contact(&self, now: Instant, pair: (u32, u32)) -> Option<String> {
        let (a, b) = (pair.0 as usize, pair.1 as usize);
        let [one, other] = [&self.robots[a], &self.robots[b]];
        if self.together.contains(&pair) || self.is_unexpected(now, a) || self.is_unexpected(now, b) {
            return None;
        }
        match (one.is_broken, other.is_broken) {
            (false, false) => Some(format!("robots {a} and {b} touched")),
            (true, true) => None,
            (is_first, _) => {
                let (broken, works) = if is_first { (a, b) } else { (b, a) };
                let known = self.robots[broken].out.is_some_and(|out| now - out > KNOWN_AFTER);
                known.then(|| format!("robot {works} touched robot {broken}, which was known to be broken"))
            }
        }
    }

    /// Why a robot must not touch the person's foot; `None`: the foot has just been put in its way, or the robot does not
    /// brake because it drives to a target (R49).
    fn contact_with_person(&self, now: Instant, robot: usize, robots: &RobotSet) -> Option<String> {
        let is_surprised = self.stepped.is_some_and(|at| now - at < EXPECTED_AFTER);
        let is_excused = is_surprised
            || robots.is_on_target(robot)
            || self.robots[robot].is_broken
            || self.is_unexpected(now, robot);
        (!is_excused).then(|| format!("robot {robot} touched a person"))
    }

    /// Whether a robot stands where it was put down just now, or where no controller can know that it is.
    fn is_unexpected(&self, now: Instant, robot: usize) -> bool {
        let watched = &self.robots[robot];
        watched.is_false || watched.moved.is_some_and(|at| now - at < EXPECTED_AFTER)
    }

    fn check_bump(&mut self, now: Instant, bump: Bump) {
        if self.robots[bump.robot].is_broken || self.is_unexpected(now, bump.robot) {
            return;
        }
        match bump.thing {
            FloorObject::Obstacle(area) => {
                self.violate(now, "floor", format!("robot {} touched area {}", bump.robot, area + 1));
            }
            FloorObject::Edge if bump.over => {
                self.violate(now, "floor", format!("robot {} went over the edge", bump.robot));
            }
            FloorObject::Edge => {}
        }
    }

    fn check_rest(&mut self, now: Instant, robot: usize, robots: &RobotSet) {
        let stands = robots.world.wheel_turns(robot) == [0.0; 2];
        let watched = &mut self.robots[robot];
        if stands || !robots.is_on(robot) || robots.is_on_target(robot) {
            watched.moves = false;
            return;
        }
        let is_silent = now - watched.received > RESTS_AFTER;
        let is_stopped = !watched.is_false && self.stopped.is_some_and(|at| now - at > RESTS_AFTER);
        if (is_silent || is_stopped) && !core::mem::replace(&mut watched.moves, true) {
            let [left, right] = robots.world.wheel_turns(robot).map(|turn| turn / crate::world::STEP_S);
            let why = if is_silent { "after silence" } else { "after Stop or the end" };
            self.violate(
                now,
                "rest",
                format!("robot {robot} moves {why}, wheels {left:.2} and {right:.2} rad/s"),
            );
        }
    }

    fn violate(&mut self, at: Instant, invariant: &'static str, what: String) {
        if self.violations.len() < KEPT {
            self.violations.push(Violation { at, invariant, what });
        }
    }
}

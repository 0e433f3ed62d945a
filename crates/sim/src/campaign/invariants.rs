//! The invariants that are checked after each step of a campaign.

use core::fmt;

use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_control::{Event, EventKind, Trouble};

use super::route_watch::RouteWatch;
use crate::breakdowns::Fate;
use crate::bumps::Bump;
use crate::floor::FloorObject;
use crate::mishap::Mishap;
use crate::robot_set::RobotSet;

/// Time after which a robot must stand still (R40 and R43 of docs/protocol.md). It counts from Stop, from the end of
/// the run, or from the last message that the robot received. A robot with a route that receives nothing brakes after
/// 1.9 s and stands within 2.2 s.
const RESTS_AFTER: Span = Span::from_millis(2_200);
/// When a run is over, checks go on for this long after the time [`Invariants::stopped`].
const WATCHED: Span = Span::from_millis(3_500);
/// Time since a broken robot's dropout after which a contact with it is a violation, because other robots must drive
/// around it. Until then, all robots are held (within 0.6 s) and get new plans.
const KNOWN_AFTER: Span = Span::from_millis(1_000);
/// Time since a robot was put down elsewhere, began or ceased to report a false place, or a foot was put on the floor.
/// After this time a contact with the robot or foot is a violation. The moved robot notices within 0.3 s (R47) and
/// reports, and all robots are held within 0.6 s. Messages may be late and lost.
const EXPECTED_AFTER: Span = Span::from_millis(1_500);
/// An excused contact has ended when the gap between the two rims is at least this, metres. A contact of the same pair
/// before that end is excused, too.
const APART_M: f64 = 0.01;
/// Time since a run was lost after which every route of the run has ended.
const ROUTE_ENDS: Span = Span::from_millis(30_000);
/// Largest number of violations that are kept.
const KEPT: usize = 20;

/// A violation of an invariant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// Time since robots were switched on.
    pub at: Instant,
    /// The invariant, as one word.
    pub invariant: &'static str,
    /// What happened, for people.
    pub what: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:7.3} s  {}: {}", self.at.as_secs(), self.invariant, self.what)
    }
}

/// What is known of one robot.
#[derive(Clone, Debug)]
struct Watched {
    /// When it received its last message.
    received: Instant,
    /// Whether it has no power, or its wheels are stuck.
    is_broken: bool,
    /// When it dropped out; `None` while it takes part.
    out: Option<Instant>,
    /// Whether the robot was out when a plan last failed. The controller may then plan paths through the robot's place.
    is_place_given_up: bool,
    /// Whether a dropout of the robot is no violation. Reasons: messages are lost at random, a breakdown or mishap
    /// happened to this robot, or it understands the command TARGET but no routes.
    may_drop_out: bool,
    /// Whether it reports a false place, or shares its name with another robot.
    is_false: bool,
    /// When the robot was last put down elsewhere, or last began or ceased to report a false place.
    moved: Option<Instant>,
    /// Whether the present turning of its wheels was already counted as a violation, because it had to rest. Becomes
    /// false when the wheels stand, or the robot has no power or drives to a target. One movement is one violation.
    moves: bool,
}

/// Checks the invariants of a run.
#[derive(Debug)]
pub(crate) struct Invariants {
    robots: Vec<Watched>,
    /// When the show must be over at the latest.
    limit: Instant,
    /// Index of the frame that robots reached last. After a jump of the operator: of the frame before the chosen frame.
    /// `None`: no frame yet, or the operator chose the first frame.
    reached: Option<usize>,
    /// Indices of frames that robots need not reach. No plan to such a frame was found, or it was skipped or left out
    /// to keep up with the music.
    given_up: Vec<usize>,
    /// Indices of the first and the last frame of the latest loop; `None`: no loop has begun yet.
    repeats: Option<(usize, usize)>,
    /// When a person last put a foot on the floor, or left.
    stepped: Option<Instant>,
    /// Whether the journal may be older than the run, because the disk was full or slow.
    is_journal_old: bool,
    /// Since when robots must rest: all were stopped, or the run ended. If the run was lost: the time at which its
    /// routes have ended. `None`: neither has happened in this run.
    stopped: Option<Instant>,
    is_over: bool,
    /// Pairs of robots, or of a robot and the foot, whose contact was excused and that have not parted.
    together: Vec<(u32, u32)>,
    routes: RouteWatch,
    violations: Vec<Violation>,
}

impl Invariants {
    /// Checks for `robots` robots, whose show must be over at `limit`. The last `originals` of the robots understand
    /// TARGET but no routes.
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

    /// Allows every robot to drop out, because messages are lost at random.
    pub fn on_a_bad_link(mut self) -> Self {
        self.robots.iter_mut().for_each(|robot| robot.may_drop_out = true);
        self
    }

    /// The violations that were found.
    pub fn into_violations(self) -> Vec<Violation> {
        self.violations
    }

    /// Whether nothing is left to check: the run ended and robots were stopped more than [`WATCHED`] ago, or the limit
    /// is past.
    pub fn are_over(&self, now: Instant) -> bool {
        self.is_over && self.stopped.is_some_and(|at| now - at > WATCHED) || now > self.limit
    }

    /// Notes that a new controller found no run after a crash. Robots then drive at most to the ends of their routes.
    /// This is a violation unless the disk made the journal old, or the run was over.
    pub fn run_is_gone(&mut self, now: Instant) {
        if !self.is_over && !self.is_journal_old {
            self.violate(now, "journal", "the run is not found".into());
        }
        self.stopped.get_or_insert(now + ROUTE_ENDS);
        self.is_over = true;
    }

    /// Notes that a robot received a message.
    pub fn received(&mut self, robot: usize, now: Instant) {
        self.robots[robot].received = now;
    }

    /// Notes that a robot broke down.
    pub fn broke_down(&mut self, robot: usize, fate: Fate) {
        self.robots[robot].is_broken |= matches!(fate, Fate::Killed | Fate::Stuck);
        self.robots[robot].may_drop_out = true;
    }

    /// Notes a mishap.
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

    /// Handles an event of the controller.
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

    /// Notes that a robot dropped out. A dropout without a reason is a violation. If the robot is late, blocked, unsure
    /// of its place, or missed its goal, that is always reason enough, because other robots may cause it.
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

    /// Notes a reached frame, and checks that it is the one after the last reached frame. Frames in `given_up` may be
    /// missing in between. After the last frame of a loop, the loop's first frame must follow. An old journal excuses
    /// any order.
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

    /// Checks that no route leads through a robot that dropped out and has no route. Dropped-out robots are not checked
    /// if their place was given up or the controller cannot know it. TARGET-only robots, for example, do not report
    /// their places on the way.
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

    /// Why the contact of a pair of robots is a violation; `None` if the contact is excused.
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

    /// Why the contact of a robot with the person's foot is a violation; `None` if it is excused. A contact just after
    /// the foot was put there is excused. So is a contact of a broken or unexpected robot, and of a robot on its way to
    /// a target, which does not brake (R49).
    fn contact_with_person(&self, now: Instant, robot: usize, robots: &RobotSet) -> Option<String> {
        let is_surprised = self.stepped.is_some_and(|at| now - at < EXPECTED_AFTER);
        let is_excused = is_surprised
            || robots.is_on_target(robot)
            || self.robots[robot].is_broken
            || self.is_unexpected(now, robot);
        (!is_excused).then(|| format!("robot {robot} touched a person"))
    }

    /// Whether the controller cannot know the robot's place: the robot reports a false place or shares its name. Or
    /// less than [`EXPECTED_AFTER`] ago it was put down elsewhere, or began or ceased to report a false place.
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

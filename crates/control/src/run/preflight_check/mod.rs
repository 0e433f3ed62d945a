//! The preflight under way: a test of all robots before a show. In each round some robots drive out and back. The way
//! out of round `n` leads to frame `2n`, and the way back to frame `2n + 1`.
//!
//! The drives are those of any run. The checks here ask for reports, compare them with the plan, stop robots once on
//! the way out, and let robots blink at the end.

mod robot_test;

use crate::context::Context;
use crate::event::Trouble;
use crate::leg::{Leg, LegKind};
use crate::preflight::{OFF_M, PreflightFinding, PreflightReport};
use crate::robot::KnownRobot;
use crate::run::driving::Driving;
use crate::run::next::Next;
use crate::run::roster::Roster;
use crate::run::run_context::RunContext;
use lightbots_base::{Instant, RobotId, Span, Vec2};
use lightbots_wire::{Blink, Command, Details, RobotState, Route, Topic};
use robot_test::{RobotTest, untested};
use std::collections::BTreeMap;

/// All robots are stopped on the way out once one of them would come to rest at most this far from its goal, metres. A
/// robot that does not stop then drives on by up to this distance, which its reports show.
const STOP_LEFT_M: f64 = 0.02;
/// If a stopped robot would rest closer to its goal than this, its stop is not tested, metres. Its place may be off by
/// [`OFF_M`], and by as much again for noise, so stopping and driving on could not be told apart.
const TOLD_APART_M: f64 = 2.0 * OFF_M;
/// Longest time from when a robot should stand to its report that it stands; two round trips are added. R40 asks for
/// this report at once, but on a lossy link the robot has to be asked again.
const STOPS_WITHIN: Span = Span::from_millis(1_000);
/// Reports count from this time after robots reached a frame. While a robot drives, its estimated place follows its
/// wheels. Only while it stands do its position fixes show, within seconds, where it really is.
const SETTLES: Span = Span::from_millis(2_950);
/// Time after robots reached a frame at which all are asked to report.
const ASK_AT: Span = Span::from_millis(3_000);
/// Time between further requests to robots that have not answered. Even two lost messages in a row then lead to no
/// finding.
const ASK_EVERY: Span = Span::from_millis(150);
/// Latest time after robots reached a frame at which their answers are checked. They are checked earlier once all have
/// come.
const JUDGE_AT: Span = Span::from_millis(4_100);
/// How long robots blink at the end.
const BLINK: Span = Span::from_millis(4_000);
/// Time between two requests for reports to driving robots. Their headings are compared with the directions in which
/// they drive.
const ASK_DRIVERS_EVERY: Span = Span::from_millis(120);
/// Least time between these requests, divided by the number of robots in the run, because the answers share one link.
/// Above 300 robots, this least time is longer than `ASK_DRIVERS_EVERY`.
const ASK_DRIVERS_PER_ROBOT: Span = Span(400);

/// The preflight under way.
#[derive(Clone, Debug)]
pub(crate) struct PreflightCheck {
    /// `[round][participant]`: whether its robot drives in that round.
    drives: Vec<Vec<bool>>,
    /// `[participant]`: what was found about its robot.
    tests: Vec<RobotTest>,
    /// The stop on the way out whose result is still to be checked. `None` if there is none.
    stop: Option<StopTest>,
    /// Number of rounds in which robots have been stopped.
    stopped: usize,
    /// The frame in which robots stand and whose places are still to be checked. `None` if there is none.
    standing: Option<StandingTest>,
    /// Number of frames whose places were checked.
    judged: usize,
    /// When driving robots are asked to report next.
    ask_drivers_at: Instant,
}

/// The check of one stop on the way out.
#[derive(Clone, Debug)]
struct StopTest {
    /// When robots should stand, by the protocol.
    stand_at: Instant,
    /// Participants that drove, and where their robots should stand then, stage metres. `None` if that is too close to
    /// the goal: a robot that drove on could not be told from one that stopped.
    due: Vec<(usize, Option<Vec2>)>,
    /// `[participant]`: when its robot first reported, after `stand_at`, that it stands.
    stood: Vec<Option<Instant>>,
}

/// The check of a frame in which robots stand.
#[derive(Clone, Copy, Debug)]
struct StandingTest {
    frame: usize,
    since: Instant,
    ask_at: Instant,
}

impl PreflightCheck {
    /// The checks of a preflight that is about to begin. `rounds`: `[round][participant]`, the goal of its robot, or
    /// `None` if the robot does not drive in that round. `places`: where each participant stands, stage metres.
    pub fn new(rounds: &[Vec<Option<Vec2>>], places: impl Iterator<Item = Vec2>) -> Self {
        Self {
            drives: rounds.iter().map(|goals| goals.iter().map(Option::is_some).collect()).collect(),
            tests: places.map(RobotTest::new).collect(),
            stop: None,
            stopped: 0,
            standing: None,
            judged: 0,
            ask_drivers_at: Instant::ZERO,
        }
    }

    /// The present round, counted from 0, and the number of rounds.
    pub fn round(&self) -> (usize, usize) {
        ((self.judged / 2).min(self.drives.len().saturating_sub(1)), self.drives.len())
    }

    /// What robots are doing, as a text for people.
    pub fn doing(&self) -> &'static str {
        let is_over = self.judged >= 2 * self.drives.len();
        match (self.judged % 2, self.stopped > self.judged / 2) {
            _ if is_over => "done",
            _ if self.standing.is_some() && self.judged + 1 == 2 * self.drives.len() => "blinking",
            _ if self.standing.is_some() => "measuring",
            _ if self.stop.is_some() => "stopping on the way out",
            (0, false) => "driving out",
            (0, true) => "driving on after the stop",
            _ => "driving back",
        }
    }

    /// When robots are next asked for their places in a frame. [`Instant::FAR`] if no frame is being checked.
    pub fn due(&self) -> Instant {
        self.standing.map_or(Instant::FAR, |test| test.ask_at)
    }

    /// Notes that a participant dropped out, as a finding of its robot. If it was to stop on the way and did not
    /// acknowledge, the finding is that it did not stop.
    pub fn drop_out(&mut self, participant: usize, why: Trouble) {
        let is_stopping = self.stop.is_some() && why == Trouble::Deaf;
        let finding = if is_stopping { PreflightFinding::DidNotStop } else { PreflightFinding::Failed(why) };
        if let Some(test) = self.tests.get_mut(participant) {
            test.find(finding);
        }
    }

    /// Takes in a status report of a participant: its place and heading while it drives, and whether it stands after a
    /// stop.
    pub fn on_report(&mut self, now: Instant, participant: usize, at: Option<Vec2>, details: &Details) {
        let drives = self.drives(self.judged, participant);
        let pose = at.zip(details.heading).filter(|_| drives);
        if let (Some((at, heading)), Some(test)) = (pose, self.tests.get_mut(participant)) {
            test.track.add(at, heading);
        }
        let state = details.state;
        let Some(stop) = &mut self.stop else { return };
        let stands = !matches!(state, RobotState::Driving | RobotState::Held);
        if let Some(stood) = stop.stood.get_mut(participant)
            && stands
            && now >= stop.stand_at
        {
            stood.get_or_insert(now);
        }
    }

    /// Asks all robots for reports while they drive, and stops all once on the way out.
    pub fn on_driving(&mut self, drive: &Driving, cx: &mut RunContext) -> Next {
        if cx.now >= self.ask_drivers_at {
            let every = ASK_DRIVERS_EVERY.max(ASK_DRIVERS_PER_ROBOT * cx.roster.len() as i64);
            self.ask_drivers_at = cx.now + every;
            cx.io.outbox.send(Topic::Broadcast, &[Command::Status]);
        }
        self.stop_on_the_way(drive, cx)
    }

    /// Checks the stop and the frame while all robots stand. Returns the dropout of robots that did not stop.
    pub fn on_standing(&mut self, cx: &mut RunContext, is_frame_reached: bool) -> Next {
        let failed = self.judge_stop(cx);
        if !failed.is_empty() {
            return Next::Drop(failed.into_iter().map(|participant| (participant, Trouble::Deaf)).collect());
        }
        self.look_at_frame(cx, is_frame_reached);
        Next::Stay
    }

    /// Checks the frame with the answers that have come by now, because START was sent and robots are about to leave.
    /// On a slow link START is sent early.
    pub fn on_starting(&mut self, cx: &RunContext) {
        if let Some((test, leg)) = self.standing.take().zip(cx.pipeline.leg()) {
            self.judge_places(cx, leg, test.since + SETTLES);
            self.judged = leg.frame + 1;
        }
    }

    fn drives(&self, frame: usize, participant: usize) -> bool {
        self.drives.get(frame / 2).and_then(|round| round.get(participant)).is_some_and(|drives| *drives)
    }

    /// Stops all robots once on the way out of each round.
    fn stop_on_the_way(&mut self, drive: &Driving, cx: &RunContext) -> Next {
        let now = cx.now;
        let Some(leg) = cx.pipeline.leg().filter(|leg| leg.kind == LegKind::Routes) else {
            return Next::Stay;
        };
        let round = leg.frame / 2;
        let is_due = leg.frame % 2 == 0 && self.stopped <= round && drive.clock.hold.is_none();
        if !is_due || cx.playback.paused || now < drive.clock.began {
            return Next::Stay;
        }
        let active = cx.roster.active().map(|(participant, _)| participant);
        let movers: Vec<usize> = active
            .filter(|&one| {
                self.drives(leg.frame, one) && leg.path(one).is_some_and(|path| !path.as_ref().rests())
            })
            .collect();
        let place = |participant: usize, time: Span| {
            leg.path(participant).map(|path| path.as_ref().at(time).position)
        };
        let hold_at = now + cx.link.hold_lead();
        let stands = drive.clock.path_time(hold_at) + Route::EASE / 2;
        let left_m = |one: usize, at: Vec2| at.distance(leg.robots[one].goal);
        let is_near = |&one: &usize| place(one, stands).is_some_and(|at| left_m(one, at) <= STOP_LEFT_M);
        if !movers.iter().any(is_near) {
            return Next::Stay;
        }
        let due = movers.iter().map(|&one| {
            let place = place(one, stands).filter(|at| left_m(one, *at) >= TOLD_APART_M);
            (one, place)
        });
        self.stop = Some(StopTest {
            stand_at: hold_at + Route::EASE,
            due: due.collect(),
            stood: vec![None; cx.roster.len()],
        });
        self.stopped = round + 1;
        Next::Regather
    }

    /// Checks, for each robot that was told to stop, where and when it stood. Returns participants that stand elsewhere
    /// or reported too late; they are to drop out. A robot that reported in time stays, but counts as not tested, if it
    /// was to stop too close to its goal. So does one that stands elsewhere on a link so slow that HOLD may have come
    /// late.
    fn judge_stop(&mut self, cx: &RunContext) -> Vec<usize> {
        let Some(stop) = self.stop.take() else { return Vec::new() };
        let within = STOPS_WITHIN + cx.link.round_trip * 2;
        let mut failed = Vec::new();
        for (participant, place) in stop.due {
            if cx.roster.is_excluded(participant) {
                continue;
            }
            let robot = cx.robot(participant);
            let is_at = |place: Vec2| robot.reported.at.is_some_and(|at| at.distance(place) <= OFF_M);
            let is_in_time = stop.stood[participant].is_some_and(|at| at - stop.stand_at <= within);
            if is_in_time && place.is_some_and(is_at) {
                continue;
            }
            if is_in_time && (place.is_none() || cx.link.hold_may_be_late()) {
                self.tests[participant].find(PreflightFinding::StopNotTested);
            } else {
                self.tests[participant].find(PreflightFinding::DidNotStop);
                failed.push(participant);
            }
        }
        failed
    }

    /// Asks robots for their places once they have reached a frame, and checks the answers. In the last frame robots
    /// also blink.
    fn look_at_frame(&mut self, cx: &mut RunContext, is_frame_reached: bool) {
        let now = cx.now;
        let stands = cx.pipeline.leg().map(|leg| leg.frame).filter(|_| is_frame_reached);
        let Some(frame) = stands.filter(|frame| *frame >= self.judged) else {
            self.standing = None;
            return;
        };
        let test = self.standing.filter(|test| test.frame == frame);
        if test.is_none() && frame + 1 == 2 * self.drives.len() {
            blink(cx);
        }
        let mut test = test.unwrap_or(StandingTest { frame, since: now, ask_at: now + ASK_AT });
        if now >= test.ask_at {
            let is_first = test.ask_at == test.since + ASK_AT;
            let is_unanswered = |robot: &KnownRobot| is_first || robot.contact.heard < test.since + ASK_AT;
            let is_complete = !ask(cx, is_unanswered);
            test.ask_at = now + ASK_EVERY;
            if is_complete || now - test.since >= JUDGE_AT {
                if let Some(leg) = cx.pipeline.leg() {
                    self.judge_places(cx, leg, test.since + SETTLES);
                }
                self.judged = frame + 1;
                self.standing = None;
                return;
            }
        }
        self.standing = Some(test);
    }

    fn judge_places(&mut self, cx: &RunContext, leg: &Leg, fresh_from: Instant) {
        let active = cx.roster.active().map(|(participant, _)| participant);
        let drivers: Vec<usize> = active.filter(|&one| self.drives(leg.frame, one)).collect();
        for participant in drivers {
            let (step, test) = (&leg.robots[participant], &mut self.tests[participant]);
            if step.pixel.is_none() {
                // The planner left out the pixel of the robot, because it can prove no path to it.
                test.find(PreflightFinding::NoRoom);
                continue;
            }
            let robot = cx.robot(participant);
            let Some(at) = robot.reported.at.filter(|_| robot.contact.heard >= fresh_from) else {
                test.find(PreflightFinding::Failed(Trouble::Silent));
                continue;
            };
            let off_m = at.distance(step.goal);
            test.off_m = Some(test.off_m.unwrap_or(0.0).max(off_m));
            test.is_done |= leg.frame % 2 == 1;
            if off_m > OFF_M {
                test.find(PreflightFinding::OffPlace { off_m });
            }
            if let Some(heading) = robot.reported.heading {
                test.judge_heading(leg, participant, (at, heading));
            }
        }
    }

    /// The findings about all robots. `finished`: the preflight was not interrupted.
    pub fn report(&self, roster: &Roster, io: &Context, finished: bool) -> PreflightReport {
        let part: BTreeMap<RobotId, usize> = (0..self.tests.len().min(roster.len()))
            .map(|participant| (roster.robot(io, participant).id, participant))
            .collect();
        let has_room = |participant: usize| self.drives.iter().any(|round| round[participant]);
        let row = |robot: &KnownRobot| match part.get(&robot.id) {
            Some(&participant) => Some(self.tests[participant].result(robot, has_room(participant))),
            None => untested(robot),
        };
        PreflightReport { finished, robots: io.fleet.robots().iter().filter_map(row).collect() }
    }
}

/// Asks robots of the run to report their places, if `is_asked` is true for them. Returns whether any was asked.
fn ask(cx: &mut RunContext, is_asked: impl Fn(&KnownRobot) -> bool) -> bool {
    let active = cx.roster.active().map(|(_, known)| known.robot);
    let robots: Vec<usize> = active.filter(|&robot| is_asked(cx.io.fleet.robot(robot))).collect();
    for &robot in &robots {
        let known = cx.io.fleet.robot(robot);
        let command = if known.is_original() { Command::Uuid } else { Command::Status };
        cx.io.outbox.send(Topic::Robot(known.id), &[command]);
    }
    !robots.is_empty()
}

/// Makes all robots that can do so blink, also those that dropped out. A person sees which of them respond.
fn blink(cx: &mut RunContext) {
    for participant in 0..cx.roster.len() {
        let robot = cx.robot(participant);
        if robot.reported.abilities.blink {
            let topic = Topic::Robot(robot.id);
            cx.io.outbox.send(topic, &[Command::Blink(Blink { over: BLINK })]);
        }
    }
}

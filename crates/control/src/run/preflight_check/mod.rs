//! The preflight under way: stops robots on their way out, compares reports with the plan, and has robots blink.
//!
//! The drives are those of any run. This only looks on, except that it asks for reports, and for the stop on the way out.

use crate::context::Context;
use crate::event::Trouble;
use crate::leg::{Leg, LegKind};
use crate::preflight::{DrivenTrack, OFF_M, OFF_RAD, PreflightFinding, PreflightReport, PreflightRobot};
use crate::robot::KnownRobot;
use crate::run::driving::Driving;
use crate::run::next::Next;
use crate::run::roster::Roster;
use crate::run::run_context::RunContext;
use lightbots_base::shape::point_to_segment;
use lightbots_base::{Instant, RobotId, Span, Vec2, difference};
use lightbots_wire::{Blink, Command, Details, RobotState, Route, Topic};
use std::f64::consts::FRAC_PI_2;

/// Robots are stopped with this much of their way out before them, metres: those that do not stop drive on so far that it
/// shows, and all are still fast.
const STOP_LEFT_M: f64 = 0.033;
/// How long after STOP a robot may take to say that it stands; two round trips come on top. R40 asks for it at once; on a
/// lossy link the robot has to be asked for it again.
const STOPS_WITHIN: Span = Span::from_millis(1_000);
/// Reports count from this long after a frame was reached. While a robot drives, its estimate follows its wheels; only while
/// it stands, its fixes show within seconds where it really is.
const SETTLES: Span = Span::from_millis(2_950);
/// All robots are asked to report this long after a frame was reached …
const ASK_AT: Span = Span::from_millis(3_000);
/// … and those whose answers are missing again and again, this far apart. Two lost messages in a row name no robot.
const ASK_EVERY: Span = Span::from_millis(150);
/// Answers are judged once all are there, and this long after the frame was reached at the latest.
const JUDGE_AT: Span = Span::from_millis(4_100);
/// How long robots blink at the end.
const BLINK: Span = Span::from_millis(4_000);
/// A path that leaves the line between its ends by no more than this is straight, metres. On a bend close to its end a robot
/// cannot turn as fast as the path (R35), so its heading is not judged.
const STRAIGHT_M: f64 = 0.000_5;
/// A robot with another rim nearer than this by plan may give way by turning (R49): its heading is not judged, metres.
const ROOM_M: f64 = 0.01;
/// While they drive, robots are asked to report this often: their headings are compared with the directions in which
/// they drive …
const ASK_DRIVERS_EVERY: Span = Span::from_millis(120);
/// … and less often by this for each robot, because their answers share one link.
const ASK_DRIVERS_PER_ROBOT: Span = Span(400);
/// Number of moments at which a path is looked at for that.
const MOMENTS: i64 = 40;

/// The preflight under way.
#[derive(Clone, Debug)]
pub(crate) struct PreflightCheck {
    /// `[round][participant]`: whether the robot drives in that round.
    drives: Vec<Vec<bool>>,
    /// `[participant]`.
    tests: Vec<RobotTest>,
    /// The stop that is not judged yet.
    stop: Option<StopTest>,
    /// Number of rounds in which robots were stopped.
    stopped: usize,
    /// The frame that stands and is not judged yet, and how often robots were asked.
    standing: Option<StandingTest>,
    /// Number of frames whose places were judged.
    judged: usize,
    /// When robots on their way are asked to report next.
    ask_drivers_at: Instant,
}

/// What was found of a participant.
#[derive(Clone, Debug, Default)]
struct RobotTest {
    findings: Vec<PreflightFinding>,
    off_m: Option<f64>,
    off_rad: Option<f64>,
    /// The drive under way.
    track: DrivenTrack,
    /// Where the robot stood before that drive, stage metres.
    stood: Option<Vec2>,
    /// Sum of the angles between headings and directions of its drives, radians, and their number.
    askew: (f64, u32),
    /// It drove out and back, and both places were judged.
    is_done: bool,
}

/// Robots were told to stop on their way.
#[derive(Clone, Debug)]
struct StopTest {
    /// When they stand by the protocol.
    stand_at: Instant,
    /// Where they stand then, stage metres: participants and places.
    due: Vec<(usize, Vec2)>,
    /// `[participant]`: when the robot first said after that that it stands.
    stood: Vec<Option<Instant>>,
}

/// A frame stands.
#[derive(Clone, Copy, Debug)]
struct StandingTest {
    frame: usize,
    since: Instant,
    ask_at: Instant,
}

impl PreflightCheck {
    /// A preflight that is about to begin. `rounds`: `[round][participant]`, where the robot drives. `places`:
    /// where each participant stands, stage metres.
    pub fn new(rounds: &[Vec<Option<Vec2>>], places: impl Iterator<Item = Vec2>) -> Self {
        let test = |at| RobotTest { stood: Some(at), ..RobotTest::default() };
        Self {
            drives: rounds.iter().map(|goals| goals.iter().map(Option::is_some).collect()).collect(),
            tests: places.map(test).collect(),
            stop: None,
            stopped: 0,
            standing: None,
            judged: 0,
            ask_drivers_at: Instant::ZERO,
        }
    }

    /// The round under way, counted from 0, and how many there are.
    pub fn round(&self) -> (usize, usize) {
        ((self.judged / 2).min(self.drives.len().saturating_sub(1)), self.drives.len())
    }

    /// What robots do, for people.
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

    /// When something is due.
    pub fn due(&self) -> Instant {
        self.standing.map_or(Instant::FAR, |test| test.ask_at)
    }

    /// A participant dropped out.
    pub fn drop_out(&mut self, participant: usize, why: Trouble) {
        let is_stopping = self.stop.is_some() && why == Trouble::Deaf;
        let finding = if is_stopping { PreflightFinding::DidNotStop } else { PreflightFinding::Failed(why) };
        self.find(participant, finding);
    }

    /// A participant reports its state.
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

    /// Findings of one kind are one: the first counts.
    fn find(&mut self, participant: usize, finding: PreflightFinding) {
        let Some(test) = self.tests.get_mut(participant) else { return };
        let same = |known: &PreflightFinding| {
            std::mem::discriminant(known) == std::mem::discriminant(&finding)
                || matches!((known, &finding), (PreflightFinding::DidNotStop, PreflightFinding::Failed(_)))
        };
        if !test.findings.iter().any(same) {
            test.findings.push(finding);
        }
    }

    /// Robots drive.
    pub fn on_driving(&mut self, drive: &Driving, cx: &mut RunContext) -> Next {
        if cx.now >= self.ask_drivers_at {
            let every = ASK_DRIVERS_EVERY.max(ASK_DRIVERS_PER_ROBOT * cx.roster.len() as i64);
            self.ask_drivers_at = cx.now + every;
            cx.io.outbox.send(Topic::Broadcast, &[Command::Status]);
        }
        self.stop_on_the_way(drive, cx)
    }

    /// All stand.
    pub fn on_standing(&mut self, cx: &mut RunContext, is_frame_reached: bool) -> Next {
        let failed = self.judge_stop(cx);
        if !failed.is_empty() {
            return Next::Drop(failed.into_iter().map(|participant| (participant, Trouble::Deaf)).collect());
        }
        self.look_at_frame(cx, is_frame_reached);
        Next::Stay
    }

    /// Robots leave before the last answers were judged, because START is stated early on a slow link.
    pub fn on_starting(&mut self, cx: &RunContext) {
        if let Some((test, leg)) = self.standing.take().zip(cx.pipeline.leg()) {
            self.judge_places(cx, leg, test.since + SETTLES);
            self.judged = leg.frame + 1;
        }
    }

    fn drives(&self, frame: usize, participant: usize) -> bool {
        self.drives.get(frame / 2).and_then(|round| round.get(participant)).is_some_and(|drives| *drives)
    }

    /// All are stopped once on their way out of each round.
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
        let time = drive.clock.path_time(now);
        let is_near = |&one: &usize| {
            place(one, time).is_some_and(|at| at.distance(leg.robots[one].goal) <= STOP_LEFT_M)
        };
        if !movers.iter().any(is_near) {
            return Next::Stay;
        }
        let hold_at = now + cx.link.hold_lead();
        let stand_at = hold_at + Route::EASE;
        // On a link that slow, the drive is over before all can be stopped: then only that they stand is tested.
        let is_on_the_way = hold_at + Route::EASE < drive.clock.ends;
        let stands = drive.clock.path_time(hold_at) + Route::EASE / 2;
        let due = movers.iter().filter_map(|&one| Some((one, place(one, stands)?)));
        self.stop = Some(StopTest {
            stand_at,
            due: if is_on_the_way { due.collect() } else { Vec::new() },
            stood: vec![None; cx.roster.len()],
        });
        self.stopped = round + 1;
        Next::Regather
    }

    /// All stand that were told to stop: which of them do so elsewhere, or said so too late. They are driven no more.
    fn judge_stop(&mut self, cx: &RunContext) -> Vec<usize> {
        let Some(stop) = self.stop.take() else { return Vec::new() };
        let within = STOPS_WITHIN + cx.link.round_trip * 2;
        let mut failed = Vec::new();
        for (participant, place) in stop.due {
            if cx.roster.is_excluded(participant) {
                continue;
            }
            let robot = cx.robot(participant);
            let is_there = robot.reported.at.is_some_and(|at| at.distance(place) <= OFF_M);
            let is_in_time = stop.stood[participant].is_some_and(|at| at - stop.stand_at <= within);
            if !is_there || !is_in_time {
                self.find(participant, PreflightFinding::DidNotStop);
                failed.push(participant);
            }
        }
        failed
    }

    /// A frame stands: robots are asked where they are, and their answers are judged.
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
            let step = &leg.robots[participant];
            if step.pixel.is_none() {
                // The planner left its pixel out, because there is no path that it can prove.
                self.find(participant, PreflightFinding::NoRoom);
                continue;
            }
            let robot = cx.robot(participant);
            let Some(at) = robot.reported.at.filter(|_| robot.contact.heard >= fresh_from) else {
                self.find(participant, PreflightFinding::Failed(Trouble::Silent));
                continue;
            };
            let off_m = at.distance(step.goal);
            let test = &mut self.tests[participant];
            test.off_m = Some(test.off_m.unwrap_or(0.0).max(off_m));
            test.is_done |= leg.frame % 2 == 1;
            if off_m > OFF_M {
                self.find(participant, PreflightFinding::OffPlace { off_m });
            }
            if let Some(heading) = robot.reported.heading {
                self.judge_heading(leg, participant, (at, heading));
            }
        }
    }

    /// Compares a reported heading with the planned one, and after the way back with the directions of both drives.
    fn judge_heading(&mut self, leg: &Leg, participant: usize, (at, heading): (Vec2, f64)) {
        let has_room = leg.robots[participant].room_m >= ROOM_M;
        let planned = straight_direction(leg, participant).filter(|_| has_room);
        let test = &mut self.tests[participant];
        let off_planned = planned.map(|planned| off_line(heading, planned));
        let before = test.stood.replace(at);
        if let Some(askew_rad) = before.and_then(|before| test.track.askew_rad(at - before)) {
            test.askew = (test.askew.0 + askew_rad, test.askew.1 + 1);
        }
        test.track = DrivenTrack::default();
        let is_back = leg.frame % 2 == 1 && test.askew.1 > 0;
        let off_driven = is_back.then(|| (test.askew.0 / f64::from(test.askew.1)).abs());
        test.off_rad = [test.off_rad, off_planned, off_driven].into_iter().flatten().reduce(f64::max);
        if let Some(off_rad) = off_planned.filter(|off| *off > OFF_RAD) {
            self.find(participant, PreflightFinding::OffHeading { off_rad });
        }
        if let Some(off_rad) = off_driven.filter(|off| *off > OFF_RAD) {
            self.find(participant, PreflightFinding::DrivesAskew { off_rad });
        }
    }

    /// What was found. `finished`: the run was not broken off.
    pub fn report(&self, roster: &Roster, io: &Context, finished: bool) -> PreflightReport {
        let tested = |participant: usize, robot: &KnownRobot| {
            let test = self.tests.get(participant).cloned().unwrap_or_default();
            let mut findings = test.findings;
            if findings.is_empty() && !test.is_done {
                let has_room = self.drives.iter().any(|round| round[participant]);
                findings.push(if has_room { PreflightFinding::Unfinished } else { PreflightFinding::NoRoom });
            }
            let (off_m, off_rad) = (test.off_m, test.off_rad);
            PreflightRobot { id: robot.id, findings, off_m, off_rad, limited: robot.is_original() }
        };
        let part: std::collections::BTreeMap<RobotId, usize> = (0..self.tests.len().min(roster.len()))
            .map(|participant| (roster.robot(io, participant).id, participant))
            .collect();
        let row = |robot: &KnownRobot| match part.get(&robot.id) {
            Some(&participant) => Some(tested(participant, robot)),
            None => untested(robot),
        };
        PreflightReport { finished, robots: io.fleet.robots().iter().filter_map(row).collect() }
    }
}

/// A robot that could not take part; `None`: it is not to take part.
fn untested(robot: &KnownRobot) -> Option<PreflightRobot> {
    let why = match robot.reported.state {
        _ if !robot.is_admitted => return None,
        _ if robot.namesakes.are_there() => Trouble::Shared,
        _ if !robot.is_heard() => Trouble::Silent,
        Some(RobotState::Faulty) => Trouble::Faulty,
        _ if robot.reported.at.is_none() => Trouble::Lost,
        // It came while others were tested.
        _ => return Some(row(robot, PreflightFinding::Unfinished)),
    };
    Some(row(robot, PreflightFinding::Failed(why)))
}

fn row(robot: &KnownRobot, finding: PreflightFinding) -> PreflightRobot {
    let limited = robot.is_original();
    PreflightRobot { id: robot.id, findings: vec![finding], off_m: None, off_rad: None, limited }
}

/// Asks robots to report where they are; whether any was to be asked.
fn ask(cx: &mut RunContext, whom: impl Fn(&KnownRobot) -> bool) -> bool {
    let active = cx.roster.active().map(|(_, known)| known.robot);
    let robots: Vec<usize> = active.filter(|&robot| whom(cx.io.fleet.robot(robot))).collect();
    for &robot in &robots {
        let known = cx.io.fleet.robot(robot);
        let command = if known.is_original() { Command::Uuid } else { Command::Status };
        cx.io.outbox.send(Topic::Robot(known.id), &[command]);
    }
    !robots.is_empty()
}

/// Every robot that can blinks, those that dropped out too: a person sees which of them answer.
fn blink(cx: &mut RunContext) {
    for participant in 0..cx.roster.len() {
        let robot = cx.robot(participant);
        if robot.reported.abilities.blink {
            let topic = Topic::Robot(robot.id);
            cx.io.outbox.send(topic, &[Command::Blink(Blink { over: BLINK })]);
        }
    }
}

/// The direction of a participant's path, radians; `None`: it drives no path, or one with bends.
fn straight_direction(leg: &Leg, participant: usize) -> Option<f64> {
    let path = leg.path(participant).filter(|path| !path.as_ref().rests())?.as_ref();
    let (start, end, duration) = (path.start, path.end(), path.duration());
    let mut between = (1..MOMENTS).map(|moment| path.at(duration * moment / MOMENTS).position);
    between.all(|at| point_to_segment(at, start, end) <= STRAIGHT_M).then(|| (end - start).angle())
}

/// The angle between a heading and the line of a direction, 0 to a quarter turn: robots also drive backwards.
fn off_line(heading: f64, direction: f64) -> f64 {
    let off = difference(heading, direction).abs();
    if off > FRAC_PI_2 { std::f64::consts::PI - off } else { off }
}

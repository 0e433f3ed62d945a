//! An obstacle in a robot's path: all robots hold (stop together), and those nearby are asked for a report. Then a new
//! plan leads around the obstacle.

use crate::event::Trouble;
use crate::robot::KnownRobot;
use crate::run::driving::drive::{Driving, RobotProgress};
use crate::run::driving::sightings::{SAME_M, Sighting, narrow, seen_by};
use crate::run::link_loss;
use crate::run::next::Next;
use crate::run::pipeline::DrivenLeg;
use crate::run::roster::{Participant, Whereabouts};
use crate::run::run_context::RunContext;
use crate::run::silence;
use crate::run::stop_times::StopTimes;
use crate::snapshot::Age;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_wire::{Blocked, Command};

/// Robots closer to an obstructed robot than this are asked for a report, metres. One of them may have died in the path
/// of the obstructed robot.
const NEAR_M: f64 = 0.5;
/// Time within which a robot that was asked has to answer, or it counts as silent; round trips of the link are added.
const ANSWER: Span = Span::from_millis(800);
/// If a robot that was asked has not answered within this time, all robots are asked, to find out whether the link is
/// lost. Round trips of the link are added.
const DOUBT: Span = Span::from_millis(50);
/// An obstacle that still obstructs a robot after this time counts as permanent.
const STAYS: Span = Span::from_millis(1_500);
/// Time added to the bound for late robots, while a late or silent robot may be the obstacle. That robot thereby drops
/// out before a plan leads around it.
const SUSPECT: Span = Span::from_millis(500);
/// Largest number of new plans for one robot because of obstacles in its path. At the next obstacle the robot itself
/// drops out.
const REPLANS_MAX: u8 = 3;
/// Largest number of obstacles that are remembered. More could leave no path.
const FOUND_MAX: usize = 32;
/// Longest time by which a braking robot becomes late before it reports the obstacle for which it brakes.
const BRAKES: Span = Span::from_millis(150);

impl RobotProgress {
    /// Whether the robot is late (all wait for it) for another reason than an obstacle in its path.
    fn lags(&self) -> bool {
        let is_unobstructed = |late: Instant| {
            self.obstructed_since.is_none_or(|since| late + BRAKES < since)
                && self.obstructed_at.is_none_or(|at| at < late)
        };
        self.late_since.is_some_and(is_unobstructed)
    }
}

impl Driving {
    /// Handles a robot's report of an obstacle in its path, or of none. A new obstacle begins a hold of all robots, and
    /// robots near this one are asked for a report.
    pub fn on_obstruction(&mut self, cx: &mut RunContext, participant: usize, blocked: Option<Blocked>) {
        let progress = &mut self.progress[participant];
        if blocked.is_none() {
            progress.obstructed_since = None;
            return;
        }
        if progress.obstructed_since.is_some() {
            return;
        }
        progress.obstructed_since = Some(cx.now);
        if progress.late_since.is_none_or(|late| cx.now <= late + BRAKES) {
            progress.obstructed_at = Some(cx.now);
        }
        if progress.late_since.is_none() {
            self.mark_late(cx, participant, Trouble::Blocked);
        }
        self.probe_around(cx, participant);
    }

    /// Asks robots near an obstructed robot for a report, if they are still on their way and follow routes.
    fn probe_around(&mut self, cx: &mut RunContext, participant: usize) {
        let Some(at) = cx.robot(participant).reported.at else { return };
        for other in 0..cx.roster.len() {
            let robot = cx.robot(other);
            let near = robot.reported.at.is_some_and(|place| place.distance(at) < NEAR_M);
            let asked = self.is_under_way(cx, other) && !robot.is_original();
            if near && asked && other != participant && self.progress[other].probed_since.is_none() {
                cx.send(other, &[Command::Status]);
                self.progress[other].probed_since = Some(cx.now);
                self.progress[other].asked_at = cx.now;
            }
        }
    }

    /// Watches a robot that owes a report because a robot near it is obstructed. Asks it again meanwhile. Returns its
    /// dropout if the report is overdue, and `None` otherwise.
    pub fn watch_probed(&mut self, cx: &mut RunContext, participant: usize) -> Option<Next> {
        let since = self.progress[participant].probed_since?;
        if cx.robot(participant).contact.heard > since {
            self.progress[participant].probed_since = None;
        } else if cx.now - since > ANSWER + cx.link.round_trip * 2 {
            return Some(Next::drop(participant, Trouble::Silent));
        } else {
            if cx.now - since > DOUBT + cx.link.round_trip * 2 {
                link_loss::ask_all_once(cx, since);
            }
            self.ask(cx, participant);
        }
        None
    }

    /// Watches a robot that reports an obstacle since `since`. If the obstacle stays and is a late robot, that late
    /// robot drops out. If it is no late robot and stays longer, all is planned again around it. After `REPLANS_MAX` of
    /// these plans the obstructed robot drops out instead.
    pub fn watch_obstructed(&mut self, cx: &mut RunContext, participant: usize, since: Instant) -> Next {
        if cx.now - since > STAYS
            && let Some(culprit) = self.late_robot_seen_by(cx, participant)
        {
            return Next::drop(culprit, Trouble::Late);
        }
        let may_be_cause = |known: &RobotProgress| known.probed_since.is_some() || known.lags();
        let is_suspected = cx
            .roster
            .active()
            .any(|(one, _)| !self.progress[one].arrived && may_be_cause(&self.progress[one]));
        let bound = if is_suspected { cx.io.config.late.wait + SUSPECT } else { STAYS };
        if cx.now - since <= bound {
            return Next::Stay;
        }
        let known = &mut cx.roster.participants[participant];
        known.replans = known.replans.saturating_add(1);
        if known.replans > REPLANS_MAX {
            return Next::drop(participant, Trouble::Blocked);
        }
        let seen = seen_by(cx.robot(participant), cx.playback.contact_m());
        let found = &mut cx.pipeline.obstacles.found;
        found.extend(seen.filter(|_| found.len() < FOUND_MAX));
        self.locate_silent(cx);
        cx.tally.recovery.begins(self.clock.ends);
        Next::Regather
    }

    /// The late robot that the obstructed `participant` sees in its path. A robot that is late because it reports an
    /// obstacle itself does not count: a standing robot also reports others that come near. Robots that are late
    /// because they are unsure of their places do not count either.
    fn late_robot_seen_by(&self, cx: &RunContext, participant: usize) -> Option<usize> {
        let there = seen_by(cx.robot(participant), cx.playback.contact_m())?;
        let is_there = |one: usize| cx.robot(one).reported.at.is_some_and(|at| at.distance(there) < SAME_M);
        let is_late = |one: usize| self.progress[one].lags() && !self.progress[one].is_unsure;
        cx.roster.active().map(|(one, _)| one).find(|&one| is_late(one) && is_there(one))
    }

    /// Narrows the places where silent robots may stand to those where other robots have seen something. A sighting
    /// near the possible places of two silent robots narrows neither.
    fn locate_silent(&self, cx: &mut RunContext) {
        let seen = self.sightings(cx, None);
        let robots = cx.io.fleet.robots();
        let participants = cx.roster.participants.iter_mut();
        let silent = participants.filter(|known| is_silent(known, &robots[known.robot]));
        let mut places: Vec<&mut Whereabouts> = silent.map(|known| &mut known.last_seen).collect();
        let explained = |seen: &Sighting| places.iter().filter(|one| seen.is_near_any(&one.possible)).count();
        let clear: Vec<Sighting> = seen.iter().copied().filter(|seen| explained(seen) == 1).collect();
        for one in &mut places {
            narrow(&mut one.possible, &clear);
            one.likely.clone_from(&one.possible);
        }
    }

    /// Where a participant that fell silent on the drive may stand, narrowed by what other robots see in their paths.
    pub fn whereabouts(&self, cx: &RunContext, participant: usize) -> Whereabouts {
        let Some(DrivenLeg { leg, targets }) = &cx.pipeline.driven else { return Whereabouts::default() };
        let stop = StopTimes { began: cx.now, stood: cx.now };
        let robot = cx.robot(participant);
        let mut places = silence::whereabouts((leg, targets), &self.clock, stop, participant, robot);
        let others = || cx.roster.participants.iter().filter(|known| known.is_unplaced());
        let is_unexplained =
            |seen: &Sighting| !others().any(|known| seen.is_near_any(&known.last_seen.possible));
        let seen: Vec<Sighting> =
            self.sightings(cx, Some(participant)).into_iter().filter(is_unexplained).collect();
        narrow(&mut places.possible, &seen);
        narrow(&mut places.likely, &seen);
        places
    }

    /// What obstructed robots see in their paths, except robots at known places. Known are the places of participants,
    /// unless they dropped out without a known place, and of other robots that are not gone. The place of `silent`, a
    /// participant that fell silent, does not count as known.
    fn sightings(&self, cx: &RunContext, silent: Option<usize>) -> Vec<Sighting> {
        let contact_m = cx.playback.contact_m();
        let is_placed = |robot: &&KnownRobot| match robot.participant.map(|participant| participant as usize)
        {
            Some(participant) => {
                Some(participant) != silent && !is_silent(cx.participant(participant), robot)
            }
            None => robot.contact.age != Age::Gone,
        };
        // Robots that share a name report from several places in turn.
        let places = |robot: &KnownRobot| robot.reported.at.into_iter().chain(robot.namesakes.places());
        let known: Vec<Vec2> = cx.io.fleet.robots().iter().filter(is_placed).flat_map(places).collect();
        let is_obstructed = |one: &usize| self.progress[*one].obstructed_since.is_some();
        let sighting = |one: usize| {
            let robot = cx.robot(one);
            let (from, there) = (robot.reported.at?, seen_by(robot, contact_m)?);
            Some(Sighting { from, there })
        };
        let is_strange = |seen: &Sighting| !known.iter().any(|at| seen.is_of(*at));
        let obstructed = cx.roster.active().map(|(one, _)| one).filter(is_obstructed);
        obstructed.filter_map(sighting).filter(is_strange).collect()
    }
}

/// Whether a participant dropped out and its place is only inferred. `false` for robots that share a name: their places
/// are known from their reports.
fn is_silent(known: &Participant, robot: &KnownRobot) -> bool {
    known.is_unplaced() && !robot.namesakes.are_there()
}

//! Arrivals, and the end of a leg: the drive of all robots between two moments at which all stand.

use crate::event::EventKind;
use crate::leg::LegKind;
use crate::run::driving::drive::Driving;
use crate::run::next::{AirTime, Next};
use crate::run::playback::RunPurpose;
use crate::run::run_context::RunContext;
use lightbots_base::{Instant, Span, Vec2};
use lightbots_show::FrameLoop;
use lightbots_wire::RobotState;

/// If the last arrival comes at most this long after the planned end of a leg of routes, it counts as in time. The air
/// time (how long robots stay in a frame) then counts from the planned end. Robots beside their goals may count as
/// arrived from this time before the planned end on.
const IN_TIME: Span = Span::from_millis(250);
/// Distance from its goal beyond which a robot has missed the goal, and from its straight drive beyond which it has
/// left that drive, metres. It is more than a robot's diameter of 54 mm.
pub(crate) const MISSED_M: f64 = 0.06;

impl Driving {
    /// Handles the reported arrival of a robot that follows paths. The arrival counts if the robot is at its goal. Near
    /// the planned end, unless a hold is on, it also counts up to `MISSED_M` beside the goal. Any other arrival is
    /// ignored.
    pub fn on_arrival(&mut self, cx: &mut RunContext, participant: usize, at: Option<Vec2>) -> Next {
        let (Some(at), Some(goal)) = (at, cx.goal(participant)) else { return Next::Stay };
        if !self.is_under_way(cx, participant) {
            return Next::Stay;
        }
        let (begun, is_held) = (cx.now >= self.clock.began, self.clock.hold.is_some());
        let off_m = at.distance(goal);
        if begun && is_there(at, goal, cx.io.config.arrival_tolerance_m) {
            self.arrive(cx, participant)
        } else if cx.now + IN_TIME >= self.clock.ends && !is_held && off_m <= MISSED_M {
            // The robot takes this place for its goal and will not report its arrival again.
            self.accept_misaligned(cx, participant, off_m)
        } else {
            Next::Stay
        }
    }

    /// Counts the arrival of robots that ended the leg's route before this controller noted the beginning of the drive.
    /// These robots will not report their arrival again.
    pub fn arrive_before_start(&mut self, cx: &mut RunContext) -> Next {
        let Some(leg) = cx.pipeline.leg().filter(|leg| leg.kind == LegKind::Routes) else {
            return Next::Stay;
        };
        let is_there = |participant: &usize| {
            let reported = &cx.robot(*participant).reported;
            let ended = reported.state == Some(RobotState::Idle) && reported.route == leg.seq;
            let goal = leg.robots[*participant].goal;
            let near = |at: Vec2| is_there(at, goal, cx.io.config.arrival_tolerance_m);
            cx.is_awaited(*participant) && ended && reported.at.is_some_and(near)
        };
        let there: Vec<usize> = (0..leg.robots.len()).filter(is_there).collect();
        there.into_iter().fold(Next::Stay, |next, participant| next.or_else(|| self.arrive(cx, participant)))
    }

    /// Counts an arrival, once for each participant. The last one ends the leg.
    pub fn arrive(&mut self, cx: &mut RunContext, participant: usize) -> Next {
        if std::mem::replace(&mut self.progress[participant].arrived, true) {
            return Next::Stay;
        }
        self.arrivals += 1;
        self.last_arrival = self.last_arrival.max(cx.now);
        let leg = cx.pipeline.leg();
        if leg.and_then(|leg| leg.robots.get(participant)).is_some_and(|step| step.settles) {
            let first = cx.tally.arrivals.map_or(cx.now, |(first, _)| first);
            cx.tally.arrivals = Some((first, cx.now));
        }
        self.clear_late(participant);
        self.end_leg(cx)
    }

    /// Counts a robot as arrived although it stands `off_m` metres off its goal and will not drive there. Later legs
    /// are planned again from where it is.
    pub fn accept_misaligned(&mut self, cx: &mut RunContext, participant: usize, off_m: f64) -> Next {
        let robot = cx.robot(participant).id;
        cx.io.log.record_limited(cx.now, EventKind::Misaligned { robot, off_m });
        cx.pipeline.planning.is_outdated = true;
        self.arrive(cx, participant)
    }

    /// Ends the leg, if its drive has begun and all robots that drive in it have arrived: returns that robots stand.
    /// Otherwise returns [`Next::Stay`].
    pub fn end_leg(&mut self, cx: &mut RunContext) -> Next {
        let Some(leg) = cx.pipeline.leg() else { return Next::Stay };
        let (now, clock) = (cx.now, self.clock);
        if self.arrivals < leg.drivers || now < clock.began {
            return Next::Stay;
        }
        assert!(self.arrivals == leg.drivers, "a participant arrived twice");
        let (reaches_frame, frame) = (leg.reaches_frame, leg.frame);
        let in_time = leg.kind == LegKind::Routes && self.last_arrival - clock.ends <= IN_TIME;
        let stands_since = if in_time { clock.ends.min(now) } else { now };
        cx.playback.paused |= clock.open_hold().is_some_and(|hold| hold.by_operator);
        let mut air = Span::ZERO;
        if reaches_frame {
            air = cx.playback.standing_time(frame);
            reach_frame(cx, frame, clock.ends);
        }
        let left = cx.playback.paused.then_some(air);
        Next::Stand(AirTime { since: now, until: stands_since + air, left, is_at_goals: true })
    }
}

/// Notes that robots have reached a frame: events, counts, and whether the run pauses or waits for GO. Forgets
/// obstacles, and makes the frame after it the next one. `ends`: when robots were to reach the frame by plan, holds
/// included.
fn reach_frame(cx: &mut RunContext, frame: usize, ends: Instant) {
    let spread = cx.tally.arrivals.take().map_or(Span::ZERO, |(first, last)| last - first);
    let wait = (cx.now - ends).max(Span::ZERO);
    match cx.playback.purpose {
        RunPurpose::Home => cx.io.log.record(cx.now, EventKind::AtHome),
        RunPurpose::Preflight => {}
        RunPurpose::Play | RunPurpose::Preview => {
            cx.io.log.record(cx.now, EventKind::FrameReached { frame, spread, wait });
        }
    }
    cx.tally.frames_played += 1;
    cx.tally.recovery.reached(cx.now);
    cx.link.fade();
    cx.playback.paused |= std::mem::take(&mut cx.playback.stepping);
    cx.pipeline.obstacles = Default::default();
    let cue = cx.playback.cue(frame).map(str::to_owned);
    cx.playback.waits_for_go = cue.is_some();
    if let Some(name) = cue {
        cx.io.log.record(cx.now, EventKind::WaitsForGo { frame, name });
    }
    if let Some(repeats) = begins_loop(cx, frame) {
        let FrameLoop { first, last } = repeats;
        cx.io.log.record(cx.now, EventKind::LoopBegun { first, last });
    }
    cx.playback.advance();
}

/// The loop (frames that repeat until GO) that begins with the frame just reached; `None` if none does. If the run
/// began at a frame within a loop, the loop begins at that frame.
fn begins_loop(cx: &RunContext, frame: usize) -> Option<FrameLoop> {
    let repeats = cx.playback.loop_at(frame)?;
    let begins = frame == repeats.first || cx.tally.frames_played == 1;
    (begins && cx.playback.next.pass == 0).then_some(repeats)
}

/// Whether a place is at the goal. The differences along x and along y are tested one by one, as the original firmware
/// does.
pub(crate) fn is_there(at: Vec2, goal: Vec2, tolerance_m: f64) -> bool {
    (at.x - goal.x).abs() <= tolerance_m + 1e-9 && (at.y - goal.y).abs() <= tolerance_m + 1e-9
}
